/// How one light is chosen among all: uniformly, by power, or by the light tree.
#pragma once

#include <optional>
#include <vector>

#include "light/far_lights.h"
#include "light/light_tree.h"
#include "math/distribution.h"
#include "tyndall/settings.h"

namespace tyndall {

/// What selection is built from. Lights without power stand in `power` alone.
struct SelectionInput {
  std::vector<double> power;  ///< by LightId, W; 0: never chosen
  std::vector<TreeLight> near;
  std::vector<FarLight> far;
};

/// select() and pmf() of the same strategy belong together; both are pure functions of the query.
class Selection {
 public:
  Selection() = default;
  Selection(LightStrategy strategy, SelectionInput input);

  std::optional<SelectedLight> select(const PointQuery& query, double u) const;
  float pmf(const PointQuery& query, LightId light) const;

  LightStrategy strategy() const { return strategy_; }
  const LightTree& tree() const { return tree_; }
  std::size_t memory_bytes() const;

 private:
  struct Shares {
    double near, far;  ///< probabilities of the tree and of the lights at infinity
  };
  Shares shares(const PointQuery& query) const;
  std::optional<SelectedLight> select_by_tree(const PointQuery& query, double u) const;
  double tree_pmf(const PointQuery& query, LightId light) const;

  LightStrategy strategy_ = LightStrategy::tree_binary;
  AliasTable power_;  ///< uniform and exhaustive: equal weights for all lights that have power
  LightTree tree_;
  FarLights far_;
  std::vector<std::uint32_t> slot_;  ///< by LightId: tree leaf, or kFar + index among the far lights, or kDark
};

}  // namespace tyndall
