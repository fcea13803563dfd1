/// Voxels that a BrickGrid is built from, whatever library or array they come from.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace tyndall {

/// Integer index coordinates; 64 bits, so that differences of 32-bit ones are safe.
using Index3 = std::array<std::int64_t, 3>;

/// Voxels lo..hi, both included.
struct VoxelBox {
  Index3 lo{0, 0, 0}, hi{-1, -1, -1};
  bool empty() const { return lo[0] > hi[0] || lo[1] > hi[1] || lo[2] > hi[2]; }
  bool contains(const VoxelBox& b) const;
  VoxelBox intersect(const VoxelBox& b) const;
  void expand(const VoxelBox& b);
  bool operator==(const VoxelBox&) const = default;
};

/// Some voxels of a source: a leaf of 8x8x8 at a multiple of 8, or a box of one value.
struct VoxelBlock {
  static constexpr std::uint32_t kConstant = std::numeric_limits<std::uint32_t>::max();
  VoxelBox box;
  std::uint32_t leaf = kConstant;  ///< what read_leaf() is asked for
  std::array<float, 6> value{};    ///< of a constant box, one a channel
};

/// What a grid holds where nothing was set. One that is no number is empty space.
class Background {
 public:
  using Values = std::array<float, 6>;  ///< one a channel
  explicit Background(const Values& stored)
      : stored_(stored), is_number_(std::all_of(stored.begin(), stored.end(), [](float v) { return std::isfinite(v); })) {}

  const Values& stored() const { return stored_; }
  /// 0 in empty space.
  Values values() const { return is_number_ ? stored_ : Values{}; }
  bool is_empty() const { return values() == Values{}; }
  /// Whether a voxel is not set.
  bool is(const Values& voxel) const {
    const auto same = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    return std::equal(voxel.begin(), voxel.end(), stored_.begin(), same);
  }
  /// What a voxel reads as.
  Values read(const Values& voxel) const { return is_number_ || !is(voxel) ? voxel : Values{}; }

 private:
  Values stored_;
  bool is_number_;
};

/// Where voxels come from. Those in no block are 0; where blocks overlap, the later one in the list counts.
class VoxelSource {
 public:
  static constexpr int kLeafSide = 8, kLeafVoxels = 512;

  virtual ~VoxelSource() = default;
  virtual int channels() const = 0;  ///< 1, 3 or 6
  virtual const std::vector<VoxelBlock>& blocks() const = 0;
  /// 512 values for each channel, channel by channel, x fastest.
  virtual void read_leaf(std::uint32_t leaf, float* out) const = 0;
};

/// nx*ny*nz voxels at indices 0.. with x fastest, one plain array a channel.
class DenseSource : public VoxelSource {
 public:
  DenseSource(std::array<int, 3> size, std::vector<std::vector<float>> planes);
  int channels() const override { return static_cast<int>(planes_.size()); }
  const std::vector<VoxelBlock>& blocks() const override { return blocks_; }
  void read_leaf(std::uint32_t leaf, float* out) const override;

 private:
  std::array<int, 3> size_;
  std::vector<std::vector<float>> planes_;
  std::vector<VoxelBlock> blocks_;
};

/// What to do with voxels that are no valid amount.
struct VoxelRules {
  bool negative_to_zero = true;     ///< densities; temperatures keep their sign
  bool sanitize = false;            ///< NaN and infinity to 0
  std::optional<VoxelBox> clip;     ///< voxels outside read 0
  Background::Values background{};  ///< such voxels are not set, so none is reported to be below 0

  /// What is kept of a value. One that is not finite has been reported by inspect() and only comes here to become 0.
  float kept(float value) const {
    if (!std::isfinite(value)) return 0;
    return value < 0 && negative_to_zero ? 0 : value;
  }
};

/// What is wrong with the voxels of a source, within the clip box.
struct VoxelReport {
  std::int64_t negative = 0, non_finite = 0;
  float lowest = 0;           ///< most negative value
  Index3 first_non_finite{};  ///< in block order
};
VoxelReport inspect(const VoxelSource& source, const VoxelRules& rules);

}  // namespace tyndall
