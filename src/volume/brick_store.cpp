#include "volume/brick_store.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// Interpolation rounds a few times; ranges are widened by this much of their magnitude.
constexpr float kWiden = 0x1p-21f;

float wider_max(float v) { return v + std::abs(v) * kWiden; }
float wider_min(float v) { return v - std::abs(v) * kWiden; }

}  // namespace

ValueRange range_of_cells(const float* corner, int cells) {
  constexpr int kY = BrickStore::kVoxelSide, kZ = kY * kY;
  // In the mean over cells the outer layers of voxels count half: they belong to one cell only.
  const auto weight = [&](int i) { return i == 0 || i == cells ? 0.5 : 1.0; };
  float low = *corner, high = *corner;
  double sum = 0;
  for (int z = 0; z <= cells; ++z)
    for (int y = 0; y <= cells; ++y)
      for (int x = 0; x <= cells; ++x) {
        const float voxel = corner[z * kZ + y * kY + x];
        low = std::min(low, voxel);
        high = std::max(high, voxel);
        sum += weight(x) * weight(y) * weight(z) * voxel;
      }
  return {wider_min(low), wider_max(high), static_cast<float>(sum / (cells * cells * cells))};
}

BrickStore::BrickStore(int channels, bool floats) : channels_(channels), floats_only_(floats) {
  add_slot();
  const float zeros[kMaxChannels] = {};
  ChannelRanges ranges;
  add_constant(zeros, ranges);
}

std::size_t BrickStore::memory_bytes() const {
  return planes_.capacity() * sizeof(Plane) + steps_.capacity() * sizeof(std::uint16_t) + floats_.capacity() * sizeof(float);
}

void BrickStore::shrink_to_fit() {
  planes_.shrink_to_fit();
  steps_.shrink_to_fit();
  floats_.shrink_to_fit();
}

std::uint32_t BrickStore::add_constant(const float* values, ChannelRanges& ranges) {
  for (int c = 0; c < channels_; ++c) {
    planes_.push_back({static_cast<std::uint32_t>(c), {values[c], 0}});
    ranges[static_cast<std::size_t>(c)] = {values[c], values[c], values[c]};
  }
  return static_cast<std::uint32_t>(size() - 1);
}

std::uint32_t BrickStore::add(float* voxels, ChannelRanges& ranges) {
  std::uint32_t plane = add_slot() * static_cast<std::uint32_t>(channels_);
  for (int c = 0; c < channels_; ++c, ++plane) {
    float* channel = voxels + c * kVoxels;
    const std::size_t to = std::size_t{plane} * kVoxels;
    if (floats_only_) {
      std::copy_n(channel, kVoxels, floats_.data() + to);
      planes_.push_back({plane, {0, 1}});
    } else {
      planes_.push_back({plane, quantise(channel, steps_.data() + to)});
    }
    ranges[static_cast<std::size_t>(c)] = range_of_cells(channel, kSide);
  }
  return static_cast<std::uint32_t>(size() - 1);
}

std::uint32_t BrickStore::add_slot() {
  const std::size_t count = kVoxels * static_cast<std::size_t>(channels_);
  const std::size_t slot = (floats_only_ ? floats_.size() : steps_.size()) / count;
  if (floats_only_)
    floats_.resize(floats_.size() + count, 0.0f);
  else
    steps_.resize(steps_.size() + count, 0);
  return static_cast<std::uint32_t>(slot);
}

/// 16-bit steps over [low, high]; 0 is one of the steps when it lies between.
BrickStore::Decode BrickStore::quantiser(float low, float high) {
  if (low >= 0) return {low, static_cast<float>((double{high} - low) / 65535)};
  const auto step = static_cast<float>((double{high} - low) / 65534);
  if (high < 0 || step == 0) return {low, step};
  const auto below = static_cast<float>(std::ceil(-double{low} / step));
  return {-(below * step), step};
}

BrickStore::Decode BrickStore::quantise(float* voxels, std::uint16_t* steps) {
  const auto [low, high] = std::minmax_element(voxels, voxels + kVoxels);
  const Decode d = quantiser(*low, *high);
  const double inverse = d.step > 0 ? 1 / double{d.step} : 0;
  for (std::size_t i = 0; i < kVoxels; ++i) {
    const double q = (double{voxels[i]} - d.low) * inverse + 0.5;  // never below 0: truncation rounds down
    steps[i] = static_cast<std::uint16_t>(std::min(q, 65535.0));
    voxels[i] = d.low + d.step * static_cast<float>(steps[i]);
  }
  return d;
}

}  // namespace tyndall
