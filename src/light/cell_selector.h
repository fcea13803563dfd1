/// Choice by densities that are kept for the cells of a grid [Vevoda and Krivanek 2016], the binary tree as defensive share.
#pragma once

#include "light/cell_densities.h"
#include "light/tree_selector.h"

namespace tyndall {

/// A point takes a cluster by its cell, and a light of it by the tree. Segments pass many cells: they choose by the tree alone.
class CellSelector final : public TreeSelector<LightTree> {
 public:
  CellSelector(LightTree tree, const SelectionInput& input);

  using TreeSelector::pmf;
  using TreeSelector::select;
  std::optional<SelectedLight> select(const PointQuery& query, double u) const override;
  float pmf(const PointQuery& query, LightId light) const override;
  std::size_t memory_bytes() const override { return TreeSelector::memory_bytes() + cells_.memory_bytes(); }

 private:
  using Clusters = std::span<const CellDensities::Cluster>;
  std::optional<LightId> choose_in(Clusters clusters, const PointQuery& query, double u) const;
  float pmf_in(Clusters clusters, const PointQuery& query, LightId light) const;
  double chance_in(Clusters clusters, const PointQuery& query, LightId light) const;

  CellDensities cells_;
};

}  // namespace tyndall
