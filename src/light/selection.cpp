#include "light/selection.h"

#include <algorithm>

#include "light/alias_selector.h"
#include "light/tree_selector.h"
#include "light/wide_selector.h"

namespace tyndall {
namespace {

/// The same chance for every light that has power.
std::vector<double> equal_weights(std::vector<double> power) {
  for (double& w : power) w = w > 0 ? 1 : 0;
  return power;
}

LightCut all_as_one(const CutSettings& settings) {
  LightCut whole;
  whole.push_back({0, static_cast<float>(std::max(settings.candidates.value_or(1), 1))});
  return whole;
}

template <typename Query>
LightCandidates one_by_one(const LightSelector& selector, const LightCut& cut, const Query& query, double u) {
  LightCandidates drawn;
  for_each_candidate(cut, u, [&](int, const LightCluster& cluster, double below) {
    if (const auto s = selector.select_in(cluster, query, below)) drawn.push_back({s->light, s->pmf * cluster.candidates});
  });
  return drawn;
}

}  // namespace

bool uses_bounds(LightStrategy strategy) {
  return strategy == LightStrategy::tree || strategy == LightStrategy::tree_binary || strategy == LightStrategy::cycles_rule;
}

LightCut LightSelector::cut(const PointQuery&, const CutSettings& settings) const { return all_as_one(settings); }
LightCut LightSelector::cut(const SegmentQuery&, const CutSettings& settings) const { return all_as_one(settings); }

std::optional<SelectedLight> LightSelector::select_in(const LightCluster&, const PointQuery& query, double u) const {
  return select(query, u);
}
std::optional<SelectedLight> LightSelector::select_in(const LightCluster&, const SegmentQuery& query, double u) const {
  return select(query, u);
}

LightCandidates LightSelector::draw(const LightCut& cut, const PointQuery& query, double u) const {
  return one_by_one(*this, cut, query, u);
}
LightCandidates LightSelector::draw(const LightCut& cut, const SegmentQuery& query, double u) const {
  return one_by_one(*this, cut, query, u);
}

float LightSelector::expected(const LightCut& cut, const PointQuery& query, LightId light) const {
  return exhaustive() ? 1.0f : cut[0].candidates * pmf(query, light);
}
float LightSelector::expected(const LightCut& cut, const SegmentQuery& query, LightId light) const {
  return exhaustive() ? 1.0f : cut[0].candidates * pmf(query, light);
}

std::unique_ptr<const LightSelector> make_selector(LightStrategy strategy, SelectionInput input) {
  switch (strategy) {
    case LightStrategy::uniform:
      return std::make_unique<AliasSelector>(equal_weights(std::move(input.power)));
    case LightStrategy::power:
      return std::make_unique<AliasSelector>(input.power);
    case LightStrategy::exhaustive:
      return std::make_unique<ExhaustiveSelector>(equal_weights(std::move(input.power)));
    case LightStrategy::tree:
      return std::make_unique<WideSelector>(WideLightTree(std::move(input.near), input.threads), input);
    case LightStrategy::tree_binary:
      return std::make_unique<TreeSelector<LightTree>>(LightTree(std::move(input.near)), input);
    case LightStrategy::cycles_rule:
      return std::make_unique<TreeSelector<LightTree>>(LightTree(std::move(input.near), ChildRule::averaged), input);
  }
  return nullptr;
}

}  // namespace tyndall
