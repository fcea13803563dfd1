/// Choice by the wide light tree, with adaptive splitting.
#pragma once

#include "light/tree_selector.h"

namespace tyndall {

class WideSelector final : public TreeSelector<WideLightTree> {
 public:
  using TreeSelector::TreeSelector;

  LightCut cut(const PointQuery& query, const CutSettings& settings) const override;
  std::optional<SelectedLight> select_in(const LightCluster& cluster, const PointQuery& query, double u) const override;
  float expected(const LightCut& cut, const PointQuery& query, LightId light) const override;

 private:
  double pmf_in_cut(const LightCut& cut, const PointQuery& query, std::uint32_t leaf) const;
};

}  // namespace tyndall
