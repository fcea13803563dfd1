/// Choice by the wide light tree, from cuts that find near lights or are split by score.
#pragma once

#include "light/tree_selector.h"

namespace tyndall {

/// `Tree` is WideLightTree or InstancedLightTree.
template <typename Tree>
class WideSelector final : public TreeSelector<Tree> {
 public:
  using TreeSelector<Tree>::TreeSelector;

  LightCut cut(const PointQuery& query, const CutSettings& settings) const override;
  LightCut cut(const SegmentQuery& query, const CutSettings& settings) const override;
  LightCandidates draw(const LightCut& cut, const PointQuery& query, double u) const override;
  LightCandidates draw(const LightCut& cut, const SegmentQuery& query, double u) const override;
  float n_pmf(const LightCut& cut, const PointQuery& query, LightId light) const override;
  float n_pmf(const LightCut& cut, const SegmentQuery& query, LightId light) const override;

 private:
  template <typename Query>
  LightCut split(const Query& query, const CutSettings& settings) const;
  template <typename Query>
  LightCandidates draw_all(const LightCut& cut, const Query& query, double u) const;
  template <typename Query>
  double n_pmf_near(const LightCut& cut, const Query& query, std::uint32_t leaf) const;
  template <typename Query>
  float n_pmf_of_all(const LightCut& cut, const Query& query, LightId light) const;

  using TreeSelector<Tree>::far;
  using TreeSelector<Tree>::tree;
};

extern template class WideSelector<WideLightTree>;
extern template class WideSelector<InstancedLightTree>;

}  // namespace tyndall
