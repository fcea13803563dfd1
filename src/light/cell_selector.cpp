#include "light/cell_selector.h"

#include <algorithm>

#include "light/tree_cut.h"
#include "math/below_one.h"

namespace tyndall {
namespace {

/// Of the tree as a whole: a cell's few questions may find nothing where some point of it has light.
constexpr double kDefensiveShare = 0.25;

}  // namespace

CellSelector::CellSelector(LightTree tree, const SelectionInput& input)
    : TreeSelector(std::move(tree), input), cells_(this->tree(), far(), input.region, input.threads) {}

/// A cluster, then one of its lights.
std::optional<LightId> CellSelector::choose_in(Clusters clusters, const PointQuery& query, double u) const {
  const auto chosen = std::upper_bound(clusters.begin(), clusters.end() - 1, u,
                                       [](double x, const CellDensities::Cluster& c) { return x < double{c.below}; });
  const double before = chosen == clusters.begin() ? 0 : double{(chosen - 1)->below};
  const double rest = std::min((u - before) / (double{chosen->below} - before), kBelowOne);
  if (chosen->node == CellDensities::kLightsAtInfinity) {
    const auto choice = far().select(query, rest);
    return choice ? std::optional(choice->light) : std::nullopt;
  }
  const auto choice = tree().select_below(chosen->node, query, rest);
  return choice ? std::optional(choice->light) : std::nullopt;
}

double CellSelector::chance_in(Clusters clusters, const PointQuery& query, LightId light) const {
  const std::uint32_t slot = slot_of(light);
  if (slot == kDark) return 0;
  const bool at_infinity = slot >= kFar;
  const auto node = [](const CellDensities::Cluster& c) { return c.node; };
  const auto held = holder_of(clusters.begin(), clusters.end(), at_infinity ? CellDensities::kLightsAtInfinity : slot, node);
  if (held == clusters.end() || (held->node == CellDensities::kLightsAtInfinity) != at_infinity) return 0;
  const double before = held == clusters.begin() ? 0 : double{(held - 1)->below};
  const double share = double{held->below} - before;
  return share * (at_infinity ? far().pmf(query, slot - kFar) : tree().pmf_below(held->node, query, slot));
}

std::optional<SelectedLight> CellSelector::select(const PointQuery& query, double u) const {
  const Clusters clusters = cells_.at(query);
  if (clusters.empty()) return TreeSelector::select(query, u);
  std::optional<LightId> light;
  if (u >= kDefensiveShare) {
    light = choose_in(clusters, query, (u - kDefensiveShare) / (1 - kDefensiveShare));
  } else if (const auto choice = TreeSelector::select(query, u / kDefensiveShare)) {
    light = choice->light;
  }
  if (!light) return std::nullopt;
  return SelectedLight{*light, pmf_in(clusters, query, *light)};
}

float CellSelector::pmf(const PointQuery& query, LightId light) const { return pmf_in(cells_.at(query), query, light); }

float CellSelector::pmf_in(Clusters clusters, const PointQuery& query, LightId light) const {
  const double by_tree = TreeSelector::pmf(query, light);
  if (clusters.empty()) return static_cast<float>(by_tree);
  return static_cast<float>(kDefensiveShare * by_tree + (1 - kDefensiveShare) * chance_in(clusters, query, light));
}

}  // namespace tyndall
