/// A segment of a ray as the wide tree's query, and the importance of eight clusters for it at once.
#pragma once

#include <array>

#include "light/segment_importance.h"
#include "light/wide_node.h"

namespace tyndall {

/// In the tree's unit of length. Places on the ray are measured from `p`, the segment's point nearest to the lights'
/// middle: near the lights they keep the bits that they need.
struct WideSegment {
  static constexpr float kFar = 0x1p40;    ///< stands for infinity, on either side of p
  static constexpr float kShort = 1e-18f;  ///< shorter is all the same

  struct Bin {
    float begin, end, length;
    float scattering, sigma, escape;
  };

  Vec3 p, d;
  float from = 0, till = 0;  ///< the ends
  float length = 0;          ///< between them
  float rounding = 0;        ///< what points of the segment may be off by
  float g = 0;
  MediaStrategy importance = MediaStrategy::product;
  std::array<Bin, SegmentProfile::kBins> bin{};
  int bins = 0;         ///< 0: `product` is the same as `integral`
  double to_world = 1;  ///< child_importance() times this is in intensity / length of the scene

  /// `to_unit`: the tree's lengths in one of the scene's; `middle`: of the lights.
  static WideSegment from_segment(const Segment& segment, double to_unit, Vec3d middle);
};

/// Importance of each of a node's children, in units of `scale` / length^2 (per length of the segment): at least a tiny
/// positive number unless no light of the child can contribute to any point of it.
ChildImportance child_importance(const WideNode& node, const WideSegment& segment);

}  // namespace tyndall
