/// Choice by the light tree, with the lights at infinity beside its root.
#pragma once

#include "light/selection.h"

namespace tyndall {

class TreeSelector final : public LightSelector {
 public:
  explicit TreeSelector(const SelectionInput& input);

  std::optional<SelectedLight> select(const PointQuery& query, double u) const override;
  float pmf(const PointQuery& query, LightId light) const override;
  std::size_t memory_bytes() const override;

 private:
  struct Shares {
    double near, far;  ///< probabilities of the tree and of the lights at infinity
  };
  Shares shares(const PointQuery& query) const;

  LightTree tree_;
  FarLights far_;
  std::vector<std::uint32_t> slot_;  ///< by LightId: tree leaf, or kFar + index among the far lights, or kDark
};

}  // namespace tyndall
