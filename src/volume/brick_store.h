/// The voxels of bricks: 9x9x9 of them a channel, stored in 16 bits or as floats, read trilinearly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "volume/trilinear.h"

namespace tyndall {

/// Bounds and mean over the cells of a brick or node, of one channel. min and max hold for every interpolated look-up.
struct ValueRange {
  float min = 0, max = 0, mean = 0;
};
inline constexpr int kMaxChannels = 6;
using ChannelRanges = std::array<ValueRange, kMaxChannels>;

/// Of the trilinear interpolant over cells^3 cells, `corner` being the first of their voxels within a brick's 9^3.
ValueRange range_of_cells(const float* corner, int cells);

class BrickStore {
 public:
  static constexpr std::uint32_t kNothing = 0;  ///< a brick of 0, there from the start
  static constexpr int kSide = kBrickCells, kVoxelSide = kBrickVoxels, kVoxels = 729;

  BrickStore() : BrickStore(1, false) {}
  BrickStore(int channels, bool floats);

  int channels() const { return channels_; }
  std::size_t size() const { return planes_.size() / static_cast<std::size_t>(channels_); }
  std::size_t memory_bytes() const;

  /// Append a brick; `voxels` holds kVoxels values for each channel, x fastest, and is left with the decoded ones.
  /// 16-bit steps divide the range of the brick: the error is below 2^-16 of it, and 0 stays exactly 0.
  std::uint32_t add(float* voxels, ChannelRanges& ranges);
  /// Append a brick of one value a channel; it costs no voxels.
  std::uint32_t add_constant(const float* values, ChannelRanges& ranges);
  bool is_constant(std::uint32_t brick) const { return plane(brick, 0).number == 0; }
  /// Where the brick's voxels are kept: 1, 2 ... in the order of add(), or 0, which stands for every brick of one value.
  std::uint32_t slot(std::uint32_t brick) const { return plane(brick, 0).number / static_cast<std::uint32_t>(channels_); }
  float constant(std::uint32_t brick, int channel) const { return plane(brick, channel).decode.low; }
  void shrink_to_fit();

  /// value = low + step * (interpolated stored number).
  struct Decode {
    float low = 0, step = 0;
  };
  /// One channel of one brick: kVoxels stored numbers, and what they mean.
  struct Plane {
    std::uint32_t number = 0;  ///< slot * channels + channel; slot 0 is all zero
    Decode decode;
  };
  const Plane& plane(std::uint32_t brick, int channel) const {
    return planes_[std::size_t{brick} * static_cast<std::size_t>(channels_) + static_cast<std::size_t>(channel)];
  }
  /// Trilinear value.
  float read(const Plane& plane, const BrickPoint& point) const {
    const std::size_t at = std::size_t{plane.number} * kVoxels;
    const float stored = floats_only_ ? point.interpolate(floats_.data() + at) : point.interpolate(steps_.data() + at);
    return plane.decode.low + plane.decode.step * stored;
  }
  /// Of eight points.
  Float8 read(const Plane& plane, const BrickPoints& points) const {
    const std::size_t at = std::size_t{plane.number} * kVoxels;
    const Float8 stored = floats_only_ ? points.interpolate(floats_.data() + at) : points.interpolate(steps_.data() + at);
    return plane.decode.low + plane.decode.step * stored;
  }

  /// Trilinear value of the first channel at an offset in [0,8]^3 from the brick's lower corner; clamped to it.
  float lookup(std::uint32_t brick, float x, float y, float z) const { return read(plane(brick, 0), {x, y, z}); }
  void lookup_all(std::uint32_t brick, float x, float y, float z, float* out) const {
    const BrickPoint point(x, y, z);
    for (int c = 0; c < channels_; ++c) out[c] = read(plane(brick, c), point);
  }

 private:
  static Decode quantiser(float low, float high);
  static Decode quantise(float* voxels, std::uint16_t* steps);
  std::uint32_t add_slot();

  int channels_;
  bool floats_only_;
  std::vector<Plane> planes_;         // channels_ a brick
  std::vector<std::uint16_t> steps_;  // kVoxels a plane
  std::vector<float> floats_;         // instead of steps_
};

}  // namespace tyndall
