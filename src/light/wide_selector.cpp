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

template <typename Choice>
std::optional<SelectedLight> answer(const std::optional<Choice>& choice) {
  if (!choice) return std::nullopt;
  return SelectedLight{choice->light, static_cast<float>(choice->pmf)};
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
  if (cluster.ref == kFarCluster) return answer(far().select(query, u));
  return answer(tree().select_below(cluster.ref, tree().localize(query), u));
}

template <typename Query>
void WideSelector::draw_all(const LightCut& cut, const Query& query, std::span<const double> u,
                            std::span<std::optional<SelectedLight>> selected) const {
  SmallVector<WideLightTree::Draw, 16> draws;
  SmallVector<std::uint32_t, 16> places;
  std::uint32_t i = 0;
  for (const LightCluster& cluster : cut) {
    for (std::uint32_t k = 0; k < cluster.candidates; ++k, ++i) {
      if (cluster.ref == kFarCluster) {
        selected[i] = answer(far().select(query, u[i]));
      } else {
        draws.push_back({cluster.ref, u[i]});
        places.push_back(i);
      }
    }
  }
  SmallVector<std::optional<WideLightTree::Choice>, 16> choices;
  for (std::size_t k = 0; k < draws.size(); ++k) choices.push_back({});
  tree().select_below(std::span<const WideLightTree::Draw>(draws.data(), draws.size()), tree().localize(query),
                      std::span(choices.data(), choices.size()));
  for (std::size_t k = 0; k < draws.size(); ++k) selected[places[k]] = answer(choices[k]);
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

void WideSelector::select_all(const LightCut& cut, const PointQuery& query, std::span<const double> u,
                              std::span<std::optional<SelectedLight>> selected) const {
  if (find(cut, kEverything)) return LightSelector::select_all(cut, query, u, selected);
  draw_all(cut, query, u, selected);
}
void WideSelector::select_all(const LightCut& cut, const SegmentQuery& query, std::span<const double> u,
                              std::span<std::optional<SelectedLight>> selected) const {
  if (find(cut, kEverything)) return LightSelector::select_all(cut, query, u, selected);
  draw_all(cut, Segment(query), u, selected);
}

float WideSelector::expected(const LightCut& cut, const PointQuery& query, LightId light) const {
  return find(cut, kEverything) ? pmf(query, light) : tries(cut, query, light);
}
float WideSelector::expected(const LightCut& cut, const SegmentQuery& query, LightId light) const {
  return find(cut, kEverything) ? pmf(query, light) : tries(cut, Segment(query), light);
}

}  // namespace tyndall
