/// The light tree that renders use: eight children a node, evaluated at once, one decision among all of them
/// [Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018, widened].
///
/// A child is chosen with P_i = I_i / sum I. Once in 2^20 times a light is chosen by its number instead, so that each of n
/// lights that may contribute owns at least 2^-20 / n of the range of u: none is out of reach of u's bits, however small its
/// importance.
///
/// Lengths are kept in a unit, a power of two, in which no coordinate of a light exceeds 1: squares neither over- nor
/// underflow single precision, and scaling the scene by a power of two changes no probability.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "light/light_tree.h"
#include "light/wide_node.h"
#include "light/wide_segment.h"
#include "math/big_array.h"
#include "math/small_vector.h"

namespace tyndall {

class WideLightTree {
 public:
  /// A cluster: child `ref % 8` of node `ref / 8`, or all lights.
  using NodeRef = std::uint32_t;
  static constexpr NodeRef kAll = 0xffffffff;

  WideLightTree() = default;
  /// Equal input gives an equal tree for any number of threads (0: one a core). `lights` is freed during the build.
  explicit WideLightTree(std::vector<TreeLight> lights, int threads = 0) : WideLightTree(std::move(lights), {}, threads) {}
  /// Some leaves are whole clusters, descended into by the caller: a TreeLight of number kCluster + i has the count
  /// and the moments of clusters[i].
  static constexpr LightId kCluster = 0x40000000;
  WideLightTree(std::vector<TreeLight> lights, std::span<const Cluster> clusters, int threads);

  struct Choice {
    LightId light;
    double pmf;
  };
  /// Descends by one number u in [0, 1), rescaled after every decision. Nothing: u fell on a branch whose lights all
  /// have importance 0.
  std::optional<Choice> select(const PointQuery& query, double u) const { return select_below(kAll, localize(query), u); }
  std::optional<Choice> select(const Segment& query, double u) const { return select_below(kAll, localize(query), u); }
  /// Probability of select() giving the light whose leaf is `leaf`: the same decisions from the leaf upward.
  double pmf(const PointQuery& query, NodeRef leaf) const { return pmf_below(kAll, leaf, localize(query)); }
  double pmf(const Segment& query, NodeRef leaf) const { return pmf_below(kAll, leaf, localize(query)); }
  /// Importance of all lights together, in W/sr / length^2, for segments in W/sr / length: the sum over the root's
  /// children.
  double importance(const PointQuery& query) const;
  double importance(const Segment& query) const;

  bool empty() const { return nodes_.empty(); }
  std::span<const WideNode> nodes() const { return nodes_; }
  int depth() const { return depth_; }  ///< nodes on the way to the deepest leaf
  std::size_t memory_bytes() const { return nodes_.bytes(); }
  /// f(LightId, NodeRef) for every leaf.
  template <typename F>
  void for_each_leaf(const F& f) const;

  /// What a cut through the tree is made of: start at root(), replace a cluster by its children() while that pays, then
  /// select_below() each.
  NodeRef root() const { return kAll; }
  bool is_leaf(NodeRef ref) const { return ref != kAll && nodes_[ref / 8].leaf(ref % 8); }
  /// The node whose children a cluster that is no leaf has.
  std::uint32_t node_of(NodeRef ref) const { return ref == kAll ? 0 : nodes_[ref / 8].child[ref % 8]; }
  WideQuery localize(const PointQuery& query) const { return localize(query, Vec3d(query.p)); }
  WideQuery localize(const PointQuery& query, Vec3d at) const;  ///< at a more precise point than the query's
  WideSegment localize(const Segment& query) const;
  /// Importance of the children of a cluster, child i being NodeRef 8 node_of(ref) + i; relative to each other.
  template <typename Query>
  ChildImportance children(NodeRef ref, const Query& query) const {
    return child_importance(nodes_[node_of(ref)], query);
  }
  /// Bounds and moments of a cluster, lengths in the tree's unit, intensity relative to that of all lights.
  Cluster cluster(NodeRef ref) const { return ref == kAll ? all_ : nodes_[ref / 8].cluster(static_cast<int>(ref % 8)); }
  NodeRef parent_of(NodeRef ref) const { return nodes_[ref / 8].parent; }
  /// f(NodeRef of the first child, the node that they make up, how the query sees it, what its importances are to be
  /// multiplied by to compare with other clusters').
  template <typename Query, typename F>
  auto open(NodeRef ref, const Query& query, const F& f) const {
    const std::uint32_t node = node_of(ref);
    return f(8 * node, nodes_[node], query, 1.0f);
  }
  std::uint32_t count_of(NodeRef ref) const { return ref == kAll ? all_.count : nodes_[ref / 8].count[ref % 8]; }  ///< lights
  /// select() within one cluster, for a query that was localized; a leaf has pmf 1.
  template <typename Query>
  std::optional<Choice> select_below(NodeRef top, const Query& query, double u) const;
  struct Draw {
    NodeRef top;
    double u;
  };
  /// The same for many draws at once, in less time: choices[i] is that of draws[i].
  template <typename Query>
  void select_below(std::span<const Draw> draws, const Query& query, std::span<std::optional<Choice>> choices) const;
  /// Probability of select_below(top) giving the light of `leaf`, which is below `top`.
  template <typename Query>
  double pmf_below(NodeRef top, NodeRef leaf, const Query& query) const;

  /// Intensity of all lights, W/sr.
  double intensity() const { return intensity_; }

  // What descents are made of where the tree is a part of another: the decisions alone, no choice by number.
  struct Reached {
    NodeRef leaf;
    double u, chance;  ///< what is left of u in [0, 1); the product of the decisions' probabilities
  };
  template <typename Query>
  std::optional<Reached> decide(NodeRef top, const Query& query, double u) const;
  /// The chance with which decide() gives `leaf`, rounded to 0 perhaps; nothing: one of the decisions is impossible.
  template <typename Query>
  std::optional<double> decided(NodeRef top, NodeRef leaf, const Query& query) const;
  /// The leaf that has the light of this number below `top`; `number` becomes that within the leaf.
  NodeRef numbered(NodeRef top, std::uint32_t& number) const;

  /// The tree's lengths in one of the scene's, for a query at `p`: the same everywhere, but where all lights are at the
  /// origin and nothing else gives a scale.
  double to_unit(Vec3 p) const;

 private:
  friend class WideTreeBuilder;
  /// A draw during its descent.
  struct Descent {
    NodeRef top, ref;
    double u, chance;
    std::uint32_t draw;  ///< which
  };
  struct Ends;
  bool step(Descent& d, std::uint32_t index, const Ends& ends) const;
  Choice choice(const Descent& d) const;
  template <typename Query>
  std::optional<Choice> select_by_number(NodeRef top, const Query& query, double u) const;
  template <typename Query>
  bool run(Descent& d, const Query& query) const;

  BigArray<WideNode> nodes_;  ///< the first is the root
  Cluster all_;
  double to_unit_ = 0;    ///< the tree's lengths in one of the scene's; 0: all lights are at the origin
  double intensity_ = 0;  ///< of all lights, W/sr
  int depth_ = 0;
};

template <typename F>
void WideLightTree::for_each_leaf(const F& f) const {
  for (std::size_t node = 0; node < nodes_.size(); ++node) {
    for (int i = 0; i < WideNode::kWidth; ++i)
      if (nodes_[node].used(i) && nodes_[node].leaf(i)) f(nodes_[node].child[i], static_cast<NodeRef>(8 * node + i));
  }
}

}  // namespace tyndall
