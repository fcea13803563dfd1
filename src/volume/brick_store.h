/// The voxels of bricks: 9x9x9 of them a channel, stored in 16 bits or as floats, read trilinearly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tyndall {

/// Bounds and mean over the cells of a brick or node, of one channel. min and max hold for every interpolated look-up.
struct ValueRange {
  float min = 0, max = 0, mean = 0;
};
inline constexpr int kMaxChannels = 6;
using ChannelRanges = std::array<ValueRange, kMaxChannels>;

class BrickStore {
 public:
  static constexpr int kSide = 8, kVoxelSide = 9, kVoxels = 729;

  BrickStore() : BrickStore(1, false) {}
  BrickStore(int channels, bool floats);

  int channels() const { return channels_; }
  std::size_t size() const { return slots_.size(); }
  std::size_t memory_bytes() const;

  /// Append a brick; `voxels` holds kVoxels values for each channel, x fastest, and is left with the decoded ones.
  /// 16-bit steps divide the range of the brick: the error is below 2^-16 of it, and 0 stays exactly 0.
  std::uint32_t add(float* voxels, ChannelRanges& ranges);
  /// Append a brick of one value a channel; it costs no voxels.
  std::uint32_t add_constant(const float* values, ChannelRanges& ranges);
  bool is_constant(std::uint32_t brick) const { return slot(brick) == 0; }
  /// Where the brick's voxels are kept: 1, 2 ... in the order of add(), or 0, which stands for every brick of one value.
  std::uint32_t slot(std::uint32_t brick) const { return slots_[brick]; }
  float constant(std::uint32_t brick, int channel) const { return decode(brick, channel).low; }
  void shrink_to_fit();

  /// Trilinear value of the first channel at an offset in [0,8]^3 from the brick's lower corner; clamped to it.
  float lookup(std::uint32_t brick, float x, float y, float z) const { return lookup(brick, 0, x, y, z); }
  void lookup_all(std::uint32_t brick, float x, float y, float z, float* out) const {
    for (int c = 0; c < channels_; ++c) out[c] = lookup(brick, c, x, y, z);
  }

 private:
  /// value = low + step * (interpolated stored number).
  struct Decode {
    float low = 0, step = 0;
  };
  struct Corner;

  static Decode quantiser(float low, float high);
  void quantise(float* voxels, std::uint16_t* steps);
  std::uint32_t add_slot();
  const Decode& decode(std::uint32_t brick, int channel) const {
    return decodes_[std::size_t{brick} * static_cast<std::size_t>(channels_) + static_cast<std::size_t>(channel)];
  }
  float lookup(std::uint32_t brick, int channel, float x, float y, float z) const;
  template <typename Stored>
  static float interpolate(const Stored* voxels, float fx, float fy, float fz);

  int channels_;
  bool floats_only_;
  std::vector<std::uint32_t> slots_;  // of each brick; slot 0 is all zero
  std::vector<Decode> decodes_;       // channels_ a brick
  std::vector<std::uint16_t> steps_;  // channels_ * kVoxels a slot
  std::vector<float> floats_;         // instead of steps_
};

// ------------------------------------------------------------------------------------------- look-ups, inline

/// Cell of a coordinate in [0,8] and the fraction inside it.
struct BrickStore::Corner {
  int cell;
  float fraction;
  explicit Corner(float x) {
    const float clamped = x > 0 ? (x < kSide ? x : float{kSide}) : 0.0f;
    const int i = static_cast<int>(clamped);
    cell = i < kSide ? i : kSide - 1;
    fraction = clamped - static_cast<float>(cell);
  }
};

template <typename Stored>
inline float BrickStore::interpolate(const Stored* voxels, float fx, float fy, float fz) {
  const auto at = [&](int i) { return static_cast<float>(voxels[i]); };
  constexpr int kY = kVoxelSide, kZ = kVoxelSide * kVoxelSide;
  const float low[4] = {at(0), at(kY), at(kZ), at(kY + kZ)};
  const float high[4] = {at(1), at(kY + 1), at(kZ + 1), at(kY + kZ + 1)};
  float x[4];
  for (int i = 0; i < 4; ++i) x[i] = low[i] + fx * (high[i] - low[i]);
  const float y0 = x[0] + fy * (x[1] - x[0]);
  const float y1 = x[2] + fy * (x[3] - x[2]);
  return y0 + fz * (y1 - y0);
}

inline float BrickStore::lookup(std::uint32_t brick, int channel, float x, float y, float z) const {
  const Corner cx(x), cy(y), cz(z);
  const int corner = (cz.cell * kVoxelSide + cy.cell) * kVoxelSide + cx.cell;
  const std::size_t plane =
      std::size_t{slots_[brick]} * static_cast<std::size_t>(channels_) + static_cast<std::size_t>(channel);
  const std::size_t at = plane * kVoxels + static_cast<std::size_t>(corner);
  const float stored = floats_only_ ? interpolate(floats_.data() + at, cx.fraction, cy.fraction, cz.fraction)
                                    : interpolate(steps_.data() + at, cx.fraction, cy.fraction, cz.fraction);
  const Decode& d = decode(brick, channel);
  return d.low + d.step * stored;
}

}  // namespace tyndall
