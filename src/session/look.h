/// A look at a few blocks of the picture before it is rendered, for what is decided by measurement.
#pragma once

#include <functional>
#include <vector>

#include "math/parallel.h"
#include "session/decision.h"
#include "session/pixel_block.h"
#include "session/pixel_sample.h"
#include "session/searched_film.h"
#include "transport/budget/light_trial.h"

namespace tyndall {

/// Asked before each block that is looked at, by one thread at a time: whether to go on. Empty: yes.
using LookWatch = std::function<bool()>;
/// Thrown where it says no.
struct LookGivenUp {};

/// What all looks of a render share. All that it refers to must outlive them.
struct Looks {
  const SampleContext& context;  ///< its settings are those that are decided on
  const SearchedFilm& searched;  ///< of the whole frame
  ThreadPool& pool;
  LookWatch watch{};
};

/// What a few of the frame's blocks would be like, and would cost. A function of the scene, the frame and the decision,
/// whatever part of the picture is rendered, and by whom; and of no random number that its samples use. Looks at the same frame
/// have the same pixels and random numbers.
class Look {
 public:
  Look(const Looks& looks, const Decision& decision) : looks_(looks), decision_(decision) {}

  /// The first blocks of a sequence, those that are missing until now. Throws LookGivenUp, and is then of no use.
  void extend(std::size_t blocks);
  /// So many suffice for numbers of lights, and are a small share of the frame.
  static std::size_t usual_blocks(const Film& film);
  /// And so many cost next to nothing.
  static std::size_t first_blocks(const Film& film);
  /// How many samples of the whole frame take as long as a look at so many blocks.
  static double samples_of(std::size_t blocks, const Film& film);

  const Decision& decision() const { return decision_; }
  const Film& film() const { return looks_.context.world.built.scene.film; }
  /// What lights leave to chance in the first of its blocks, for best_budget().
  Trials trials(std::size_t blocks) const;
  const Counters& counters() const { return counters_; }

  /// The logarithm of variance x cost over that of another look, its standard error by the jackknife over blocks, and the cost
  /// over that of the other.
  struct Ratio {
    double log, deviation, cost = 1;

    /// Of the ratio's mean, where the truth is normal about `log`.
    double log_of_mean() const { return log + 0.5 * deviation * deviation; }
    /// What choosing by the sign of `log` loses on average, likewise.
    double expected_loss() const;
  };
  /// Of the blocks that both have, two at least.
  Ratio over(const Look& other) const;

 private:
  /// One pixel.
  struct Pixel {
    Rgb even, odd;       ///< sums of its samples' radiance
    double squares = 0;  ///< of the channels' mean, likewise
    LightTrial light;

    double sum() const;
    double mean() const;
    // Of its samples together, as `light` is.
    double variance() const;          ///< of the channels' mean, were they independent
    double error(int channel) const;  ///< as they are: even and odd samples are two sequences
    bool is_finite() const;
  };
  struct Block {
    std::vector<Pixel> pixels;
    Counters counters;
    double cost = 0;  ///< ns (Prices), without what only LightTrial wants

    Rgb mean() const;
    std::vector<double> errors(Rgb mean, const Film& film) const;  ///< of each pixel
  };
  Block try_block(std::size_t number) const;

  const Looks& looks_;
  Decision decision_;
  std::vector<Block> blocks_;
  Counters counters_;  ///< of all
};

}  // namespace tyndall
