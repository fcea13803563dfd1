#include "session/look.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>

#include "math/hash.h"
#include "session/block_grid.h"
#include "session/flush_denormals.h"

namespace tyndall {
namespace {

constexpr std::uint64_t kPilotSeed = 0x9110;
/// Of each pixel that is looked at.
constexpr int kSamples = 4;
/// One block of so many: a twelfth of a sample of the picture. More than kMostBlocks know no better.
constexpr std::size_t kBlocksEach = 48, kMostBlocks = 64;
/// Fewer blocks can't tell one technique from the other, as all pixels of one may share what a single path has found.
constexpr std::size_t kLeastToCompare = 4;
/// Blocks that know as much as the numbers that stand without them.
constexpr double kDoubt = 2;
/// Relative variance of a sample, of which nothing is seen: where there is less, what costs less is better.
constexpr double kUnseen = 1e-8;

/// Place number i of a sequence that covers the frame evenly however long it is: multiples of the powers of 1 / x, x^3 = x + 1
/// [Roberts 2018].
PixelPlace spread_place(std::size_t i, const PixelBounds& frame) {
  constexpr double kX = 0.7548776662466927, kY = 0.5698402909980532;
  const auto at = [i](double step, int size) {
    const double u = 0.5 + static_cast<double>(i) * step;
    return static_cast<int>((u - std::floor(u)) * size);
  };
  return {at(kX, frame.x1), at(kY, frame.y1)};
}

std::size_t blocks_of(const PixelBounds& frame) {
  return std::min(std::max<std::size_t>(BlockGrid(frame).size() / kBlocksEach, 1), kMostBlocks);
}

/// What a variance is relative to, as errors are seen: a squared mean; what is dark by a tenth of the mean of all.
double unit_of(double mean, double of_all) { return mean * mean + 0.01 * of_all * of_all; }

}  // namespace

/// With all that was found: lights that are seldom chosen are seen twice as often.
double Look::Pixel::mean() const { return (even + odd + 0.5 * light.difference) / kSamples; }
double Look::Pixel::variance() const { return (squares - (even + odd) * (even + odd) / kSamples) * kSamples / (kSamples - 1); }
double Look::Pixel::error() const { return (even - odd) * (even - odd); }
bool Look::Pixel::is_finite() const { return std::isfinite(squares); }

double Look::Block::mean() const {
  double found = 0, count = 0;
  for (const Pixel& pixel : pixels) {
    if (pixel.is_finite()) found += pixel.mean(), ++count;
  }
  return count > 0 ? found / count : 0.0;
}

/// Without the emission that is seen: the film looks for emitters by itself.
Look::Block Look::try_block(const SampleContext& context, const PixelBlock& block) {
  Block tried;
  tried.pixels.resize(block.pixels().size());
  const auto group = std::make_unique<PixelGroup>();
  const double exposure{context.world.built.scene.film.imaging_ratio};  // trials see light as it is found
  for (int s = 0; s < kSamples; ++s) {
    group->clear();
    for (std::size_t i = 0; i < tried.pixels.size(); ++i) {
      const auto [x, y] = block.pixels()[i];
      group->add(context, {hash(context.settings.seed, kPilotSeed), x, y, s}, PixelFilm(), tried.counters);
      if (Path* path = (*group)[i].path()) path->observe(tried.pixels[i].light);
    }
    group->run(context, tried.counters);
    for (std::size_t i = 0; i < tried.pixels.size(); ++i) {
      const PathRecord record = (*group)[i].record();
      const auto L = double{mean(record.radiance() - record.emission)} / exposure;
      (s & 1 ? tried.pixels[i].odd : tried.pixels[i].even) += L;
      tried.pixels[i].squares += L * L;
    }
  }
  for (const Pixel& pixel : tried.pixels) tried.repeated += pixel.light.repeated;
  return tried;
}

Look::Look(const SampleContext& context, const Decision& decision, ThreadPool& pool) : decision_(decision) {
  const SampleContext pilot{context.world,
                            context.selector,
                            context.selector_with_volumes,
                            decision_.settings,
                            {.max_depth = context.limits.max_depth},
                            decision_.budget ? &*decision_.budget : nullptr};
  const Film& film = context.world.built.scene.film;
  const PixelBounds frame{0, 0, film.width, film.height};
  blocks_.resize(blocks_of(frame));
  pool.for_each(blocks_.size(), 1, [&](std::size_t i) {
    const FlushDenormals guard;
    const PixelPlace p = spread_place(i, frame);
    blocks_[i] = try_block(pilot, PixelBlock(p.x, p.y, frame));
  });
  for (const Block& block : blocks_) {
    counters_ += block.counters;
    cost_ -= block.repeated;
  }
  cost_ += Prices(context.world.built.lights.size()).of(counters_);
}

bool Look::can_be_compared() const { return blocks_.size() >= kLeastToCompare; }

double Look::mean_of_all() const {
  const double sum =
      std::accumulate(blocks_.begin(), blocks_.end(), 0.0, [](double s, const Block& b) { return s + b.mean(); });
  return sum / static_cast<double>(blocks_.size());
}

/// Of all pixels of a block that of its mean, in both looks together: those of single pixels are too noisy to divide by.
std::vector<double> Look::units(const Look& other) const {
  const double all = 0.5 * (mean_of_all() + other.mean_of_all());
  std::vector<double> units;
  for (std::size_t i = 0; i < blocks_.size(); ++i)
    units.push_back(unit_of(0.5 * (blocks_[i].mean() + other.blocks_[i].mean()), all));
  return units;
}

double Look::error(const std::vector<double>& units) const {
  double error = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    for (const Pixel& pixel : blocks_[b].pixels) {
      if (pixel.is_finite()) error += (units[b] > 0 ? pixel.error() / units[b] : 0.0) + kUnseen;
    }
  }
  return error;
}

bool Look::beats(const Look& other, double share) const {
  const std::vector<double> unit = units(other);
  return error(unit) * cost_ < share * other.error(unit) * other.cost_;
}

Trials Look::trials() const {
  const double all = mean_of_all();
  Trials trials{.all_cost = cost_};
  for (const Block& block : blocks_) {
    for (const Pixel& pixel : block.pixels) {
      const double unit = unit_of(pixel.mean(), all);
      if (!(unit > 0) || !pixel.is_finite()) continue;
      trials.all_variance += pixel.variance() / unit;
      for (std::size_t i = 0; i < kSpents; ++i) {
        trials.variance[i] += pixel.light.variance[i] / unit;
        trials.cost[i] += pixel.light.cost[i];
      }
    }
  }
  const auto looks = static_cast<double>(blocks_.size());
  trials.trust = looks / (looks + kDoubt);
  return trials;
}

}  // namespace tyndall
