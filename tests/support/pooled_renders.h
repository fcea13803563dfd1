/// Several methods for one picture, rendered with the same seeds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/measure.h"

namespace tyndall::test {

struct Contender {
  std::string name, scene;
  Variant variant = {};
};

/// Contenders rendered round by round, each held against the mean of the others in its rounds. One that is known well enough
/// drops out; the first two stay to the end, so that there is always something to be held against.
class PooledRenders {
 public:
  PooledRenders(const std::vector<Contender>& contenders, std::uint64_t first_seed);

  /// False: all differences are `known`, or have had their `seconds` of processor time, or there have been enough rounds.
  bool next_round(const std::function<bool(const MeanImage& difference)>& known, double seconds);

  const Subject& subject(std::size_t i) const { return members_[i].subject; }
  /// From the mean of the others.
  MeanImage difference(std::size_t i) const { return members_[i].difference.result(); }
  double pooled_mean(int channel) const;
  Measured effort(std::size_t i) const;

 private:
  struct Member {
    Subject subject;
    MeanImageBuilder difference{};
    bool known = false;
    double seconds = 0;
  };
  void render_round();

  std::vector<Member> members_;
  MeanImageBuilder pool_;
  std::uint64_t seed_;
  int rounds_ = 0;
};

}  // namespace tyndall::test
