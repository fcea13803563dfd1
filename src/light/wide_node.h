/// A node of the wide light tree: bounds of up to eight children, side by side for SIMD, in 48 bytes each.
///
/// Everything that can exclude a light is rounded so that it excludes none that the exact bounds admit.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "light/cluster.h"
#include "light/query.h"

namespace tyndall {

/// In the tree's own unit of length, see WideLightTree.
struct alignas(64) WideNode {
  static constexpr int kWidth = 8;
  static constexpr std::uint8_t kLeaf = 1, kTwoSided = 2;  ///< no further flags: SIMD compares with the larger
  /// Steps of the axes and cosines.
  static constexpr float kStep = 1.0f / 32767;
  static constexpr float kMeanStep = 1.0f / 127;

  float center[3][kWidth];          ///< of the box
  std::uint16_t half[3][kWidth];    ///< half its sides, upper half floats
  std::int16_t axis[3][kWidth];     ///< of the normals' cone, near unit length
  std::int16_t cos_o[kWidth];       ///< its half angle; -1: every direction
  std::int16_t cos_e[kWidth];       ///< reach of the emission beyond the normals
  std::uint16_t intensity[kWidth];  ///< upper half float, in units of `scale`; 0: there is no such child
  std::uint16_t deviation[kWidth];  ///< upper half float: standard deviation of position about the mean
  std::int8_t mean[3][kWidth];      ///< of position: offset from the center in 127ths of `half`
  std::uint8_t flags[kWidth];
  std::uint32_t child[kWidth];  ///< a leaf's light, or the index of a node
  // The descent does not look further.
  std::uint32_t count[kWidth];          ///< lights
  std::uint16_t intensity_cv2[kWidth];  ///< upper half float
  std::uint32_t parent;                 ///< the NodeRef that this node's children make up
  float scale;                          ///< intensity of the strongest child, relative to that of all lights

  bool used(int i) const { return intensity[i] != 0; }
  std::size_t size() const {
    return static_cast<std::size_t>(std::count_if(intensity, intensity + kWidth, [](auto i) { return i != 0; }));
  }
  bool leaf(int i) const { return flags[i] & kLeaf; }
  /// Prefetches a node of the descent.
  void prefetch() const {
    for (std::size_t line = 0; line < offsetof(WideNode, count); line += 64)
      __builtin_prefetch(reinterpret_cast<const char*>(this) + line);
  }

  /// At most eight clusters as children, with what the parent says of each: a light or the index of a node.
  void set_children(std::span<const Cluster> clusters, std::span<const std::uint32_t> children);
  /// What is stored of child `i`, decoded; its intensity relative to that of all lights.
  Cluster cluster(int i) const;
};

static_assert(sizeof(WideNode) == 384);

/// A query in the tree's unit of length.
struct WideQuery {
  /// Farther than this directions and ratios of distances no longer change.
  static constexpr double kFar = 0x1p20;

  Vec3 p, n;
  bool surface = false;       ///< n is a normal
  bool transmissive = false;  ///< and light from below counts
  float diffuse = 1;          ///< as in PointQuery, from here on
  int lobe_count = 0;
  std::array<QueryLobe, 2> lobes{};
  float g = 0;
  Vec3 forward{};
  double to_world = 1;  ///< child_importance() times this is in intensity / length^2 of the scene
};

/// Importance of each of a node's children, in units of `scale` / length^2: at least a tiny positive number unless no
/// light of the child can contribute. After [Conty Estevez and Kulla 2018, eq. 3], see wide_importance.cpp.
struct ChildImportance {
  alignas(32) std::array<float, WideNode::kWidth> of;
};
ChildImportance child_importance(const WideNode& node, const WideQuery& query);

}  // namespace tyndall
