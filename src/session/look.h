/// A look at a few blocks of the picture before it is rendered, for what is decided by measurement.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "math/parallel.h"
#include "session/pixel_block.h"
#include "session/pixel_sample.h"
#include "transport/budget/light_trial.h"

namespace tyndall {

/// How a picture is rendered: what the options leave open is closed in them.
struct Decision {
  RenderSettings settings;
  std::optional<LightBudget> budget;  ///< nothing: no number was measured
};

/// Asked before each block that is looked at, by one thread at a time: whether to go on. Empty: yes.
using LookWatch = std::function<bool()>;
/// Thrown where it says no.
struct LookGivenUp {};

/// What a few of the frame's blocks would be like, and would cost. A function of the scene, the frame and the decision,
/// whatever part of the picture is rendered, and by whom; and of no random number that its samples use. Looks at the same frame
/// have the same pixels and random numbers.
class Look {
 public:
  /// Of `context` all but settings and budget; without what only pictures want. `context` and `pool` must outlive it.
  Look(const SampleContext& context, const Decision& decision, ThreadPool& pool, LookWatch watch = {});

  /// The first blocks of a sequence, those that are missing until now. Throws LookGivenUp, and is then of no use.
  void extend(std::size_t blocks);
  /// So many suffice for numbers of lights, and are a small share of the frame.
  static std::size_t usual_blocks(const Film& film);
  /// How many samples of the whole frame take as long as a look at so many blocks.
  static double samples_of(std::size_t blocks, const Film& film);

  const Decision& decision() const { return decision_; }
  /// What lights leave to chance in the first of its blocks, for best_budget().
  Trials trials(std::size_t blocks) const;
  const Counters& counters() const { return counters_; }

  /// The logarithm of variance x cost over that of another look, and its standard error by the jackknife over blocks.
  struct Ratio {
    double log, deviation;

    /// What choosing by the sign of `log` loses on average, where the truth is normal about it.
    double expected_loss() const;
  };
  /// Of the blocks that both have, two at least.
  Ratio over(const Look& other) const;

 private:
  /// One pixel.
  struct Pixel {
    double even = 0, odd = 0, squares = 0;  ///< of its samples' radiance
    LightTrial light;

    double mean() const;
    // Of its samples together, as `light` is.
    double variance() const;  ///< were they independent
    double error() const;     ///< as they are: even and odd samples are two sequences
    bool is_finite() const;
  };
  struct Block {
    std::vector<Pixel> pixels;
    Counters counters;
    double cost = 0;  ///< ns (Prices), without what only LightTrial wants

    double mean() const;
    double error(double unit) const;
  };
  Block try_block(std::size_t number) const;

  const SampleContext& context_;
  ThreadPool& pool_;
  LookWatch watch_;
  Decision decision_;
  std::vector<Block> blocks_;
  Counters counters_;  ///< of all
};

}  // namespace tyndall
