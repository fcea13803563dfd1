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
  whole.push_back({0, static_cast<std::uint32_t>(std::max(settings.candidates, 1))});
  return whole;
}

template <typename Query>
void one_by_one(const LightSelector& selector, const LightCut& cut, const Query& query, std::span<const double> u,
                std::span<std::optional<SelectedLight>> selected) {
  std::size_t i = 0;
  for (const LightCluster& cluster : cut)
    for (std::uint32_t k = 0; k < cluster.candidates; ++k, ++i) selected[i] = selector.select_in(cluster, query, u[i]);
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

void LightSelector::select_all(const LightCut& cut, const PointQuery& query, std::span<const double> u,
                               std::span<std::optional<SelectedLight>> selected) const {
  one_by_one(*this, cut, query, u, selected);
}
void LightSelector::select_all(const LightCut& cut, const SegmentQuery& query, std::span<const double> u,
                               std::span<std::optional<SelectedLight>> selected) const {
  one_by_one(*this, cut, query, u, selected);
}

float LightSelector::expected(const LightCut& cut, const PointQuery& query, LightId light) const {
  return exhaustive() ? 1.0f : static_cast<float>(cut[0].candidates) * pmf(query, light);
}
float LightSelector::expected(const LightCut& cut, const SegmentQuery& query, LightId light) const {
  return exhaustive() ? 1.0f : static_cast<float>(cut[0].candidates) * pmf(query, light);
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
