/// How often the image test is wrong: alarms between independent renders of one scene, and biases it does not find.
#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <string>

#include "report/image_test.h"
#include "support/measure.h"
#include "support/sanitized.h"
#include "support/scene_text.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr int kSide = 32;

/// Smoke before a lit plane: quiet parts, noisy ones, and the silhouette of the smoke, where noise is hit or miss.
std::string smoke_before_plane() {
  const Coefficients smoke{.sigma_a = {0.1f, 0.15f, 0.2f}, .sigma_s = {0.25f, 0.2f, 0.15f}, .g = 0.3f};
  return view({.eye = {1.6f, 1.2f, -3.2f}, .look = {0, 0, 0}, .fov_degrees = 42, .resolution = kSide, .max_depth = 1}) +
         point_light({1.5f, -1, -1.5f}, 6) + diffuse_plane(1.2f, 6, 0.5f) + homogeneous("m", smoke) +
         medium_box("m", "", {{-0.6f, -0.6f, -0.6f}, {0.6f, 0.6f, 0.6f}});
}

/// Independent renders, one after the other.
class Renders {
 public:
  Renders(int spp, const std::string& name) : spp_(spp), seed_(base_seed() * 10'000'000'000 + stream_of(name) * 10'000ull) {}
  MeanImage next() { return mean_image(subject_.render(spp_, seed_++, {"Variance"}), 1); }
  std::string faults() const { return subject_.faults(); }

 private:
  Subject subject_{smoke_before_plane(), {.candidates = 1}};  // single scattering takes 16 otherwise
  int spp_;
  std::uint64_t seed_;
};

MeanImage scaled(MeanImage image, double factor) {
  for (auto& channel : image.channels) {
    for (Estimate& e : channel) {
      e.mean *= factor;
      e.variance *= factor * factor;
    }
  }
  return image;
}

/// The fewest alarms whose chance is below 1e-3 when each trial has `p`.
std::size_t refused_alarms(std::size_t trials, double p) {
  std::size_t count = 0;
  while (binomial_tail(trials, p, count) >= 1e-3) ++count;
  return count;
}

}  // namespace

TEST_CASE("1,000 pairs at 4 spp: alarms as rare as stated, 1 % of bias found in 99 % of them") {
  constexpr std::size_t kPairs = fewer(1000);
  constexpr std::array<double, 3> kLevels{1e-3, 1e-2, 5e-2};
  std::array<std::size_t, 3> alarms{};
  std::size_t found = 0;
  Renders renders(4, "alarm rate");
  for (std::size_t i = 0; i < kPairs; ++i) {
    const MeanImage a = renders.next(), b = renders.next();
    for (std::size_t l = 0; l < kLevels.size(); ++l) alarms[l] += !test_images(a, b, {.family_level = kLevels[l]}).same;
    found += !test_images(scaled(a, i % 2 ? 1.01 : 1 / 1.01), b).same;
  }
  for (std::size_t l = 0; l < kLevels.size(); ++l) {
    const std::size_t refused = refused_alarms(kPairs, kLevels[l]);
    std::printf("  family level %g: %zu alarms in %zu pairs, refused from %zu\n", kLevels[l], alarms[l], kPairs, refused);
    CHECK(alarms[l] < refused);
  }
  std::printf("  a bias of 1 %%: found in %zu of %zu\n", found, kPairs);
  CHECK(found >= kPairs * 99 / 100);
  CHECK_MESSAGE(renders.faults().empty(), renders.faults());
}

TEST_CASE("64 spp: a bias of 0.5 %, and one of 6 % in one block of the quiet part, are found") {
  constexpr int kPairs = fewer(12);
  int mean = 0, block = 0;
  Renders renders(64, "small bias");
  for (int i = 0; i < kPairs; ++i) {
    const MeanImage a = renders.next(), b = renders.next();
    mean += !test_images(scaled(a, 1.005), b).same;
    MeanImage spotted = a;
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) spotted.channels[1][static_cast<std::size_t>(y * kSide + x)].mean *= 1.06;
    }
    const ImageTest test = test_images(spotted, b);
    block += test.alarms > 0 && test.worst_block.x == 0 && test.worst_block.y == 0;
  }
  std::printf("  0.5 %% everywhere: found in %d of %d; 6 %% in a block: in %d\n", mean, kPairs, block);
  CHECK(mean == kPairs);
  CHECK(block == kPairs);
}
