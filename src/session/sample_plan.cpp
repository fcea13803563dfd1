#include "session/sample_plan.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace tyndall {

SamplePlan::SamplePlan(const PixelBounds& crop, int most, const ErrorGoal& goal)
    : grid_(crop), most_(most), goal_(goal), had_(grid_.size(), 0), given_(grid_.size(), kPilot), work_(grid_.size(), 0) {}

int SamplePlan::round_end(int n) const {
  if (n < kPilot) return kPilot;
  if (n >= most_) return std::numeric_limits<int>::max();
  const auto octave = static_cast<std::int64_t>(std::bit_floor(static_cast<unsigned>(n)));
  const std::int64_t end = n < octave + octave / 2 ? octave + octave / 2 : 2 * octave;
  return static_cast<int>(std::min<std::int64_t>(end, most_));
}

int SamplePlan::samples(std::size_t block, int n) const {
  if (begin_ == 0) return n;
  const std::int64_t pairs = given_[block] / 2, all = end_ - begin_, done = std::min<std::int64_t>(n - begin_, all);
  return had_[block] + static_cast<int>(2 * (pairs * done / all));
}

std::uint64_t SamplePlan::total(int n) const {
  std::uint64_t sum = 0;
  for (std::size_t b = 0; b < grid_.size(); ++b) sum += grid_.pixels(b).size() * static_cast<std::uint64_t>(samples(b, n));
  return sum;
}

SampleCounts SamplePlan::counts(int n) const {
  std::vector<int> by_pixel(grid_.crop().size());
  for (std::size_t b = 0; b < grid_.size(); ++b) {
    const PixelBounds block = grid_.pixels(b);
    for (int y = block.y0; y < block.y1; ++y) {
      std::fill_n(by_pixel.begin() + static_cast<std::ptrdiff_t>(grid_.crop().index(block.x0, y)), block.width(),
                  samples(b, n));
    }
  }
  return SampleCounts(std::move(by_pixel));
}

void SamplePlan::decide(int n, std::vector<BlockNoise> blocks) {
  for (std::size_t b = 0; b < grid_.size(); ++b) {
    blocks[b].samples = had_[b] = samples(b, n);
    blocks[b].work = static_cast<double>(work_[b]) / had_[b];
  }
  begin_ = n;
  end_ = round_end(n);
  const std::vector<int> wanted = allot(blocks, grid_.across(), {static_cast<double>(end_), most_, goal_});
  for (std::size_t b = 0; b < grid_.size(); ++b) given_[b] = std::max(wanted[b] - had_[b], 0);
}

std::vector<std::uint64_t> SamplePlan::state() const {
  std::vector<std::uint64_t> state{static_cast<std::uint64_t>(begin_), static_cast<std::uint64_t>(end_)};
  for (std::size_t b = 0; b < grid_.size(); ++b) {
    for (const int n : {had_[b], given_[b]}) state.push_back(static_cast<std::uint64_t>(n));
    state.push_back(work_[b]);
  }
  return state;
}

void SamplePlan::restore(const std::vector<std::uint64_t>& state) {
  begin_ = static_cast<int>(state[0]);
  end_ = static_cast<int>(state[1]);
  for (std::size_t b = 0; b < grid_.size(); ++b) {
    had_[b] = static_cast<int>(state[2 + 3 * b]);
    given_[b] = static_cast<int>(state[3 + 3 * b]);
    work_[b] = state[4 + 3 * b];
  }
}

}  // namespace tyndall
