#include "light/wide_selector.h"

#include <algorithm>

#include "light/near_cut.h"
#include "light/wide_cut.h"

namespace tyndall {
namespace {

// None of the tree's clusters; its own stay far below, but for the one of all lights.
constexpr std::uint32_t kFarCluster = 0xfffffffd;  ///< all lights at infinity

const LightCluster* find(const LightCut& cut, std::uint32_t ref) {
  const auto it = std::find_if(cut.begin(), cut.end(), [ref](const LightCluster& c) { return c.ref == ref; });
  return it == cut.end() ? nullptr : it;
}

/// Without a limit every cluster keeps its candidate.
LightCut scaled(LightCut cut, float share, const CutSettings& settings) {
  if (settings.candidates == 0) return cut;
  for (LightCluster& c : cut) c.candidates *= share;
  return cut;
}

template <typename Tree>
LightCut cut_of_tree(const Tree& tree, const PointQuery& query, const CutSettings& settings, float share) {
  if (settings.near_lights) return near_cut(tree, query, share * static_cast<float>(settings.candidates));
  return scaled(wide_cut(tree, query, settings), share, settings);
}
// Among lights along a line the variance grows with the logarithm of how near the nearest is: nothing is to be found.
template <typename Tree>
LightCut cut_of_tree(const Tree& tree, const Segment& query, const CutSettings& settings, float share) {
  return scaled(wide_cut(tree, query, settings), share, settings);
}

}  // namespace

template <typename Tree>
template <typename Query>
LightCut WideSelector<Tree>::split(const Query& query, const CutSettings& settings) const {
  const auto share = this->shares(query);
  LightCut cut;
  if (share.near > 0) cut = cut_of_tree(tree(), query, settings, static_cast<float>(share.near));
  if (!(share.far > 0)) return cut;
  const double far_share = cut.empty() ? 1 : share.far;  // the tree as a whole may have importance where none of its lights has
  cut.push_back({kFarCluster, settings.candidates > 0 ? static_cast<float>(far_share * settings.candidates) : 1.0f});
  return cut;
}

template <typename Tree>
LightCut WideSelector<Tree>::cut(const PointQuery& query, const CutSettings& settings) const {
  return split(query, settings);
}
template <typename Tree>
LightCut WideSelector<Tree>::cut(const SegmentQuery& query, const CutSettings& settings) const {
  return split(Segment(query), settings);
}

template <typename Tree>
template <typename Query>
LightCandidates WideSelector<Tree>::draw_all(const LightCut& cut, const Query& query, double u) const {
  LightCandidates drawn;
  SmallVector<WideLightTree::Draw, 16> draws;
  SmallVector<float, 16> n;
  for_each_candidate(cut, u, [&](int, const LightCluster& cluster, double below) {
    if (cluster.ref != kFarCluster) {
      draws.push_back({cluster.ref, below});
      n.push_back(cluster.candidates);
    } else if (const auto choice = far().select(query, below)) {
      drawn.push_back({choice->light, static_cast<float>(choice->pmf * cluster.candidates)});
    }
  });
  SmallVector<std::optional<WideLightTree::Choice>, 16> choices;
  for (std::size_t i = 0; i < draws.size(); ++i) choices.push_back({});
  tree().select_below(std::span<const WideLightTree::Draw>(draws.data(), draws.size()), tree().localize(query),
                      std::span(choices.data(), choices.size()));
  for (std::size_t i = 0; i < draws.size(); ++i) {
    if (choices[i]) drawn.push_back({choices[i]->light, static_cast<float>(choices[i]->pmf * n[i])});
  }
  return drawn;
}

/// Up from the leaf to the cluster of the cut that holds it.
template <typename Tree>
template <typename Query>
double WideSelector<Tree>::n_pmf_near(const LightCut& cut, const Query& query, std::uint32_t leaf) const {
  for (auto ref = leaf;; ref = tree().parent_of(ref)) {
    if (const LightCluster* c = find(cut, ref)) return c->candidates * tree().pmf_below(ref, leaf, tree().localize(query));
    if (ref == WideLightTree::kAll) return 0;
  }
}

template <typename Tree>
template <typename Query>
float WideSelector<Tree>::n_pmf_of_all(const LightCut& cut, const Query& query, LightId light) const {
  const std::uint32_t slot = this->slot_of(light);
  if (slot == this->kDark) return 0;
  if (slot < this->kFar) return static_cast<float>(n_pmf_near(cut, query, slot));
  const LightCluster* c = find(cut, kFarCluster);
  return c ? static_cast<float>(c->candidates * far().pmf(query, slot - this->kFar)) : 0.0f;
}

template <typename Tree>
LightCandidates WideSelector<Tree>::draw(const LightCut& cut, const PointQuery& query, double u) const {
  return draw_all(cut, query, u);
}
template <typename Tree>
LightCandidates WideSelector<Tree>::draw(const LightCut& cut, const SegmentQuery& query, double u) const {
  return draw_all(cut, Segment(query), u);
}

template <typename Tree>
float WideSelector<Tree>::n_pmf(const LightCut& cut, const PointQuery& query, LightId light) const {
  return n_pmf_of_all(cut, query, light);
}
template <typename Tree>
float WideSelector<Tree>::n_pmf(const LightCut& cut, const SegmentQuery& query, LightId light) const {
  return n_pmf_of_all(cut, Segment(query), light);
}

template class WideSelector<WideLightTree>;
template class WideSelector<InstancedLightTree>;

}  // namespace tyndall
