/// Paths that share what they find beyond their first bounce, against paths that do not.
///
/// Pixels that share are not independent, so errors come from the spread between renders of whole blocks.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>

#include "report/image_test.h"
#include "support/measure.h"
#include "support/sanitized.h"
#include "support/sharing.h"

using namespace tyndall;
using namespace tyndall::test;

TEST_CASE("sharing changes the noise alone: a room without media") {
  check_sharing("two bounces", sharing_camera(2) + sharing_room(), {}, 1.5, kManyToShare);
  check_sharing("eight bounces", sharing_camera(8) + sharing_room(), {}, 1.5);
}

// Of neighbours one finds something nearly always and another hardly ever: who found nothing counts all the same. Folds are
// narrower than blocks, so a find has few who share it: sharing gains little (1.08), but must not lose, as it does where
// roulette takes all finds for alike (0.76).
TEST_CASE("sharing changes the noise alone: folds under an open sky") {
  std::string folds;
  for (int i = 0; i < 6; ++i) {
    const std::string x0 = std::to_string(-1.5f + 0.5f * float(i)), x1 = std::to_string(-1.4f + 0.5f * float(i)),
                      x2 = std::to_string(-1.0f + 0.5f * float(i));
    const std::string low = " -1.8 ", high = " -1.2 ";
    folds += "Shape \"bilinearmesh\" \"point3 P\" [" + x0 + low + "-2 " + x1 + high + "-2 " + x0 + low + "2 " + x1 + high +
             "2]\n" + "Shape \"bilinearmesh\" \"point3 P\" [" + x1 + high + "-2 " + x2 + low + "-2 " + x1 + high + "2 " + x2 +
             low + "2]\n";
  }
  const std::string scene = sharing_camera(4) + block("Material \"diffuse\" \"rgb reflectance\" [0.8 0.7 0.6]\n" + folds) +
                            point_light({-1.7f, 1.2f, 0.7f}, 3);
  check_sharing("folds", scene, {}, 1.0);
}

// The camera is in the plane of a sheet: neighbours look at the floor on its lit and on its dark side.
TEST_CASE("sharing changes the noise alone: two sides of a sheet") {
  const std::string sheet =
      "Shape \"bilinearmesh\" \"point3 P\" [0.2 -1.8 -1.9  0 -1.8 1.9  0.2 -0.5 -1.9  0 -0.5 1.9]\n"
      "Shape \"bilinearmesh\" \"point3 P\" [-2 -1.8 -4  2 -1.8 -4  -2 -1.8 2  2 -1.8 2]\n";
  const std::string scene = sharing_camera(4) + block("Material \"diffuse\" \"rgb reflectance\" [0.8 0.7 0.6]\n" + sheet) +
                            point_light({-1.7f, 0.2f, 0}, 3);
  check_sharing("sheet", scene, {}, 1.1);
}

// Variances of sums over pixels are bounded by what sharing can make of them: no more false alarms than are stated.
TEST_CASE("renders that share are compared without false alarms, and a bias is found") {
  Subject subject(sharing_camera(3) + sharing_room(), {.reuse = ReuseStrategy::pixels});
  std::size_t alarms = 0, found = 0;
  constexpr int kPairs = fewer(40);
  for (int i = 0; i < kPairs; ++i) {
    const auto render = [&](int k) { return subject.render(16, 5000 + static_cast<std::uint64_t>(2 * i + k), {"Variance"}); };
    const Image a = render(0);
    Image b = render(1);
    alarms += !test_images(mean_image(a, 1), mean_image(b, 1)).same;
    for (const char* name : {"R", "G", "B"}) {
      for (Channel& c : b.channels) {
        if (c.name == name) std::for_each(c.values.begin(), c.values.end(), [](float& v) { v *= 1.3f; });
      }
    }
    found += !test_images(mean_image(a, 1), mean_image(b, 1)).same;
  }
  std::printf("  %zu alarms in %d pairs; a bias of 30 %% found in %zu\n", alarms, kPairs, found);
  CHECK(alarms <= 1);  // at a level of 1e-3 two are as rare as 8e-4
  CHECK(found == kPairs);
}
