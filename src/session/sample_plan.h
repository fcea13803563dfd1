/// Which block of pixels takes which samples, where not all take the same.
#pragma once

#include <cstdint>
#include <vector>

#include "session/allocation.h"
#include "session/block_grid.h"
#include "session/sample_counts.h"

namespace tyndall {

/// Rounds: each begins with a decision by what was rendered before, and brings the mean over the frame to 48, 64, 96, 128, 192
/// ... samples a pixel, after 32 for every one. A block's samples are a function of that mean, so that pictures do not depend
/// on how passes divide a round.
class SamplePlan {
 public:
  static constexpr int kPilot = 32;

  /// `most`: samples that any pixel may have.
  SamplePlan(const PixelBounds& crop, int most, const ErrorGoal& goal = {});

  const BlockGrid& grid() const { return grid_; }
  /// Where the round that holds the mean `n`, or begins there, ends; after the last round, the largest int.
  int round_end(int n) const;
  /// Whether the round that begins at `n` has still to be decided.
  bool is_open(int n) const { return n >= kPilot && n == end_ && n < most_; }
  /// Begin it. `blocks`: of grid(), without work and samples, which are known here.
  void decide(int n, std::vector<BlockNoise> blocks);

  /// Samples that a pixel of `block` has had when the mean is `n`, no further than the end of the round.
  int samples(std::size_t block, int n) const;
  SampleCounts counts(int n) const;
  /// Over all pixels.
  std::uint64_t total(int n) const;
  /// Each block by one thread at a time.
  void add_work(std::size_t block, std::uint64_t work) { work_[block] += work; }

  /// All that was decided and counted, for a checkpoint, in state_size() numbers; and back.
  std::vector<std::uint64_t> state() const;
  std::size_t state_size() const { return 2 + 3 * grid_.size(); }
  void restore(const std::vector<std::uint64_t>& state);

 private:
  BlockGrid grid_;
  int most_;
  ErrorGoal goal_;
  int begin_ = 0, end_ = kPilot;  ///< mean samples, of the round
  std::vector<int> had_, given_;  ///< samples by block: before the round, and in it
  std::vector<std::uint64_t> work_;
};

}  // namespace tyndall
