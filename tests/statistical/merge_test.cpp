/// Merged renders are as good as one render of all their samples, and know it.
#include <doctest/doctest.h>

#include <cmath>

#include "report/block_test.h"
#include "report/merge.h"
#include "support/measure.h"
#include "support/sanitized.h"
#include "support/scene_text.h"
#include "support/scratch.h"
#include "tyndall/io.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

std::string scene() {
  const Bounds3 box{{-1, -1, -1}, {1, 1, 1}};
  return view({.eye = {1.6f, 1.2f, -3.2f}, .look = {0, -0.1f, 0}, .fov_degrees = 42, .resolution = 24, .max_depth = 6}) +
         point_light({1.5f, 2, -1.5f}, 6) + emitting_square({-1.2f, 0.8f, 1.4f}, 0.5f, 4) + environment(0.15f) +
         diffuse_plane(1.8f, 4, 0.6f) + homogeneous("m", {.sigma_a = Rgb(0.2f), .sigma_s = Rgb(1.5f), .g = 0.5f}) +
         medium_box("m", "", box);
}

}  // namespace

TEST_CASE("a merged pair agrees with one render of as many samples, and its Variance with the spread of such pairs") {
  Subject subject(scene());
  const Scratch scratch;
  constexpr int kPairs = kSanitized ? 6 : 24;
  constexpr int kSpp[2] = {8, 24};  // unequal, so that the weights count
  MeanImageBuilder merged, single;
  Moments claimed;
  for (int i = 0; i < kPairs; ++i) {
    for (int k = 0; k < 2; ++k) {
      write_exr(subject.render(kSpp[k], 100 + 2 * static_cast<std::uint64_t>(i) + static_cast<std::uint64_t>(k), {"Variance"}),
                scratch / (k == 0 ? "a.exr" : "b.exr"));
    }
    const Image pair = merge_slices({scratch / "b.exr", scratch / "a.exr"}).image;
    merged.add(pair);
    claimed.add(image_mean(mean_image(pair, 1), 1).variance);
    single.add(subject.render(kSpp[0] + kSpp[1], 1000 + static_cast<std::uint64_t>(i)));
  }

  // Means: over the picture, and block by block at family level 1e-3.
  const MeanImage a = merged.result(), b = single.result();
  for (int channel = 0; channel < 3; ++channel) CHECK(mean_test(a, b, channel).p > 1e-4);
  const auto differences = block_test(block_means(a, 8), block_means(b, 8));
  CHECK(count_below(differences, sidak(1e-3, static_cast<double>(differences.size()))) == 0);

  // Variance of a pair's image mean: what pairs say of themselves against how they spread.
  const Estimate truth = image_mean(a, 1), claim = claimed.estimate();
  const double spread = truth.variance * kPairs;
  const double error = spread * std::sqrt(2 / truth.dof) + claim.standard_error();
  MESSAGE("variance of a merged pair's mean: claimed " << claim.mean << ", spread " << spread << " +- " << error
                                                       << "; of one render " << image_mean(b, 1).variance * kPairs);
  CHECK(std::abs(claim.mean - spread) < 4 * error);
}
