#include "light/selection.h"

#include <algorithm>

#include "light/alias_selector.h"
#include "light/cell_selector.h"
#include "light/lightcuts_selector.h"
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
  whole.push_back({0, static_cast<float>(std::max(settings.candidates, 1))});
  return whole;
}

/// The cut is all lights as one.
template <typename Query>
LightCandidates one_by_one(const LightSelector& selector, const LightCut& cut, const Query& query, double u) {
  LightCandidates drawn;
  for_each_candidate(cut, u, [&](int, const LightCluster& cluster, double below) {
    if (const auto s = selector.select(query, below)) drawn.push_back({s->light, s->pmf * cluster.candidates});
  });
  return drawn;
}

/// The light that has power, where no other has.
std::optional<LightId> only_light(const std::vector<double>& power) {
  const auto has_power = [](double w) { return w > 0; };
  const auto first = std::find_if(power.begin(), power.end(), has_power);
  if (first == power.end() || std::any_of(first + 1, power.end(), has_power)) return std::nullopt;
  return static_cast<LightId>(first - power.begin());
}

/// Every light of an instance on its own, as `strategy` looks at it.
SelectionInput expanded(SelectionInput input, LightStrategy strategy) {
  std::size_t lights = input.power.size();
  for (const LightInstance& i : input.instances) lights += input.objects[i.object].power.size();
  input.power.reserve(lights);
  if (uses_bounds(strategy)) input.near.reserve(lights);
  for (const LightInstance& i : input.instances) {
    const SharedLights& object = input.objects[i.object];
    for (const double w : object.power) input.power.push_back(w * i.growth);
    if (!uses_bounds(strategy)) continue;
    for (const TreeLight& l : object.near) input.near.push_back({placed(l.bounds, i.to_world, i.growth), i.first + l.light});
  }
  input.objects = {};
  input.instances = {};
  return input;
}

}  // namespace

bool uses_bounds(LightStrategy strategy) {
  switch (strategy) {
    case LightStrategy::uniform:
    case LightStrategy::power:
    case LightStrategy::exhaustive:
      return false;
    case LightStrategy::tree:
    case LightStrategy::tree_binary:
    case LightStrategy::cycles_rule:
    case LightStrategy::lightcuts:
    case LightStrategy::cells:
      return true;
  }
  return false;
}

LightCut LightSelector::cut(const PointQuery&, const CutSettings& settings) const { return all_as_one(settings); }
LightCut LightSelector::cut(const SegmentQuery&, const CutSettings& settings) const { return all_as_one(settings); }

LightCandidates LightSelector::draw(const LightCut& cut, const PointQuery& query, double u) const {
  return one_by_one(*this, cut, query, u);
}
LightCandidates LightSelector::draw(const LightCut& cut, const SegmentQuery& query, double u) const {
  return one_by_one(*this, cut, query, u);
}

float LightSelector::n_pmf(const LightCut& cut, const PointQuery& query, LightId light) const {
  return exhaustive() ? 1.0f : cut[0].candidates * pmf(query, light);
}
float LightSelector::n_pmf(const LightCut& cut, const SegmentQuery& query, LightId light) const {
  return exhaustive() ? 1.0f : cut[0].candidates * pmf(query, light);
}

std::unique_ptr<const LightSelector> make_selector(LightStrategy strategy, SelectionInput input) {
  if (!input.instances.empty()) {
    if (strategy == LightStrategy::tree)
      return std::make_unique<WideSelector<InstancedLightTree>>(InstancedLightTree(input), input);
    input = expanded(std::move(input), strategy);
  }
  const auto only = only_light(input.power);
  if (only && strategy != LightStrategy::exhaustive) return std::make_unique<OnlyLight>(*only);
  switch (strategy) {
    case LightStrategy::uniform:
      return std::make_unique<AliasSelector>(equal_weights(std::move(input.power)));
    case LightStrategy::power:
      return std::make_unique<AliasSelector>(input.power);
    case LightStrategy::exhaustive:
      return std::make_unique<ExhaustiveSelector>(equal_weights(std::move(input.power)));
    case LightStrategy::tree:
      return std::make_unique<WideSelector<WideLightTree>>(WideLightTree(std::move(input.near), input.threads), input);
    case LightStrategy::tree_binary:
      return std::make_unique<TreeSelector<LightTree>>(LightTree(std::move(input.near)), input);
    case LightStrategy::cycles_rule:
      return std::make_unique<TreeSelector<LightTree>>(LightTree(std::move(input.near), ChildRule::averaged), input);
    case LightStrategy::lightcuts:
      return std::make_unique<LightcutsSelector>(LightTree(std::move(input.near)), input);
    case LightStrategy::cells:
      return std::make_unique<CellSelector>(LightTree(std::move(input.near)), input);
  }
  return nullptr;
}

}  // namespace tyndall
