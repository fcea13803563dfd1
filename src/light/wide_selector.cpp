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

LightCut everything() {
  LightCut cut;
  cut.push_back({kEverything, 1});
  return cut;
}

}  // namespace

template <typename Query>
LightCut WideSelector::split(const Query& query, const CutSettings& settings) const {
  LightCut cut;
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

LightCut WideSelector::cut(const PointQuery& query, const CutSettings& settings) const {
  return settings.candidates == 1 ? everything() : split(query, settings);
}
LightCut WideSelector::cut(const SegmentQuery& query, const CutSettings& settings) const {
  return settings.candidates == 1 ? everything() : split(Segment(query), settings);
}

template <typename Query>
std::optional<SelectedLight> WideSelector::draw(const LightCluster& cluster, const Query& query, double u) const {
  const auto answer = [](const auto& choice) -> std::optional<SelectedLight> {
    if (!choice) return std::nullopt;
    return SelectedLight{choice->light, static_cast<float>(choice->pmf)};
  };
  if (cluster.ref == kFarCluster) return answer(far().select(query, u));
  return answer(tree().select_below(cluster.ref, tree().localize(query), u));
}

/// Up from the leaf to the cluster of the cut that holds it.
template <typename Query>
double WideSelector::expected_near(const LightCut& cut, const Query& query, std::uint32_t leaf) const {
  for (auto ref = leaf;; ref = tree().nodes()[ref / WideNode::kWidth].parent) {
    if (const LightCluster* c = find(cut, ref)) return c->candidates * tree().pmf_below(ref, leaf, tree().localize(query));
    if (ref == WideLightTree::kAll) return 0;
  }
}

template <typename Query>
float WideSelector::tries(const LightCut& cut, const Query& query, LightId light) const {
  const std::uint32_t slot = slot_of(light);
  if (slot == kDark) return 0;
  if (slot < kFar) return static_cast<float>(expected_near(cut, query, slot));
  const LightCluster* c = find(cut, kFarCluster);
  return c ? static_cast<float>(c->candidates * far().pmf(query, slot - kFar)) : 0.0f;
}

std::optional<SelectedLight> WideSelector::select_in(const LightCluster& cluster, const PointQuery& query, double u) const {
  return cluster.ref == kEverything ? select(query, u) : draw(cluster, query, u);
}
std::optional<SelectedLight> WideSelector::select_in(const LightCluster& cluster, const SegmentQuery& query, double u) const {
  return cluster.ref == kEverything ? select(query, u) : draw(cluster, Segment(query), u);
}

float WideSelector::expected(const LightCut& cut, const PointQuery& query, LightId light) const {
  return find(cut, kEverything) ? pmf(query, light) : tries(cut, query, light);
}
float WideSelector::expected(const LightCut& cut, const SegmentQuery& query, LightId light) const {
  return find(cut, kEverything) ? pmf(query, light) : tries(cut, Segment(query), light);
}

}  // namespace tyndall
