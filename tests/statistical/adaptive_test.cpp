/// Samples where the error is, decided by the samples themselves, must not darken the picture: the means of toy pictures with
/// noise of known mean, rendered many times.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <utility>

#include "math/rng.h"
#include "session/sample_plan.h"

using namespace tyndall;

namespace {

constexpr PixelBounds kFrame{0, 0, 96, 64};
constexpr int kMean = 64;
constexpr double kEpsilon = 0.01;

/// A sample of a pixel in the left half and one in the right.
struct Noise {
  std::function<double(Rng&)> quiet, loud;
  double mean;  ///< of both
  ErrorGoal goal{};
};

/// The halves' sums of each pixel, and that of its samples as they are.
struct Toy {
  Toy(const Noise& kind, std::uint64_t seed)
      : noise(kind), rng(seed), plan(kFrame, 1 << 20, kind.goal), even(kFrame.size(), 0), odd(even), unweighted(even) {}

  void advance(int from, int to) {
    for (std::size_t b = 0; b < plan.grid().size(); ++b) {
      const PixelBounds block = plan.grid().pixels(b);
      for (int y = block.y0; y < block.y1; ++y) {
        for (int x = block.x0; x < block.x1; ++x) {
          for (int s = plan.samples(b, from); s < plan.samples(b, to); ++s) {
            const double value = (x < 48 ? noise.quiet : noise.loud)(rng);
            (s & 1 ? odd : even)[kFrame.index(x, y)] += double{plan.share(b)} * value;
            unweighted[kFrame.index(x, y)] += value;
          }
        }
      }
    }
  }

  std::vector<BlockNoise> measured(int n) const {
    std::vector<BlockNoise> blocks;
    for (std::size_t b = 0; b < plan.grid().size(); ++b) {
      const PixelBounds block = plan.grid().pixels(b);
      const double half = n / 2.0;
      BlockNoise measured{.pixels = static_cast<double>(block.size())};
      for (int y = block.y0; y < block.y1; ++y) {
        for (int x = block.x0; x < block.x1; ++x) {
          const double p = even[kFrame.index(x, y)] / half, q = odd[kFrame.index(x, y)] / half;
          measured.error += (p - q) * (p - q) / 4 / (std::max(p * q, 0.0) + kEpsilon);
        }
      }
      blocks.push_back(measured);
    }
    return blocks;
  }

  void render() {
    advance(0, SamplePlan::kStep);
    for (int n = SamplePlan::kStep; n < kMean; n = plan.round_end(n)) {
      plan.decide(n, measured(n));
      advance(n, plan.round_end(n));
    }
  }

  const Noise& noise;
  Rng rng;
  SamplePlan plan;
  std::vector<double> even, odd, unweighted;
};

/// Relative to the mean: of the picture and of its columns [x0, x1). The sum of all deviations has mean 0 whatever decides how
/// many samples there are [Wald 1944], and as many of them, so that taking it off leaves the bias and little noise.
double bias_of(const Toy& toy, int x0, int x1) {
  double of_pixels = 0, of_samples = 0, pixels = 0, samples = 0;
  const std::vector<int> counts = toy.plan.counts(kMean);
  for (int y = kFrame.y0; y < kFrame.y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const std::size_t i = kFrame.index(x, y);
      of_pixels += (toy.even[i] + toy.odd[i]) / kMean - toy.noise.mean;
      of_samples += toy.unweighted[i] - counts[i] * toy.noise.mean;
      pixels += 1;
      samples += counts[i];
    }
  }
  return (of_pixels / pixels - of_samples / samples) / toy.noise.mean;
}

struct Bias {
  double mean, error;
};

Bias mean_bias(const Noise& noise, int x0, int x1) {
  constexpr int kRuns = 200;
  double sum = 0, squares = 0;
  for (int run = 0; run < kRuns; ++run) {
    Toy toy(noise, 1000 + static_cast<std::uint64_t>(run));
    toy.render();
    const double bias = bias_of(toy, x0, x1);
    sum += bias;
    squares += bias * bias;
  }
  const double mean = sum / kRuns;
  return {mean, std::sqrt((squares / kRuns - mean * mean) / kRuns)};
}

double exponential(Rng& rng) { return -std::log1p(-rng.uniform_wide()); }
/// 251 once in 500 times, else 1.
double spike(Rng& rng) { return rng.uniform_wide() < 1.0 / 500 ? 251 : 1; }

}  // namespace

/// A bias of five of the errors found would be seen all but surely.
void check_unbiased(const Noise& noise, int x0, int x1, double largest_error) {
  const Bias bias = mean_bias(noise, x0, x1);
  MESSAGE("columns " << x0 << " to " << x1 << ": bias " << bias.mean << " +- " << bias.error);
  CHECK(bias.error < largest_error);
  CHECK(std::abs(bias.mean) < 3.5 * bias.error);
}

TEST_CASE("adaptive sampling leaves the mean of the picture, and of the part that gets least") {
  const Noise mild{[](Rng& rng) { return 0.9 + 0.2 * rng.uniform_wide(); }, exponential, 1};
  check_unbiased(mild, 0, 96, 5e-5);
  check_unbiased(mild, 0, 48, 5e-5);
  check_unbiased(mild, 40, 56, 1e-4);
}

// Each sample weighing the same, however many there are, it would cost 0.3 and 0.7 % here; a threshold for each pixel a sixth.
TEST_CASE("where one sample in 500 has all the light it leaves the mean as well") {
  const Noise half{[](Rng&rng) { return 1.4 + 0.2 * rng.uniform_wide(); }, spike, 1.5}, everywhere{spike, spike, 1.5};
  check_unbiased(half, 0, 48, 5e-4);
  check_unbiased(half, 0, 96, 5e-4);
  check_unbiased(everywhere, 0, 96, 5e-4);
}

TEST_CASE("samples for the worst part, which go by the error alone, leave the mean") {
  // Out of reach, so that every decision is for it.
  const ErrorGoal goal{.worst = 1e-9};
  const Noise mild{[](Rng& rng) { return 0.9 + 0.2 * rng.uniform_wide(); }, exponential, 1, goal};
  check_unbiased(mild, 0, 96, 1e-4);
  const Noise everywhere{spike, spike, 1.5, goal};
  check_unbiased(everywhere, 0, 96, 5e-4);
}
