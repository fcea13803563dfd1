/// Several methods for one picture, rendered with the same seeds.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "support/measure.h"

namespace tyndall::test {

struct Contender {
  std::string name, scene;
  Variant variant = {};
  int times = 1;  ///< as many samples as the others: for what is noisy and cheap, as they are neither
};

/// Contenders rendered round by round, each held against the mean of the others in its rounds. One that is known well enough
/// drops out, but for the first of these, so that there is always something to be held against: name first what is cheap and
/// has little noise.
class PooledRenders {
 public:
  /// The factor by which the variance of a difference is still too large; at most 1: it is known.
  using Excess = std::function<double(const MeanImage& difference)>;

  PooledRenders(const std::vector<Contender>& contenders, std::uint64_t first_seed);

  /// False: all differences are known, or have had their `seconds` of processor time, or there have been enough samples.
  bool next_round(const Excess& excess, double seconds);

  const Subject& subject(std::size_t i) const { return members_[i].subject; }
  /// From the mean of the others.
  MeanImage difference(std::size_t i) const { return members_[i].difference.result(); }
  double pooled_mean(int channel) const;
  Measured effort(std::size_t i) const;

 private:
  struct Member {
    Subject subject;
    int times;
    MeanImageBuilder difference{};
    double excess = std::numeric_limits<double>::infinity();
    bool renders = true;  ///< in the next round
    double seconds = 0;
  };
  void render_round();

  std::vector<Member> members_;
  MeanImageBuilder pool_;
  std::uint64_t seed_;
  int spp_ = 1, rounds_ = 0;
};

}  // namespace tyndall::test
