/// What one light of each of a node's children may bring to a point, at best.
#pragma once

#include <array>

#include "light/wide_node.h"

namespace tyndall {

/// In the units of child_importance(), with the mean intensity of a light that is chosen by intensity: as if it were where the
/// child's box comes closest to the point, and sent its light there. Infinite where the box holds the point; leaves: 0.
struct NearestLight {
  alignas(32) std::array<float, WideNode::kWidth> of;
};
NearestLight nearest_light(const WideNode& node, const WideQuery& query);

}  // namespace tyndall
