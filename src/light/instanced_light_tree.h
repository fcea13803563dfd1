/// The wide light tree of a scene in which objects that emit light stand many times: a top tree over the scene's own lights and
/// the instances, each a cluster, and one tree for each object that all its instances share. During the descent a query is
/// taken into the object's space, where importance is the same up to a factor, since instances only turn, mirror, scale evenly
/// and move what they show.
///
/// Clusters are numbered as if every instance had nodes of its own, after those of the top tree. The root of an object's tree,
/// as a cluster, is the instance's leaf in the top tree: there the ascent goes on.
#pragma once

#include <type_traits>

#include "light/selection.h"
#include "light/wide_light_tree.h"

namespace tyndall {

class InstancedLightTree {
 public:
  using NodeRef = WideLightTree::NodeRef;
  using Choice = WideLightTree::Choice;
  using Draw = WideLightTree::Draw;
  static constexpr NodeRef kAll = WideLightTree::kAll;

  InstancedLightTree() = default;
  /// Takes lights and objects from `input`. Throws Error (scene) where clusters are more than can be numbered.
  explicit InstancedLightTree(SelectionInput& input);

  // As WideLightTree, see there.
  std::optional<Choice> select(const PointQuery& query, double u) const { return descend(kAll, localize(query), u); }
  std::optional<Choice> select(const Segment& query, double u) const { return descend(kAll, localize(query), u); }
  double pmf(const PointQuery& query, NodeRef leaf) const { return ascend(kAll, leaf, localize(query)); }
  double pmf(const Segment& query, NodeRef leaf) const { return ascend(kAll, leaf, localize(query)); }
  double importance(const PointQuery& query) const { return top_.importance(query); }
  double importance(const Segment& query) const { return top_.importance(query); }
  bool empty() const { return top_.empty(); }
  std::size_t memory_bytes() const;
  /// f(LightId, NodeRef) for every leaf that is a light of its own.
  template <typename F>
  void for_each_leaf(const F& f) const {
    top_.for_each_leaf([&](LightId light, NodeRef leaf) {
      if (light < WideLightTree::kCluster) f(light, leaf);
    });
  }
  NodeRef leaf_of(LightId light) const;  ///< of a light of an instance; kAll: it is dark

  /// A query, and what it is to the top tree. Refers to the query.
  template <typename Query>
  struct Localized {
    const Query& world;
    std::conditional_t<std::is_same_v<Query, PointQuery>, WideQuery, WideSegment> top;
  };
  Localized<PointQuery> localize(const PointQuery& query) const { return {query, top_.localize(query)}; }
  Localized<Segment> localize(const Segment& query) const { return {query, top_.localize(query)}; }
  NodeRef root() const { return kAll; }
  NodeRef parent_of(NodeRef ref) const;
  bool is_leaf(NodeRef ref) const;
  std::uint32_t count_of(NodeRef ref) const;
  template <typename Query, typename F>
  auto open(NodeRef ref, const Localized<Query>& query, const F& f) const {
    const Place at = place(ref);
    if (!at.instance) return top_.open(at.ref, query.top, f);
    const auto local = localize(*at.instance, query.world);
    const WideLightTree& tree = tree_of(*at.instance);
    const std::uint32_t node = tree.node_of(at.ref);
    const double factor = world_importance(*at.instance, local) / (top_.intensity() * query.top.to_world);
    return f(8 * (at.instance->first_node + node), tree.nodes()[node], local, static_cast<float>(factor));
  }
  template <typename Query>
  std::optional<Choice> select_below(NodeRef top, const Localized<Query>& query, double u) const {
    return descend(top, query, u);
  }
  template <typename Query>
  void select_below(std::span<const Draw> draws, const Localized<Query>& query,
                    std::span<std::optional<Choice>> choices) const {
    for (std::size_t i = 0; i < draws.size(); ++i) choices[i] = descend(draws[i].top, query, draws[i].u);
  }
  template <typename Query>
  double pmf_below(NodeRef top, NodeRef leaf, const Localized<Query>& query) const {
    return ascend(top, leaf, query);
  }

 private:
  struct Object {
    WideLightTree tree;
    Vec3d center;               ///< which is the tree's origin
    std::vector<NodeRef> leaf;  ///< by number; kAll: dark
  };
  struct Instance {
    std::uint32_t object, first_node;
    LightId first;
    NodeRef leaf;         ///< in the top tree; kAll: dark
    Similarity to_world;  ///< from the space of the object's tree
    double growth;
  };
  /// A cluster: of the top tree, or in an instance.
  struct Place {
    const Instance* instance;
    NodeRef ref;
  };

  static Object object_of(SharedLights lights, int threads);
  Cluster cluster_of(const Instance& instance) const;
  TreeLight tree_light(std::uint32_t instance, const Cluster& cluster) const;
  void number_nodes();

  const WideLightTree& tree_of(const Instance& i) const { return objects_[i.object].tree; }
  Place place(NodeRef ref) const;
  NodeRef ref_of(const Instance& i, NodeRef ref) const { return ref == kAll ? i.leaf : 8 * i.first_node + ref; }
  LightId light_at(const Place& leaf) const;
  WideQuery localize(const Instance& instance, const PointQuery& query) const;
  WideSegment localize(const Instance& instance, const Segment& query) const;
  double world_importance(const Instance& instance, const WideQuery& local) const;
  double world_importance(const Instance& instance, const WideSegment& local) const;

  template <typename Query>
  std::optional<Choice> descend(NodeRef top, const Localized<Query>& query, double u) const;
  template <typename Query>
  std::optional<Choice> select_by_number(NodeRef top, const Localized<Query>& query, double u) const;
  template <typename Query>
  double ascend(NodeRef top, NodeRef leaf, const Localized<Query>& query) const;

  WideLightTree top_;
  std::vector<Object> objects_;
  std::vector<Instance> instances_;  ///< in the order of their lights
};

}  // namespace tyndall
