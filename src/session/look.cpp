#include "session/look.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <mutex>
#include <numbers>

#include "math/hash.h"
#include "session/block_grid.h"
#include "session/flush_denormals.h"
#include "transport/sample/prices.h"
#include "tyndall/relative_error.h"

namespace tyndall {
namespace {

constexpr std::uint64_t kPilotSeed = 0x9110;
/// Of each pixel that is looked at.
constexpr int kSamples = 4;
/// One block of so many: a twelfth of a sample of the picture. More than kMostBlocks know no better.
constexpr std::size_t kBlocksEach = 48, kMostBlocks = 64;
/// One of so many: a sixty-fourth of a sample.
constexpr std::size_t kFirstEach = 256;
/// Blocks that know as much as the numbers that stand without them.
constexpr double kDoubt = 2;
/// The more samples, the more strata, which spare much of the variance over a pixel and little of what choices among lights
/// add. What the second sample of a look's sequences leaves of it, at least kLeastLeft, is taken for what one more doubling
/// leaves: further ones spare less (docs/measurements.md). Strata of one number, as of flights through smoke, leave a quarter
/// and less.
constexpr int kDoublings = 2;
constexpr double kLeastLeft = 0.125;
/// A few edges of bright emitters may be most of the noise that two looks see, alike in both and by chance: so many pixels have
/// no more in common than what others have at most.
constexpr double kWorstInBoth = 0.01;
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

/// What a variance is relative to, as errors are seen, with radiance of the film.
double unit_of(double mean, const Film& film) {
  return mean * mean + kRelativeEpsilon / (double{film.imaging_ratio} * film.imaging_ratio);
}

/// Of a block, in two looks at it.
struct PixelErrors {
  std::vector<double> mine, others;

  double in_both(std::size_t pixel) const { return std::min(mine[pixel], others[pixel]); }
  /// Of one of the two, of which no pixel has more than `most` in common.
  double sum(const std::vector<double>& errors, double most) const {
    double sum = 0;
    for (std::size_t i = 0; i < errors.size(); ++i) sum += errors[i] - std::max(in_both(i) - most, 0.0);
    return sum;
  }
};

/// All but kWorstInBoth of the pixels have no more in both.
double most_in_both(const std::vector<PixelErrors>& blocks) {
  std::vector<double> errors;
  for (const PixelErrors& block : blocks) {
    for (std::size_t i = 0; i < block.mine.size(); ++i) errors.push_back(block.in_both(i));
  }
  const auto worst = static_cast<std::ptrdiff_t>(kWorstInBoth * static_cast<double>(errors.size()));
  const auto most = errors.end() - 1 - worst;
  std::nth_element(errors.begin(), most, errors.end());
  return *most;
}

struct Product {
  double error = 0, cost = 0;
  void add(const Product& more, double times) { error += times * more.error, cost += times * more.cost; }
  double log() const { return std::log(error * cost); }
};

}  // namespace

double Look::Pixel::sum() const { return double{tyndall::mean(even)} + double{tyndall::mean(odd)}; }
/// With all that was found: lights that are seldom chosen are seen twice as often.
double Look::Pixel::mean() const { return (sum() + 0.5 * light.difference) / kSamples; }
double Look::Pixel::variance() const { return (squares - sum() * sum() / kSamples) * kSamples / (kSamples - 1); }
double Look::Pixel::error(int channel) const {
  const double difference = double{even[channel]} - double{odd[channel]};
  return difference * difference;
}
bool Look::Pixel::is_finite() const { return std::isfinite(squares); }

Rgb Look::Block::mean() const {
  Rgb found;
  float count = 0;
  for (const Pixel& pixel : pixels) {
    if (pixel.is_finite()) found += pixel.even + pixel.odd, count += kSamples;
  }
  return count > 0 ? found * (1 / count) : Rgb();
}

/// More than 0 each.
std::vector<double> Look::Block::errors(Rgb mean, const Film& film) const {
  std::vector<double> errors(pixels.size(), kUnseen);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (!pixels[i].is_finite()) continue;
    for (int c = 0; c < 3; ++c) errors[i] += pixels[i].error(c) / (3 * unit_of(double{mean[c]}, film));
  }
  return errors;
}

std::size_t Look::usual_blocks(const Film& film) {
  return std::min(std::max<std::size_t>(BlockGrid(frame_of(film)).size() / kBlocksEach, 1), kMostBlocks);
}

std::size_t Look::first_blocks(const Film& film) {
  return std::min(BlockGrid(frame_of(film)).size() / kFirstEach, kMostBlocks);
}

double Look::samples_of(std::size_t blocks, const Film& film) {
  return kSamples * static_cast<double>(blocks) / static_cast<double>(BlockGrid(frame_of(film)).size());
}

