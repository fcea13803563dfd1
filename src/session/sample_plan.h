/// Which block of pixels takes which samples, where not all take the same.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "session/allocation.h"
#include "session/block_grid.h"

namespace tyndall {

/// Rounds that end at 8, 16, 24, 32, 48, 64, 96, 128 ... samples a pixel. In the first all blocks take as many; each other
/// begins with a decision by what was rendered before it, and takes the work of as many samples as it is long. Whatever a
/// block takes of it, its samples count as much together as those of any other, so that a picture is the mean of unbiased ones
/// with weights that no sample has decided.
class SamplePlan {
 public:
  /// Samples of the first round, and steps of the others, in which each block takes its part: an even number.
  static constexpr int kStep = 8;
  /// Samples that every pixel has before a render ends by its error.
  static constexpr int kLeast = 32;

  /// `most`: samples that any pixel may have.
  SamplePlan(const PixelBounds& crop, int most, const ErrorGoal& goal = {});

  /// Where the last round ends: the last step that `most` holds.
  static int last_end(int most) { return most < kStep ? most : most / kStep * kStep; }

  const BlockGrid& grid() const { return grid_; }
  /// Where the round that holds `n`, or begins there, ends; after the last round, the largest int.
  int round_end(int n) const;
  /// Where a pass that begins at `n` ends which shall be of `count` samples: at the end of a step, in the round.
  int pass_end(int n, int count) const;
  /// Whether the round that begins at `n` has still to be decided.
  bool is_open(int n) const { return n >= kStep && n == end_ && n < last_; }
  /// Whether no samples come any more.
  bool is_over(int n) const { return n >= last_; }
  /// Begin it. `noise`: of grid().
  void decide(int n, const std::vector<BlockNoise>& noise);

  /// Samples that a pixel of `block` has had at `n`, the end of a step and no further than the round.
  int samples(std::size_t block, int n) const;
  /// What each of them counts for in this round.
  float share(std::size_t block) const { return begin_ == 0 ? 1.0f : float{kStep} / static_cast<float>(taken_[block]); }
  /// samples() of every pixel, row by row.
  std::vector<int> counts(int n) const;
  /// The least and the most of them.
  std::pair<int, int> range(int n) const;
  /// Over all pixels.
  std::uint64_t total(int n) const;
  /// Each block by one thread at a time.
  void add_work(std::size_t block, std::uint64_t work) { work_[block] += work; }

  /// All that was decided and counted, for a checkpoint, in state_size() numbers; and back.
  std::vector<std::uint64_t> state() const;
  std::size_t state_size() const { return 2 + 4 * grid_.size(); }
  void restore(const std::vector<std::uint64_t>& state);

 private:
  void end_round();
  /// Of the blocks, each with those around it.
  struct Known {
    std::vector<double> variance;  ///< relative, of a sample
    std::vector<double> error;     ///< relative variance of the mean so far
    double mean;                   ///< of the latter, over all pixels
  };
  Known known(const std::vector<BlockNoise>& noise) const;
  std::vector<BlockShare> shares(const Known& known) const;
  BlockShare bounds_of(std::size_t block, double expected_end) const;
  double expected_end(double mean, double worst) const;
  int needed_for_worst(double variance, double spread) const;

  BlockGrid grid_;
  int most_, last_;
  ErrorGoal goal_;
  int begin_ = 0, end_;           ///< of the round
  std::vector<int> had_, taken_;  ///< samples by block: before the round, and in each of its steps
  std::vector<double> spread_;    ///< sum of the squares of what they count for
  std::vector<std::uint64_t> work_;
};

}  // namespace tyndall
