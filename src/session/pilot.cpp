#include "session/pilot.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <vector>

#include "math/hash.h"
#include "session/block_grid.h"
#include "session/flush_denormals.h"
#include "transport/budget/light_trial.h"

namespace tyndall {
namespace {

constexpr std::uint64_t kPilotSeed = 0x9110;
/// Of each pixel that is looked at.
constexpr int kSamples = 4;
/// One block of so many: an eighth of a sample of the picture. More than kMostBlocks know no better.
constexpr std::size_t kBlocksEach = 32, kMostBlocks = 64;
/// Blocks that know as much as the numbers that stand without them.
constexpr double kDoubt = 2;

/// One pixel.
struct Tried {
  double sum = 0, squares = 0;  ///< of its samples' radiance
  LightTrial light;

  double mean() const { return sum / kSamples; }
  /// The same with all that was found: lights that are seldom chosen are seen twice as often.
  double best_mean() const { return (sum + 0.5 * light.difference) / kSamples; }
  /// Of its samples together, as `light` is.
  double variance() const { return (squares - sum * mean()) * kSamples / (kSamples - 1); }
};

struct TriedBlock {
  std::vector<Tried> pixels;
  double cost = 0;
};

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

/// Without the emission that is seen: the film looks for emitters by itself.
TriedBlock try_block(const SampleContext& context, const PixelBlock& block) {
  TriedBlock tried{.pixels = std::vector<Tried>(block.pixels().size())};
  const auto group = std::make_unique<PixelGroup>();
  Counters counters;
  const double exposure{context.world.built.scene.film.imaging_ratio};  // trials see light as it is found
  for (int s = 0; s < kSamples; ++s) {
    group->clear();
    for (std::size_t i = 0; i < tried.pixels.size(); ++i) {
      const auto [x, y] = block.pixels()[i];
      group->add(context, {hash(context.settings.seed, kPilotSeed), x, y, s}, PixelFilm(), counters);
      if (Path* path = (*group)[i].path()) path->observe(tried.pixels[i].light);
    }
    group->run(context, counters);
    for (std::size_t i = 0; i < tried.pixels.size(); ++i) {
      const PathRecord record = (*group)[i].record();
      const auto L = double{mean(record.radiance() - record.emission)} / exposure;
      tried.pixels[i].sum += L;
      tried.pixels[i].squares += L * L;
    }
  }
  tried.cost = Prices(context.world.built.lights.size()).of(counters);
  for (const Tried& pixel : tried.pixels) tried.cost -= pixel.light.repeated;
  return tried;
}

/// Variances relative to pixels' squared means, as errors are seen; what is dark by a tenth of the mean of all.
Trials sum_up(const std::vector<Tried>& pixels) {
  double sum = 0;
  for (const Tried& pixel : pixels) sum += pixel.mean();
  const double dark = 0.01 * std::pow(sum / static_cast<double>(pixels.size()), 2);
  Trials trials;
  for (const Tried& pixel : pixels) {
    const double unit = pixel.best_mean() * pixel.best_mean() + dark;
    if (!(unit > 0)) continue;
    trials.all_variance += pixel.variance() / unit;
    for (std::size_t i = 0; i < kSpents; ++i) {
      trials.variance[i] += pixel.light.variance[i] / unit;
      trials.cost[i] += pixel.light.cost[i];
    }
  }
  return trials;
}

/// There are lights to choose among, and numbers that are not given. Single scattering has its own.
bool decides_lights(const SampleContext& context) {
  const RenderSettings& settings = context.settings;
  return context.world.built.lights.sought(context.selector_with_volumes != nullptr) > 1 && settings.max_depth > 1 &&
         !context.selector.exhaustive() && !context.selector.sizes_cut() && !(settings.candidates && settings.shadow_rays);
}

/// Connections through homogeneous media have no noise of their own, and always pay.
bool decides_sharing(const SampleContext& context) {
  const auto& media = context.world.built.media;
  return context.settings.reuse == ReuseStrategy::pixels &&
         std::any_of(media.begin(), media.end(), [](const ParticipatingMedium& m) { return !m.homogeneous(); });
}

/// Of the frame's blocks a few, with that budget; without what only pictures want.
Trials try_blocks(const SampleContext& context, const LightBudget& budget, ThreadPool& pool) {
  const SampleContext pilot{
      context.world, context.selector, context.selector_with_volumes, context.settings, {.max_depth = context.limits.max_depth},
      &budget};
  const Film& film = context.world.built.scene.film;
  const PixelBounds frame{0, 0, film.width, film.height};
  std::vector<TriedBlock> blocks(std::clamp<std::size_t>(BlockGrid(frame).size() / kBlocksEach, 1, kMostBlocks));
  pool.for_each(blocks.size(), 1, [&](std::size_t i) {
    const FlushDenormals guard;
    const PixelPlace p = spread_place(i, frame);
    blocks[i] = try_block(pilot, PixelBlock(p.x, p.y, frame));
  });
  std::vector<Tried> pixels;
  for (const TriedBlock& block : blocks) {
    std::copy_if(block.pixels.begin(), block.pixels.end(), std::back_inserter(pixels),
                 [](const Tried& pixel) { return std::isfinite(pixel.squares); });
  }
  Trials trials = sum_up(pixels);
  for (const TriedBlock& block : blocks) trials.all_cost += block.cost;
  const auto looks = static_cast<double>(blocks.size());
  trials.trust = looks / (looks + kDoubt);
  return trials;
}

}  // namespace

std::optional<LightBudget> measured_budget(const SampleContext& context, ThreadPool& pool) {
  if (context.settings.budget != BudgetStrategy::measured) return std::nullopt;
  const bool lights = decides_lights(context), sharing = decides_sharing(context);
  if (!lights && !sharing) return std::nullopt;
  LightBudget budget = LightBudget::unmeasured(context.settings.reuse);
  if (sharing) budget.collisions_shared = true;
  const Trials trials = try_blocks(context, budget, pool);
  LightBudget best = lights ? best_budget(trials, budget) : budget;
  if (sharing) {
    // The same paths but for what they share, so that little of how they differ is chance.
    budget.collisions_shared = false;
    best.collisions_shared = trials.product() < try_blocks(context, budget, pool).product();
  }
  return best;
}

}  // namespace tyndall
