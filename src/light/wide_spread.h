/// How much the lights of each of a node's children differ in what they contribute.
#pragma once

#include <array>

#include "light/wide_node.h"

namespace tyndall {

struct ChildSpread {
  /// Squared coefficient of variation of a light's contribution; leaves: 0. Infinite where the child's bounds hold the point.
  alignas(32) std::array<float, WideNode::kWidth> cv2;
};
ChildSpread child_spread(const WideNode& node, const WideQuery& query);

}  // namespace tyndall
