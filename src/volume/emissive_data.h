/// What EmissiveCells is made of, and how it is found. Only src/volume sees it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "volume/affine.h"
#include "volume/emissive_cells.h"
#include "volume/medium.h"

namespace tyndall {

/// Three whole numbers along the axes.
using Place = std::array<int, 3>;

struct EmissiveCellData {
  static constexpr int kBlocks = 4;  ///< along a side of a cell
  static constexpr int kNodes = kBlocks + 1;
  static constexpr std::size_t kNodesInCell = 125;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static constexpr std::size_t node(int x, int y, int z) { return static_cast<std::size_t>((z * kNodes + y) * kNodes + x); }
  static constexpr Place place_of_node(int i) { return {i % kNodes, i / kNodes % kNodes, i / (kNodes * kNodes)}; }
  using Lattice = std::array<float, kNodesInCell>;

  // Local coordinates: a cell is a unit cube, the corner of the box of cells the origin.
  Affine to_local;
  Transform to_world;
  double cell_volume = 1;              ///< world space
  Place size{};                        ///< of the box of cells
  std::vector<std::uint32_t> index;    ///< by place in the box; kNone
  std::vector<Place> places;           ///< by cell
  std::vector<float> intensities;      ///< by cell
  std::vector<float> powers;           ///< by cell
  std::vector<float> radiances;        ///< by cell
  std::vector<std::uint16_t> lattice;  ///< kNodesInCell a cell: the density of its points at the nodes, in any unit
  std::vector<float> totals;           ///< by cell: the same, integrated over blocks

  std::size_t index_of(const Place& place) const {
    const auto at = [&](std::size_t i) { return static_cast<std::size_t>(place[i]); };
    return (at(2) * static_cast<std::size_t>(size[1]) + at(1)) * static_cast<std::size_t>(size[0]) + at(0);
  }
  /// Of the next cell: `nodes`, and a tenth that is even.
  void append_lattice(const Lattice& nodes);
  const std::uint16_t* nodes_of(std::uint32_t cell) const { return lattice.data() + cell * kNodesInCell; }
};

/// At most `most` cells.
EmissiveCellData find_emissive_cells(const ParticipatingMedium& medium, const MediumReach& reach, std::size_t most);

/// None where the box is infinite.
EmissiveCellData homogeneous_cells(const ParticipatingMedium& medium, const MediumReach& reach);

/// Fills `radiances`; `sigma_t`: of each cell, mean of channels.
void gather_radiances(EmissiveCellData& cells, const std::vector<float>& sigma_t);

/// Fills `powers` likewise.
void gather_powers(EmissiveCellData& cells, const std::vector<float>& sigma_t);

/// Mean transmittance from the points of a segment of that optical depth to its end.
inline double mean_transmittance(double depth) { return depth > 0 ? -std::expm1(-depth) / depth : 1; }

}  // namespace tyndall
