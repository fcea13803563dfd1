/// Which brick lies where, as a plain array: one read finds it, without a branch, where the tree would take several.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "volume/brick_store.h"

namespace tyndall {

/// A box of bricks from the grid's lower corner. Made only for grids that fill their box well enough.
class BrickDirectory {
 public:
  using Size = std::array<std::int64_t, 3>;  ///< in bricks
  /// A brick, and where the voxels of its first channel are and how they are read.
  struct Entry {
    std::uint32_t brick = 0;
    BrickStore::Plane plane;
  };

  BrickDirectory() = default;
  /// All of it `nothing`. Stays empty() where it would be large beside the voxels of so many `bricks`.
  BrickDirectory(const Size& size, std::size_t bricks, const Entry& nothing) {
    constexpr double kEntriesEach = 8, kAtLeast = 4096;  // the voxels of a brick take as much as 91 entries
    const double entries = double(size[0]) * double(size[1]) * double(size[2]);
    if (entries > kAtLeast + kEntriesEach * double(bricks)) return;
    for (std::size_t i = 0; i < 3; ++i) size_[i] = static_cast<std::uint32_t>(size[i]);
    entries_.assign(static_cast<std::size_t>(entries), nothing);
  }

  bool empty() const { return entries_.empty(); }
  std::uint32_t size(std::size_t axis) const { return size_[axis]; }
  const Entry& at(std::uint32_t x, std::uint32_t y, std::uint32_t z) const { return entries_[index(x, y, z)]; }
  void set(std::uint32_t x, std::uint32_t y, std::uint32_t z, const Entry& entry) { entries_[index(x, y, z)] = entry; }
  std::size_t memory_bytes() const { return entries_.capacity() * sizeof(Entry); }

 private:
  std::size_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return (std::size_t{z} * size_[1] + y) * size_[0] + x;
  }

  std::array<std::uint32_t, 3> size_{};
  std::vector<Entry> entries_;  // x fastest
};

}  // namespace tyndall