void Look::extend(std::size_t blocks) {
  const std::size_t before = blocks_.size();
  if (blocks <= before) return;
  blocks_.resize(blocks);
  std::mutex mutex;
  bool given_up = false;
  const auto goes_on = [&] {
    const std::scoped_lock lock(mutex);
    given_up = given_up || (looks_.watch && !looks_.watch());
    return !given_up;
  };
  looks_.pool.for_each(blocks - before, 1, [&](std::size_t i) {
    if (!goes_on()) return;
    const FlushDenormals guard;
    blocks_[before + i] = try_block(before + i);
  });
  if (given_up) throw LookGivenUp();
  for (std::size_t i = before; i < blocks; ++i) counters_ += blocks_[i].counters;
}

Look::Block Look::try_block(std::size_t number) const {
  const SampleContext& context = looks_.context;
  const SampleContext pilot{context.world,
                            context.selector,
                            context.selector_with_volumes,
                            decision_.settings,
                            {.max_depth = context.limits.max_depth},
                            decision_.budget ? &*decision_.budget : nullptr};
  const PixelPlace place = spread_place(number, frame_of(film()));
  const PixelBlock block(place.x, place.y, frame_of(film()));
  Block tried;
  tried.pixels.resize(block.pixels().size());
  const auto group = std::make_unique<PixelGroup>();
  const std::vector<PixelFilm> films = looks_.searched.of(block);
  const float exposure = film().imaging_ratio;  // trials see light as it is found
  for (int s = 0; s < kSamples; ++s) {
    group->clear();
    for (std::size_t i = 0; i < tried.pixels.size(); ++i) {
      const PixelPlace p = block.pixels()[i];
      group->add(pilot, {hash(pilot.settings.seed, kPilotSeed), p.x, p.y, s}, films[i], tried.counters);
      if (Path* path = (*group)[i].path()) path->observe(tried.pixels[i].light);
    }
    group->run(pilot, tried.counters);
    for (std::size_t i = 0; i < tried.pixels.size(); ++i) {
      const Rgb L = (*group)[i].record().radiance() * ((*group)[i].weight() / exposure);
      (s & 1 ? tried.pixels[i].odd : tried.pixels[i].even) += L;
      tried.pixels[i].squares += double{mean(L)} * double{mean(L)};
    }
  }
  tried.cost = Prices(context.world.built.lights.size()).of(tried.counters);
  for (const Pixel& pixel : tried.pixels) tried.cost -= pixel.light.repeated;
  return tried;
}

/// Errors are relative to the mean of a block, in both looks together: those of single pixels are too noisy to divide by.
Look::Ratio Look::over(const Look& other) const {
  const std::size_t count = std::min(blocks_.size(), other.blocks_.size());
  std::vector<PixelErrors> errors(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Rgb both = (blocks_[i].mean() + other.blocks_[i].mean()) * 0.5f;
    errors[i] = {blocks_[i].errors(both, film()), other.blocks_[i].errors(both, film())};
  }
  const double most = most_in_both(errors);
  std::vector<Product> mine(count), others(count);
  Product my_sum, other_sum;
  for (std::size_t i = 0; i < count; ++i) {
    mine[i] = {errors[i].sum(errors[i].mine, most), blocks_[i].cost};
    others[i] = {errors[i].sum(errors[i].others, most), other.blocks_[i].cost};
    my_sum.add(mine[i], 1);
    other_sum.add(others[i], 1);
  }
  const double log = my_sum.log() - other_sum.log();
  double squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Product a = my_sum, b = other_sum;
    a.add(mine[i], -1), b.add(others[i], -1);
    const double change = a.log() - b.log() - log;
    squares += change * change;
  }
  const auto n = static_cast<double>(count);
  return {log, std::sqrt(squares * (n - 1) / n), my_sum.cost / other_sum.cost};
}

double Look::Ratio::expected_loss() const {
  if (!(deviation > 0)) return 0;
  const double z = std::abs(log) / deviation;
  return deviation * (std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi) - 0.5 * z * std::erfc(z / std::numbers::sqrt2));
}

Trials Look::trials(std::size_t blocks) const {
  const auto looks = static_cast<double>(blocks);
  Trials trials{.trust = looks / (looks + kDoubt)};
  double stratified = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const Block& block = blocks_[i];
    trials.all_cost += block.cost / looks;
    for (const Pixel& pixel : block.pixels) {
      if (!pixel.is_finite()) continue;
      const double unit = looks * unit_of(pixel.mean(), film());
      trials.all_variance += pixel.variance() / unit;
      const double halves = double{mean(pixel.even)} - double{mean(pixel.odd)};
      stratified += halves * halves / unit;
      for (std::size_t spent = 0; spent < kSpents; ++spent) {
        trials.variance[spent] += pixel.light.variance[spent] / unit;
        trials.cost[spent] += pixel.light.cost[spent] / looks;
      }
    }
  }
  const double rest = rest_of_variance(trials);
  if (!(rest > 0)) return trials;
  const double chosen = trials.all_variance - rest;
  const double left = std::min(std::max((stratified - chosen) / rest, kLeastLeft), 1.0);
  trials.all_variance = chosen + rest * std::pow(left, kDoublings);
  return trials;
}

}  // namespace tyndall
