/// The random numbers of one sample of one pixel.
#pragma once

#include <cstdint>

#include "math/hash.h"
#include "math/rng.h"
#include "math/sobol.h"
#include "tyndall/math.h"

namespace tyndall {

/// Which sample of the picture a stream belongs to.
struct SampleKey {
  std::uint64_t seed = 0;
  int x = 0, y = 0;  ///< pixel of the full frame, so that crops see the same numbers
  int sample = 0;
};

/// Padded, Owen-scrambled Sobol: each call takes a fresh pair of dimensions with an order and a scramble of its
/// own. Even and odd samples are two sequences scrambled independently, so that half the squared difference of
/// their means estimates the variance, which the samples of one sequence cannot (they are not independent).
/// A pure function of (key, step, call count within it): the same on any thread.
class Sampler {
 public:
  explicit Sampler(const SampleKey& key)
      : key_(hash(key.seed, static_cast<std::uint32_t>(key.x), static_cast<std::uint32_t>(key.y),
                  static_cast<std::uint32_t>(key.sample & 1))),
        index_(static_cast<std::uint32_t>(key.sample) >> 1) {}

  /// Goes on with the numbers of one step of a path, 1, 2, ...: they do not depend on how many the steps before it drew.
  void begin_step(int step) { block_ = static_cast<std::uint64_t>(step) << 32; }

  /// Uniform in [0, 1).
  float next_1d() { return to_unit(point_0(next_block())); }

  /// Uniform in [0, 1)^2, a (0,2)-sequence over the samples of a pixel.
  Vec2 next_2d() {
    const std::uint64_t block = next_block();
    const std::uint32_t index = shuffled_index(block);
    const auto scramble_0 = static_cast<std::uint32_t>(block >> 32);
    const auto scramble_1 = static_cast<std::uint32_t>(mix_bits(block));
    return {to_unit(owen_scramble(sobol_0(index), scramble_0)), to_unit(owen_scramble(sobol_1(index), scramble_1))};
  }

  /// Uniform in [0, 1) with 53 bits, the first 32 of them a Sobol dimension: walks down trees of millions of lights.
  double next_wide() {
    const std::uint64_t block = next_block();
    const std::uint64_t high = point_0(block);
    const std::uint64_t low = hash(block, index_) >> 43;
    return static_cast<double>((high << 21) | low) * 0x1p-53;
  }

  /// A sampler of its own for a step that draws a varying number of dimensions: its own, and those after it, stay the same.
  Sampler fork() { return Sampler(next_block(), index_); }

  /// A stream that leaves the other numbers as they are, for AOVs.
  Rng side_stream() const { return Rng(hash(key_, index_, 0x51deu)); }

  /// An independent stream for a loop of unknown length.
  Rng stream() { return Rng(hash(next_block(), index_, 0x5eedu)); }

 private:
  Sampler(std::uint64_t key, std::uint32_t index) : key_(key), index_(index) {}
  std::uint64_t next_block() { return hash(key_, ++block_); }
  std::uint32_t shuffled_index(std::uint64_t block) const { return owen_scramble(index_, static_cast<std::uint32_t>(block)); }
  std::uint32_t point_0(std::uint64_t block) const {
    return owen_scramble(sobol_0(shuffled_index(block)), static_cast<std::uint32_t>(block >> 32));
  }
  static float to_unit(std::uint32_t v) { return static_cast<float>(v >> 8) * 0x1p-24f; }

  std::uint64_t key_;
  std::uint32_t index_;
  std::uint64_t block_ = 0;
};

}  // namespace tyndall
