/// A look at a few blocks of the picture before it is rendered, for what is decided by measurement.
#pragma once

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

/// What a few of the frame's blocks would be like, and would cost. A function of the scene, the frame and the decision,
/// whatever part of the picture is rendered, and by whom; and of no random number that its samples use. Looks at the same frame
/// have the same pixels and random numbers.
class Look {
 public:
  /// Of `context` all but settings and budget; without what only pictures want.
  Look(const SampleContext& context, const Decision& decision, ThreadPool& pool);

  const Decision& decision() const { return decision_; }
  /// What lights leave to chance, for best_budget().
  Trials trials() const;
  /// The frame is large enough to tell techniques apart, and for what that takes to be a small share of it.
  bool can_be_compared() const;
  /// Its variance x cost is less than `share` of that of `other`.
  bool beats(const Look& other, double share) const;
  const Counters& counters() const { return counters_; }

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
    double repeated = 0;  ///< ns (Prices) of what only LightTrial wants

    double mean() const;
  };
  static Block try_block(const SampleContext& context, const PixelBlock& block);
  std::vector<double> units(const Look& other) const;
  double error(const std::vector<double>& units) const;
  double mean_of_all() const;

  Decision decision_;
  std::vector<Block> blocks_;
  Counters counters_;  ///< of all
  double cost_ = 0;    ///< ns (Prices)
};

}  // namespace tyndall
