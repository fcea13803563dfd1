#include "light/selection.h"

#include "light/alias_selector.h"
#include "light/tree_selector.h"

namespace tyndall {
namespace {

/// The same chance for every light that has power.
std::vector<double> equal_weights(std::vector<double> power) {
  for (double& w : power) w = w > 0 ? 1 : 0;
  return power;
}

}  // namespace

bool uses_bounds(LightStrategy strategy) { return strategy == LightStrategy::tree || strategy == LightStrategy::tree_binary; }

std::unique_ptr<const LightSelector> make_selector(LightStrategy strategy, SelectionInput input) {
  switch (strategy) {
    case LightStrategy::uniform:
      return std::make_unique<AliasSelector>(equal_weights(std::move(input.power)));
    case LightStrategy::power:
      return std::make_unique<AliasSelector>(input.power);
    case LightStrategy::exhaustive:
      return std::make_unique<ExhaustiveSelector>(equal_weights(std::move(input.power)));
    case LightStrategy::tree:
      return std::make_unique<TreeSelector<WideLightTree>>(WideLightTree(std::move(input.near), input.threads), input);
    case LightStrategy::tree_binary:
      return std::make_unique<TreeSelector<LightTree>>(LightTree(std::move(input.near)), input);
  }
  return nullptr;
}

}  // namespace tyndall
