/// Where in depth the light of a deep image is told apart.
#pragma once

#include <cstdint>

#include "transport/world/built_world.h"

namespace tyndall {

/// Depths as CameraRays::depth() has them, infinite for what is behind everything. `count` equal bins hold the media, one more
/// is before and one behind them: bin 0 .. count + 1. In a bin surfaces stand apart, one place for all within 1/16 of a
/// doubling of depth; its media come before them.
class DepthBins {
 public:
  DepthBins(float near, float far, int count) : near_(near), far_(far), count_(count) {}
  /// About the media of a world, those without bounds as far as there are shapes; where there are none everything is in bin 0.
  DepthBins(const BuiltWorld& world, int count);

  float near() const { return near_; }
  float far() const { return far_; }
  int count() const { return count_; }

  int bin_of(float z) const;
  /// Where a bin begins; of bin 0 at 0, of count() + 2 at infinity.
  float edge(int bin) const;

  /// Keys of KeyedSums, in the order of depth.
  std::uint32_t media_key(int bin) const { return kFirstKey + (static_cast<std::uint32_t>(bin) << kPlaceBits); }
  std::uint32_t surface_key(float z) const;
  static int bin_of_key(std::uint32_t key) { return static_cast<int>((key - kFirstKey) >> kPlaceBits); }
  static bool is_media_key(std::uint32_t key) { return ((key - kFirstKey) & ((1u << kPlaceBits) - 1)) == 0; }

 private:
  static constexpr std::uint32_t kFirstKey = 0x10000000;  ///< bits of a normal float, and all keys after it
  static constexpr int kPlaceBits = 13;

  float near_, far_;
  int count_;
};

}  // namespace tyndall
