#include "light/tree_selector.h"

#include <algorithm>

#include "math/below_one.h"

namespace tyndall {
namespace {

/// Neither the tree nor the lights at infinity get less than this while they have any importance: the root's bound
/// says little about the lights near a point inside it.
constexpr double kLeastShare = 0.1;

}  // namespace

template <typename Tree>
TreeSelector<Tree>::TreeSelector(Tree tree, const SelectionInput& input)
    : tree_(std::move(tree)), far_(input.far), slot_(input.power.size(), kDark) {
  for (std::uint32_t i = 0; i < input.far.size(); ++i) slot_[input.far[i].light] = kFar + i;
  tree_.for_each_leaf([&](LightId light, std::uint32_t leaf) { slot_[light] = leaf; });
}

template <typename Tree>
template <typename Query>
typename TreeSelector<Tree>::Shares TreeSelector<Tree>::divide(const Query& query) const {
  if (far_.empty()) return {1, 0};
  const double near = tree_.importance(query), far = far_.importance(query);
  if (near == 0 || far == 0) return {near > 0 ? 1.0 : 0.0, far > 0 ? 1.0 : 0.0};
  const double share = std::clamp(far / (near + far), kLeastShare, 1 - kLeastShare);
  return {1 - share, share};
}

template <typename Tree>
template <typename Query>
std::optional<SelectedLight> TreeSelector<Tree>::choose(const Query& query, double u) const {
  const Shares share = shares(query);
  if (u < share.near) {
    const auto choice = tree_.select(query, std::min(u / share.near, kBelowOne));
    if (!choice) return std::nullopt;
    return SelectedLight{choice->light, static_cast<float>(share.near * choice->pmf)};
  }
  if (!(share.far > 0)) return std::nullopt;
  const auto choice = far_.select(query, std::min((u - share.near) / share.far, kBelowOne));
  if (!choice) return std::nullopt;
  return SelectedLight{choice->light, static_cast<float>(share.far * choice->pmf)};
}

template <typename Tree>
template <typename Query>
float TreeSelector<Tree>::chance(const Query& query, LightId light) const {
  const std::uint32_t slot = slot_of(light);
  if (slot == kDark) return 0;
  const Shares share = shares(query);
  if (slot >= kFar) return share.far > 0 ? static_cast<float>(share.far * far_.pmf(query, slot - kFar)) : 0.0f;
  return share.near > 0 ? static_cast<float>(share.near * tree_.pmf(query, slot)) : 0.0f;
}

template <typename Tree>
typename TreeSelector<Tree>::Shares TreeSelector<Tree>::shares(const PointQuery& query) const {
  return divide(query);
}
template <typename Tree>
typename TreeSelector<Tree>::Shares TreeSelector<Tree>::shares(const Segment& query) const {
  return divide(query);
}
template <typename Tree>
std::optional<SelectedLight> TreeSelector<Tree>::select(const PointQuery& query, double u) const {
  return choose(query, u);
}
template <typename Tree>
std::optional<SelectedLight> TreeSelector<Tree>::select(const SegmentQuery& query, double u) const {
  return choose(Segment(query), u);
}
template <typename Tree>
float TreeSelector<Tree>::pmf(const PointQuery& query, LightId light) const {
  return chance(query, light);
}
template <typename Tree>
float TreeSelector<Tree>::pmf(const SegmentQuery& query, LightId light) const {
  return chance(Segment(query), light);
}

template <typename Tree>
std::size_t TreeSelector<Tree>::memory_bytes() const {
  return tree_.memory_bytes() + far_.memory_bytes() + slot_.capacity() * sizeof(slot_[0]);
}

template class TreeSelector<LightTree>;
template class TreeSelector<WideLightTree>;
template class TreeSelector<InstancedLightTree>;

}  // namespace tyndall
