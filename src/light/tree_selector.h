/// Choice by a light tree, with the lights at infinity beside its root.
#pragma once

#include "light/instanced_light_tree.h"
#include "light/selection.h"
#include "light/wide_light_tree.h"

namespace tyndall {

/// `Tree` is LightTree, WideLightTree or InstancedLightTree. Queries inside are PointQuery and Segment.
template <typename Tree>
class TreeSelector : public LightSelector {
 public:
  TreeSelector(Tree tree, const SelectionInput& input);

  std::optional<SelectedLight> select(const PointQuery& query, double u) const override;
  std::optional<SelectedLight> select(const SegmentQuery& query, double u) const override;
  float pmf(const PointQuery& query, LightId light) const override;
  float pmf(const SegmentQuery& query, LightId light) const override;
  std::size_t memory_bytes() const override;

  const Tree& tree() const { return tree_; }

 protected:
  struct Shares {
    double near, far;  ///< probabilities of the tree and of the lights at infinity
  };
  // A leaf of the wide tree is 8 nodes + a child, and there are fewer nodes than lights / 4: leaves stay below kFar.
  static constexpr std::uint32_t kFar = 0x80000000;
  static constexpr std::uint32_t kDark = InstancedLightTree::kAll;

  Shares shares(const PointQuery& query) const;
  Shares shares(const Segment& query) const;
  const FarLights& far() const { return far_; }
  std::uint32_t slot_of(LightId light) const {
    if constexpr (std::is_same_v<Tree, InstancedLightTree>)
      if (light >= slot_.size()) return tree_.leaf_of(light);
    return slot_[light];
  }

 private:
  template <typename Query>
  Shares divide(const Query& query) const;
  template <typename Query>
  std::optional<SelectedLight> choose(const Query& query, double u) const;
  template <typename Query>
  float chance(const Query& query, LightId light) const;

  Tree tree_;
  FarLights far_;
  std::vector<std::uint32_t> slot_;  ///< by LightId, but for instances: leaf, or kFar + index of a far light, or kDark
};

extern template class TreeSelector<LightTree>;
extern template class TreeSelector<WideLightTree>;
extern template class TreeSelector<InstancedLightTree>;

}  // namespace tyndall
