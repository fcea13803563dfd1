/// Counter random numbers for loops whose length is not known (tracking, rejection).
#pragma once

#include <cstdint>

#include "math/hash.h"

namespace tyndall {

/// A stream of independent uniform numbers: splitmix64 over a counter, so that equal seeds give equal streams
/// on every machine and thread.
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() { return mix_bits(state_ += 0x9e3779b97f4a7c15ull); }
  /// Uniform in [0, 1), 24 bits.
  float uniform() { return unit_float(next()); }
  /// Uniform in [0, 1), 53 bits.
  double uniform_wide() { return static_cast<double>(next() >> 11) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

}  // namespace tyndall
