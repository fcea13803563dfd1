#include "light/wide_selector.h"

#include <algorithm>
#include <cmath>

#include "light/wide_cut.h"

namespace tyndall {
namespace {

// None of the tree's clusters; its own stay far below, but for the one of all lights.
constexpr std::uint32_t kFarCluster = 0xfffffffd;  ///< all lights at infinity

/// Bounds of clusters tell little of where a narrow lobe meets a light. Elsewhere one light is as good as several, and
/// what is left of the variance is in what lies between.
constexpr int kGlossyCandidates = 4;

const LightCluster* find(const LightCut& cut, std::uint32_t ref) {
  const auto it = std::find_if(cut.begin(), cut.end(), [ref](const LightCluster& c) { return c.ref == ref; });
  return it == cut.end() ? nullptr : it;
}

}  // namespace

template <typename Query>
LightCut WideSelector::split(const Query& query, int candidates, float splitting) const {
  const Shares share = shares(query);
  LightCut cut;
  if (share.near > 0) cut = wide_cut(tree(), query, {candidates, splitting});
  if (!(share.far > 0)) return cut;
  const double far = cut.empty() ? 1 : share.far;  // the tree as a whole may promise what none of its lights keeps
  if (candidates > 0) {
    for (LightCluster& c : cut) c.candidates *= static_cast<float>(share.near);
  }
  cut.push_back({kFarCluster, candidates > 0 ? static_cast<float>(far * candidates) : 1.0f});
  return cut;
}

LightCut WideSelector::cut(const PointQuery& query, const CutSettings& settings) const {
  return split(query, settings.candidates.value_or(query.glossy() ? kGlossyCandidates : 1), settings.splitting);
}
LightCut WideSelector::cut(const SegmentQuery& query, const CutSettings& settings) const {
  return split(Segment(query), settings.candidates.value_or(1), settings.splitting);
}

template <typename Query>
LightCandidates WideSelector::draw_all(const LightCut& cut, const Query& query, double u) const {
  LightCandidates drawn;
  SmallVector<WideLightTree::Draw, 16> draws;
  SmallVector<float, 16> tries;
  for_each_candidate(cut, u, [&](int, const LightCluster& cluster, double below) {
    if (cluster.ref != kFarCluster) {
      draws.push_back({cluster.ref, below});
      tries.push_back(cluster.candidates);
    } else if (const auto choice = far().select(query, below)) {
      drawn.push_back({choice->light, static_cast<float>(choice->pmf * cluster.candidates)});
    }
  });
  SmallVector<std::optional<WideLightTree::Choice>, 16> choices;
  for (std::size_t i = 0; i < draws.size(); ++i) choices.push_back({});
  tree().select_below(std::span<const WideLightTree::Draw>(draws.data(), draws.size()), tree().localize(query),
                      std::span(choices.data(), choices.size()));
  for (std::size_t i = 0; i < draws.size(); ++i) {
    if (choices[i]) drawn.push_back({choices[i]->light, static_cast<float>(choices[i]->pmf * tries[i])});
  }
  return drawn;
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

LightCandidates WideSelector::draw(const LightCut& cut, const PointQuery& query, double u) const { return draw_all(cut, query, u); }
LightCandidates WideSelector::draw(const LightCut& cut, const SegmentQuery& query, double u) const {
  return draw_all(cut, Segment(query), u);
}

float WideSelector::expected(const LightCut& cut, const PointQuery& query, LightId light) const { return tries(cut, query, light); }
float WideSelector::expected(const LightCut& cut, const SegmentQuery& query, LightId light) const {
  return tries(cut, Segment(query), light);
}

}  // namespace tyndall
