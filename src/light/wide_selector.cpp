#include "light/wide_selector.h"

#include <algorithm>
#include <cmath>

#include "light/wide_cut.h"

namespace tyndall {
namespace {

// Clusters that are none of the tree's; its own stay far below.
constexpr std::uint32_t kEverything = 0xfffffffe;  ///< near and far lights together: a single candidate needs no cut
constexpr std::uint32_t kFarCluster = 0xfffffffd;  ///< all lights at infinity

const LightCluster* find(const LightCut& cut, std::uint32_t ref) {
  const auto it = std::find_if(cut.begin(), cut.end(), [ref](const LightCluster& c) { return c.ref == ref; });
  return it == cut.end() ? nullptr : it;
}

}  // namespace

LightCut WideSelector::cut(const PointQuery& query, const CutSettings& settings) const {
  LightCut cut;
  if (settings.candidates == 1) {
    cut.push_back({kEverything, 1});
    return cut;
  }
  const Shares share = shares(query);
  CutSettings near = settings;
  if (share.far > 0) {
    const int all = std::max(settings.candidates, 1), most = share.near > 0 ? std::max(all - 1, 1) : all;
    const int far = std::clamp(static_cast<int>(std::lround(share.far * all)), 1, most);
    cut.push_back({kFarCluster, static_cast<std::uint32_t>(far)});
    if (settings.candidates > 0) near.candidates = settings.candidates - far;
  }
  if (share.near > 0) {
    for (const LightCluster& c : wide_cut(tree(), query, near)) cut.push_back(c);
  }
  return cut;
}

std::optional<SelectedLight> WideSelector::select_in(const LightCluster& cluster, const PointQuery& query, double u) const {
  if (cluster.ref == kEverything) return select(query, u);
  if (cluster.ref == kFarCluster) {
    const auto choice = far().select(query, u);
    if (!choice) return std::nullopt;
    return SelectedLight{choice->light, static_cast<float>(choice->pmf)};
  }
  const auto choice = tree().select_below(cluster.ref, tree().localize(query), u);
  if (!choice) return std::nullopt;
  return SelectedLight{choice->light, static_cast<float>(choice->pmf)};
}

/// Up from the leaf to the cluster of the cut that holds it.
double WideSelector::pmf_in_cut(const LightCut& cut, const PointQuery& query, std::uint32_t leaf) const {
  for (auto ref = leaf;; ref = tree().nodes()[ref / WideNode::kWidth].parent) {
    if (const LightCluster* c = find(cut, ref)) return c->candidates * tree().pmf_below(ref, leaf, tree().localize(query));
    if (ref == WideLightTree::kAll) return 0;
  }
}

float WideSelector::expected(const LightCut& cut, const PointQuery& query, LightId light) const {
  if (find(cut, kEverything)) return pmf(query, light);
  const std::uint32_t slot = slot_of(light);
  if (slot == kDark) return 0;
  if (slot < kFar) return static_cast<float>(pmf_in_cut(cut, query, slot));
  const LightCluster* c = find(cut, kFarCluster);
  return c ? static_cast<float>(c->candidates * far().pmf(query, slot - kFar)) : 0.0f;
}

}  // namespace tyndall
