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

std::unique_ptr<const LightSelector> make_selector(LightStrategy strategy, const SelectionInput& input) {
  switch (strategy) {
    case LightStrategy::uniform: return std::make_unique<AliasSelector>(equal_weights(input.power));
    case LightStrategy::power: return std::make_unique<AliasSelector>(input.power);
    case LightStrategy::exhaustive: return std::make_unique<ExhaustiveSelector>(equal_weights(input.power));
    case LightStrategy::tree_binary: return std::make_unique<TreeSelector>(input);
  }
  return nullptr;
}

}  // namespace tyndall
