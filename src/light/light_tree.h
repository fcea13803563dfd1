/// A binary tree over light bounds that chooses lights in proportion to what they may contribute to a point
/// [Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018].
///
/// The tree knows bounds only, no light types. Built by the surface area orientation heuristic down to single lights;
/// memory grows with the number of lights and nothing depends on its depth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "light/importance.h"
#include "light/segment_importance.h"

namespace tyndall {

/// A light as the tree is built from it.
struct TreeLight {
  LightBounds bounds;  ///< intensity > 0
  LightId light;
};

/// How a node's children share its probability.
enum class ChildRule {
  proportional,  ///< to their importance, an upper bound [2018, sec. 5.2]
  /// The mean of the shares by the upper and by the lower bound, the latter halves where both are 0: Cycles' rule
  /// [Blender, intern/cycles/kernel/light/tree.h], to compare with. It is that method in our code, not that renderer.
  averaged
};

class LightTree {
 public:
  static constexpr std::uint32_t kNoParent = 0x7fffffff;

  /// In preorder: the first child of node i is node i + 1.
  struct Node {
    ClusterBounds bounds;  ///< intensity relative to that of all lights
    std::uint32_t leaf : 1 = 0;
    std::uint32_t second_or_light : 31 = 0;  ///< index of the second child, or of a leaf's light
    std::uint32_t two_sided : 1 = 0;
    std::uint32_t parent : 31 = kNoParent;
  };

  LightTree() = default;
  /// `lights` is reordered, and empty afterwards. Equal input gives an equal tree.
  explicit LightTree(std::vector<TreeLight> lights, ChildRule rule = ChildRule::proportional);

  struct Choice {
    LightId light;
    double pmf;
  };
  /// Descends by one number u in [0, 1), rescaled after every decision. Nothing: u fell on a branch whose lights all
  /// have importance 0.
  std::optional<Choice> select(const PointQuery& query, double u) const { return select_below(0, query, u); }
  std::optional<Choice> select(const Segment& query, double u) const { return select_below(0, query, u); }
  /// Probability of select() giving the light whose leaf is `leaf`: the same decisions from the leaf upward.
  double pmf(const PointQuery& query, std::uint32_t leaf) const { return pmf_below(0, query, leaf); }
  double pmf(const Segment& query, std::uint32_t leaf) const { return pmf_below(0, query, leaf); }
  /// The same among the lights of one node; 0 for leaves elsewhere.
  template <typename Query>
  std::optional<Choice> select_below(std::uint32_t node, const Query& query, double u) const;
  template <typename Query>
  double pmf_below(std::uint32_t node, const Query& query, std::uint32_t leaf) const;
  /// Importance of all lights together, in W/sr / length^2; for segments in W/sr / length.
  template <typename Query>
  double importance(const Query& query) const {
    return nodes_.empty() ? 0 : node_importance(0, query) * intensity_;
  }

  double intensity() const { return intensity_; }  ///< of all lights, W/sr: the unit of those in the nodes' bounds

  bool empty() const { return nodes_.empty(); }
  std::span<const Node> nodes() const { return nodes_; }
  /// f(LightId, leaf) for every leaf.
  template <typename F>
  void for_each_leaf(const F& f) const {
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
      if (nodes_[i].leaf) f(nodes_[i].second_or_light, i);
  }
  int depth() const { return depth_; }  ///< decisions on the way to the deepest leaf
  std::size_t memory_bytes() const { return nodes_.capacity() * sizeof(Node); }

  /// Probability of descending into the first child of an inner node; nothing when neither child has importance.
  template <typename Query>
  std::optional<double> child_probability(std::uint32_t node, const Query& query) const;

 private:
  template <typename Query>
  double node_importance(std::uint32_t node, const Query& query) const {
    return tyndall::importance(nodes_[node].bounds, nodes_[node].two_sided, query);
  }
  template <typename Query>
  double averaged(double share, std::uint32_t node, const Query& query) const;

  std::vector<Node> nodes_;
  double intensity_ = 0;  ///< of all lights, W/sr
  int depth_ = 0;
  ChildRule rule_ = ChildRule::proportional;
};

static_assert(sizeof(LightTree::Node) == 56);

}  // namespace tyndall
