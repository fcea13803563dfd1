/// Densities of choosing lights, kept for the cells of a grid: what clusters of lights may give, integrated over a cell when
/// the grid is built [Vevoda and Krivanek 2016].
#pragma once

#include <span>
#include <vector>

#include "light/far_lights.h"
#include "light/light_tree.h"

namespace tyndall {

/// A cell is a box of space and a facet: the directions of normals around one of the six axes, or none, for media and for
/// surfaces that let light through. Immutable, the same for any number of threads that build it.
class CellDensities {
 public:
  static constexpr std::uint32_t kLightsAtInfinity = 0xffffffff;  ///< as one cluster

  struct Cluster {
    std::uint32_t node;  ///< of the tree, or kLightsAtInfinity
    float below;         ///< chance of this one and of those before it; of the last 1
  };

  CellDensities(const LightTree& tree, const FarLights& far, const Bounds3& region, int threads);

  /// Of the query's cell, in the tree's order, those at infinity last. Empty: outside the grid, or nothing is known to reach
  /// it.
  std::span<const Cluster> at(const PointQuery& query) const;
  const Bounds3& box() const { return box_; }  ///< empty: there are no cells
  std::size_t memory_bytes() const { return clusters_.capacity() * sizeof(Cluster) + begins_.capacity() * sizeof(begins_[0]); }

  /// No grid of so many lights takes more.
  static std::size_t most_bytes(double lights);

 private:
  std::vector<Cluster> integrate(const LightTree& tree, const FarLights& far, std::size_t cell) const;
  std::array<PointQuery, 8> questions_in(std::size_t cell) const;
  std::size_t boxes() const { return resolution_[0] * resolution_[1] * resolution_[2]; }

  Bounds3 box_;
  std::array<std::size_t, 3> resolution_{1, 1, 1};
  std::vector<std::uint32_t> begins_;  ///< by cell, of its clusters; one more at the end
  std::vector<Cluster> clusters_;
};

}  // namespace tyndall
