/// The cut of lightcuts [Walter et al. 2005], made unbiased by stochastic representatives [Yuksel 2019]: a light for each of
/// its nodes, and all of them are summed.
///
/// The cut is a function of the query alone: bounds and representatives that are fixed when the tree is built choose it. Were
/// it chosen by the lights that are then summed, their sum would be biased.
#pragma once

#include "light/tree_selector.h"

namespace tyndall {

/// select() and pmf() are those of the whole tree: of one light where a cut has one node.
class LightcutsSelector final : public TreeSelector<LightTree> {
 public:
  LightcutsSelector(LightTree tree, const SelectionInput& input);

  /// Of at most `candidates` nodes. Lights at infinity stand beside them, each on its own while they are not more than that.
  LightCut cut(const PointQuery& query, const CutSettings& settings) const override;
  LightCut cut(const SegmentQuery& query, const CutSettings& settings) const override;
  LightCandidates draw(const LightCut& cut, const PointQuery& query, double u) const override;
  LightCandidates draw(const LightCut& cut, const SegmentQuery& query, double u) const override;
  float n_pmf(const LightCut& cut, const PointQuery& query, LightId light) const override;
  float n_pmf(const LightCut& cut, const SegmentQuery& query, LightId light) const override;
  bool sizes_cut() const override { return true; }
  std::size_t memory_bytes() const override;

 private:
  template <typename Query>
  LightCut cut_for(const Query& query, int most) const;
  template <typename Query>
  LightCandidates draw_each(const LightCut& cut, const Query& query, double u) const;
  template <typename Query>
  float chance_in(const LightCut& cut, const Query& query, LightId light) const;

  std::vector<std::uint32_t> representatives_;  ///< by node, a leaf below it
  std::vector<LightId> far_lights_;
};

}  // namespace tyndall
