/// What EmissiveBricks is made of, and how it is found. Only src/volume sees it.
#pragma once

#include <cstdint>
#include <vector>

#include "volume/cell_walk.h"
#include "volume/medium.h"

namespace tyndall {

struct EmissiveBrickData {
  static constexpr int kBlocks = 4;  ///< a side of a brick
  static constexpr std::size_t kBlocksInBrick = 64;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr std::size_t block_index(int x, int y, int z) {
    return static_cast<std::size_t>((z * kBlocks + y) * kBlocks + x);
  }

  // Local coordinates: a block is a unit cube, the corner of the box of bricks the origin.
  Affine to_local;
  Transform to_world;
  double block_volume = 1;           ///< world space
  Cell size{};                       ///< of the box of bricks, in bricks
  std::vector<std::uint32_t> index;  ///< by place in the box; kNone
  std::vector<Cell> places;          ///< by brick
  std::vector<float> intensities;    ///< by brick
  std::vector<float> cumulative;     ///< kBlocksInBrick a brick: probability of this block and those before it

  std::size_t index_of(const Cell& place) const {
    const auto at = [&](std::size_t i) { return static_cast<std::size_t>(place[i]); };
    return (at(2) * static_cast<std::size_t>(size[1]) + at(1)) * static_cast<std::size_t>(size[0]) + at(0);
  }
  /// Density in a block, 1/volume.
  double density(std::uint32_t brick, std::size_t block) const {
    const float* c = cumulative.data() + brick * kBlocksInBrick;
    return (double{c[block]} - (block > 0 ? double{c[block - 1]} : 0.0)) / block_volume;
  }
};

/// At most `most` bricks.
EmissiveBrickData find_emissive_bricks(const ParticipatingMedium& medium, std::size_t most);

}  // namespace tyndall
