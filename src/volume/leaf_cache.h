/// The leaves of a source that were read last.
#pragma once

#include <cstdint>
#include <vector>

#include "volume/voxel_source.h"

namespace tyndall {

/// A leaf reaches into up to 8 bricks, which follow each other closely.
class LeafCache {
 public:
  LeafCache(const VoxelSource& source, const VoxelRules& rules) : source_(source), rules_(rules), entries_(kEntries) {}

  /// As read_leaf() gives them and the rules keep them; valid until the next call.
  const float* values(std::uint32_t leaf) {
    Entry& entry = entries_[leaf % kEntries];
    if (entry.leaf != leaf) {
      entry.leaf = leaf;
      entry.values.resize(VoxelSource::kLeafVoxels * static_cast<std::size_t>(source_.channels()));
      source_.read_leaf(leaf, entry.values.data());
      for (float& value : entry.values) value = rules_.kept(value);
    }
    return entry.values.data();
  }

 private:
  static constexpr std::uint32_t kEntries = 1024;
  struct Entry {
    std::uint32_t leaf = VoxelBlock::kConstant;
    std::vector<float> values;
  };

  const VoxelSource& source_;
  VoxelRules rules_;
  std::vector<Entry> entries_;
};

}  // namespace tyndall
