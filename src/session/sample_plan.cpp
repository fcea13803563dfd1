#include "session/sample_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

/// Of what a block takes in a step: what was missed can still be found, by both halves of the samples.
constexpr int kFewest = 2;
/// Times the mean. What was seen by chance is not taken for sure: no more than so many times what a block has, either.
constexpr int kMostTimes = 8, kMostGrowth = 4;
/// Of the largest error: what has shown no noise is not known to have none.
constexpr double kLeastError = 1e-6;

double relative(double value, double largest) { return largest > 0 ? std::max(value / largest, kLeastError) : 1; }

int even_below(double n) { return n < 2 ? 0 : 2 * static_cast<int>(std::min(n, 0x1p30) / 2); }
int even_above(double n) { return n <= 0 ? 0 : 2 * static_cast<int>(std::ceil(std::min(n, 0x1p30) / 2)); }

}  // namespace

SamplePlan::SamplePlan(const PixelBounds& crop, int most, const ErrorGoal& goal)
    : grid_(crop),
      most_(most),
      last_(last_end(most)),
      goal_(goal),
      end_(std::min(kStep, last_)),
      had_(grid_.size(), 0),
      taken_(grid_.size(), kStep),
      spread_(grid_.size(), 0),
      work_(grid_.size(), 0) {}

int SamplePlan::round_end(int n) const {
  if (n >= last_) return std::numeric_limits<int>::max();
  if (n < kLeast) return std::min(n / kStep * kStep + kStep, last_);
  const auto octave = static_cast<std::int64_t>(std::bit_floor(static_cast<unsigned>(n)));
  const std::int64_t end = n < octave + octave / 2 ? octave + octave / 2 : 2 * octave;
  return static_cast<int>(std::min<std::int64_t>(end, last_));
}

int SamplePlan::pass_end(int n, int count) const {
  const std::int64_t wanted = std::int64_t{n} + count, end = round_end(n);
  if (n >= kStep) return static_cast<int>(std::min((wanted + kStep - 1) / kStep * kStep, end));
  return static_cast<int>(std::min(wanted, end));
}

int SamplePlan::samples(std::size_t block, int n) const {
  return begin_ == 0 ? n : had_[block] + taken_[block] * ((std::min(n, end_) - begin_) / kStep);
}

std::uint64_t SamplePlan::total(int n) const {
  std::uint64_t sum = 0;
  for (std::size_t b = 0; b < grid_.size(); ++b) sum += grid_.pixels(b).size() * static_cast<std::uint64_t>(samples(b, n));
  return sum;
}

std::pair<int, int> SamplePlan::range(int n) const {
  int least = std::numeric_limits<int>::max(), most = 0;
  for (std::size_t b = 0; b < grid_.size(); ++b) {
    least = std::min(least, samples(b, n));
    most = std::max(most, samples(b, n));
  }
  return {least, most};
}

std::vector<int> SamplePlan::counts(int n) const {
  std::vector<int> by_pixel(grid_.crop().size());
  for (std::size_t b = 0; b < grid_.size(); ++b) {
    const PixelBounds block = grid_.pixels(b);
    for (int y = block.y0; y < block.y1; ++y) {
      std::fill_n(by_pixel.begin() + static_cast<std::ptrdiff_t>(grid_.crop().index(block.x0, y)), block.width(),
                  samples(b, n));
    }
  }
  return by_pixel;
}

void SamplePlan::decide(int n, const std::vector<BlockNoise>& noise) {
  end_round();
  begin_ = n;
  end_ = round_end(n);
  taken_ = allot(shares(known(noise)), kStep);
}

void SamplePlan::end_round() {
  for (std::size_t b = 0; b < grid_.size(); ++b) {
    const int before = had_[b];
    had_[b] = samples(b, end_);
    spread_[b] += (had_[b] - before) * double{share(b)} * double{share(b)};
  }
}

SamplePlan::Known SamplePlan::known(const std::vector<BlockNoise>& noise) const {
  std::vector<BlockNoise> of_sample = noise;
  for (std::size_t b = 0; b < grid_.size(); ++b) of_sample[b].error *= static_cast<double>(begin_) * begin_ / spread_[b];
  return {errors_around(of_sample, grid_.across()), errors_around(noise, grid_.across()), mean_error(noise)};
}

