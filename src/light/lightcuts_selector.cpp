#include "light/lightcuts_selector.h"

#include <cmath>

#include "light/tree_cut.h"
#include "math/below_one.h"
#include "math/rng.h"

namespace tyndall {
namespace {

/// The paper's: 2 % of the total is what the eye just tells apart, by Weber's law; and 1,000 nodes [2005, sec. 3].
constexpr CutGoal kPaper{.error = 0.02, .nodes = 1000};

constexpr std::uint32_t kAllFarLights = 0xfffffffd;  ///< as one node; more than all of them one by one

/// A leaf for each node, in proportion to intensity: of its children's one is its own [2005, sec. 3.2]. Equal trees have equal
/// ones.
std::vector<std::uint32_t> choose_representatives(const LightTree& tree) {
  const auto nodes = tree.nodes();
  std::vector<std::uint32_t> chosen(nodes.size());
  Rng rng(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    if (nodes[i].leaf) {
      chosen[i] = static_cast<std::uint32_t>(i);
      continue;
    }
    const std::size_t first = i + 1, second = nodes[i].second_or_light;
    const double a = nodes[first].bounds.intensity, b = nodes[second].bounds.intensity;
    chosen[i] = chosen[rng.uniform_wide() * (a + b) < a ? first : second];
  }
  return chosen;
}

/// The k-th number of a sequence that spreads, turned by u: uniform for each k.
double spread(double u, std::size_t k) {
  constexpr double kGolden = 0.6180339887498949;
  const double x = u + static_cast<double>(k) * kGolden;
  return std::min(x - std::floor(x), kBelowOne);
}

}  // namespace

LightcutsSelector::LightcutsSelector(LightTree tree, const SelectionInput& input)
    : TreeSelector(std::move(tree), input), representatives_(choose_representatives(this->tree())) {
  for (const FarLight& light : input.far) far_lights_.push_back(light.light);
}

/// What a node gives is estimated by its representative, as if it had all of the node's intensity.
template <typename Query>
LightCut LightcutsSelector::cut_for(const Query& query, int most) const {
  const auto nodes = tree().nodes();
  const auto measure = [&](std::uint32_t node) -> CutMeasure {
    const LightTree::Node &all = nodes[node], &one = nodes[representatives_[node]];
    const double bound = greatest_importance(all.bounds, all.two_sided, query);
    if (!(bound > 0)) return {0, 0};
    const double growth = double{all.bounds.intensity} / one.bounds.intensity;
    return {tree().intensity() * bound, tree().intensity() * growth * importance(one.bounds, one.two_sided, query)};
  };
  CutGoal goal = kPaper;
  if (most > 0) goal.nodes = static_cast<std::size_t>(most);
  goal.beside = far().importance(query);
  LightCut cut;
  for (const CutNode& n : refined_cut(tree(), goal, measure)) cut.push_back({n.node, 1});
  if (!(goal.beside > 0)) return cut;
  if (far().size() > goal.nodes) {
    cut.push_back({kAllFarLights, 1});
  } else {
    for (std::uint32_t i = 0; i < far().size(); ++i) cut.push_back({kFar + i, 1});
  }
  return cut;
}

template <typename Query>
LightCandidates LightcutsSelector::draw_each(const LightCut& cut, const Query& query, double u) const {
  LightCandidates drawn;
  for (std::size_t k = 0; k < cut.size(); ++k) {
    const std::uint32_t ref = cut[k].ref;
    if (ref == kAllFarLights) {
      if (const auto choice = far().select(query, spread(u, k)))
        drawn.push_back({choice->light, static_cast<float>(choice->pmf)});
    } else if (ref >= kFar) {
      drawn.push_back({far_lights_[ref - kFar], 1});
    } else if (const auto choice = tree().select_below(ref, query, spread(u, k))) {
      drawn.push_back({choice->light, static_cast<float>(choice->pmf)});
    }
  }
  return drawn;
}

template <typename Query>
float LightcutsSelector::chance_in(const LightCut& cut, const Query& query, LightId light) const {
  const std::uint32_t slot = slot_of(light);
  if (slot == kDark || cut.empty()) return 0;
  if (slot >= kFar) {
    const std::uint32_t last = (cut.end() - 1)->ref;
    if (last == kAllFarLights) return static_cast<float>(far().pmf(query, slot - kFar));
    return last >= kFar ? 1.0f : 0.0f;
  }
  const auto node = [](const LightCluster& c) { return c.ref; };
  const LightCluster* holder = holder_of(cut.begin(), cut.end(), slot, node);
  return holder == cut.end() ? 0.0f : static_cast<float>(tree().pmf_below(holder->ref, query, slot));
}

LightCut LightcutsSelector::cut(const PointQuery& query, const CutSettings& settings) const {
  return cut_for(query, settings.candidates);
}
LightCut LightcutsSelector::cut(const SegmentQuery& query, const CutSettings& settings) const {
  return cut_for(Segment(query), settings.candidates);
}
LightCandidates LightcutsSelector::draw(const LightCut& cut, const PointQuery& query, double u) const {
  return draw_each(cut, query, u);
}
LightCandidates LightcutsSelector::draw(const LightCut& cut, const SegmentQuery& query, double u) const {
  return draw_each(cut, Segment(query), u);
}
float LightcutsSelector::n_pmf(const LightCut& cut, const PointQuery& query, LightId light) const {
  return chance_in(cut, query, light);
}
float LightcutsSelector::n_pmf(const LightCut& cut, const SegmentQuery& query, LightId light) const {
  return chance_in(cut, Segment(query), light);
}

std::size_t LightcutsSelector::memory_bytes() const {
  return TreeSelector::memory_bytes() + representatives_.capacity() * sizeof(representatives_[0]) +
         far_lights_.capacity() * sizeof(far_lights_[0]);
}

}  // namespace tyndall