/// In proportion to sqrt(variance / work), which makes the sum of all errors least for the work it takes [Cochran 1977, 5.5];
/// at least as many as the goal of the worst part takes. Where the mean is as good as it shall be, or there is not enough work
/// for that goal, in proportion to the error, which makes the largest one least.
std::vector<BlockShare> SamplePlan::shares(const Known& known) const {
  const double largest = *std::max_element(known.variance.begin(), known.variance.end());
  const double worst = *std::max_element(known.error.begin(), known.error.end()), end = expected_end(known.mean, worst);
  std::vector<BlockShare> for_mean, for_worst;
  double work = 0, needed = 0;
  for (std::size_t b = 0; b < grid_.size(); ++b) {
    BlockShare share = bounds_of(b, end);
    share.amount = relative(known.error[b], worst);
    for_worst.push_back(share);
    const auto pixels = static_cast<double>(grid_.pixels(b).size());
    share.amount = std::sqrt(relative(known.variance[b], largest) * pixels / share.work);
    share.least = std::min(std::max(needed_for_worst(known.variance[b], spread_[b]), share.least), share.most);
    for_mean.push_back(share);
    work += share.work * kStep;
    needed += share.work * share.least;
  }
  return goal_.worst < kInfinity && (known.mean < goal_.mean || needed > work) ? for_worst : for_mean;
}

/// But for what it is in proportion to.
BlockShare SamplePlan::bounds_of(std::size_t block, double expected_end) const {
  const double had = had_[block], steps = (end_ - begin_) / double{kStep};
  const double room = most_ - had - kFewest * ((last_ - end_) / double{kStep});  // the fewest fit into every step to come
  const double most = std::min({double{kMostTimes * kStep}, room / steps, (kMostGrowth - 1) * had / steps});
  BlockShare share{.most = std::max(even_below(most), kFewest)};
  const int for_least = even_above(kStep * (kLeast - had) / std::max(expected_end - begin_, double{kStep}));
  share.least = std::min({std::max(for_least, kFewest), kStep, share.most});
  const auto pixels = static_cast<double>(grid_.pixels(block).size());
  share.work = work_[block] > 0 ? static_cast<double>(work_[block]) / had : pixels;
  return share;
}

/// As errors fall like 1 / n; the last where there is no goal.
double SamplePlan::expected_end(double mean, double worst) const {
  const double excess = std::max(mean / goal_.mean, worst / goal_.worst), last = last_;
  return excess > 0 ? std::min(std::max(begin_ * excess, double{kLeast}), last) : last;
}

/// Samples in each step for a block's error to be that of the goal as the round ends, where a sample has that variance:
/// variance (spread + length^2 / samples of the round) / end^2.
int SamplePlan::needed_for_worst(double variance, double spread) const {
  if (!(variance > 0)) return kFewest;
  const double length = end_ - begin_, left = goal_.worst / variance * end_ * end_ - spread;
  return left > 0 ? even_above(length * kStep / left) : kMostTimes * kStep;
}

std::vector<std::uint64_t> SamplePlan::state() const {
  std::vector<std::uint64_t> state{static_cast<std::uint64_t>(begin_), static_cast<std::uint64_t>(end_)};
  for (std::size_t b = 0; b < grid_.size(); ++b) {
    for (const int n : {had_[b], taken_[b]}) state.push_back(static_cast<std::uint64_t>(n));
    state.push_back(std::bit_cast<std::uint64_t>(spread_[b]));
    state.push_back(work_[b]);
  }
  return state;
}

void SamplePlan::restore(const std::vector<std::uint64_t>& state) {
  begin_ = static_cast<int>(state[0]);
  end_ = static_cast<int>(state[1]);
  for (std::size_t b = 0; b < grid_.size(); ++b) {
    had_[b] = static_cast<int>(state[2 + 4 * b]);
    taken_[b] = static_cast<int>(state[3 + 4 * b]);
    spread_[b] = std::bit_cast<double>(state[4 + 4 * b]);
    work_[b] = state[5 + 4 * b];
  }
}

}  // namespace tyndall
