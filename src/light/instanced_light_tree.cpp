// Descent through the top tree and the objects' trees, and the probabilities of its outcomes.
#include "light/instanced_light_tree.h"

#include <algorithm>

#include "light/choice_by_number.h"

namespace tyndall {

InstancedLightTree::NodeRef InstancedLightTree::leaf_of(LightId light) const {
  const auto next =
      std::upper_bound(instances_.begin(), instances_.end(), light, [](LightId l, const Instance& i) { return l < i.first; });
  const Instance& instance = *(next - 1);
  const NodeRef leaf = objects_[instance.object].leaf[light - instance.first];
  return leaf == kAll ? kAll : ref_of(instance, leaf);
}

InstancedLightTree::Place InstancedLightTree::place(NodeRef ref) const {
  if (ref == kAll) return {nullptr, ref};
  if (ref / 8 < top_.nodes().size()) {
    const std::uint32_t child = top_.nodes()[ref / 8].child[ref % 8];
    if (!top_.is_leaf(ref) || child < WideLightTree::kCluster) return {nullptr, ref};
    return {&instances_[child - WideLightTree::kCluster], kAll};
  }
  const auto next = std::upper_bound(instances_.begin(), instances_.end(), ref / 8,
                                     [](NodeRef node, const Instance& i) { return node < i.first_node; });
  const Instance& instance = *(next - 1);
  return {&instance, ref - 8 * instance.first_node};
}

InstancedLightTree::NodeRef InstancedLightTree::parent_of(NodeRef ref) const {
  const Place at = place(ref);
  if (!at.instance) return top_.parent_of(ref);
  return at.ref == kAll ? top_.parent_of(at.instance->leaf) : ref_of(*at.instance, tree_of(*at.instance).parent_of(at.ref));
}

bool InstancedLightTree::is_leaf(NodeRef ref) const {
  const Place at = place(ref);
  return at.instance ? tree_of(*at.instance).is_leaf(at.ref) : top_.is_leaf(at.ref);
}

std::uint32_t InstancedLightTree::count_of(NodeRef ref) const {
  const Place at = place(ref);
  return at.instance ? tree_of(*at.instance).count_of(at.ref) : top_.count_of(at.ref);
}

LightId InstancedLightTree::light_at(const Place& leaf) const {
  const WideLightTree& tree = leaf.instance ? tree_of(*leaf.instance) : top_;
  return (leaf.instance ? leaf.instance->first : 0) + tree.nodes()[leaf.ref / 8].child[leaf.ref % 8];
}

WideQuery InstancedLightTree::localize(const Instance& instance, const PointQuery& query) const {
  const Similarity& map = instance.to_world;
  PointQuery inner = query;
  inner.n = to_vec3(map.inner_normal(Vec3d(query.n)));
  inner.forward = to_vec3(map.inner_direction(Vec3d(query.forward)));
  for (int i = 0; i < query.lobe_count; ++i) {
    QueryLobe& lobe = inner.lobes[static_cast<std::size_t>(i)];
    lobe.tangent = to_vec3(map.inner_direction(Vec3d(lobe.tangent)));
    lobe.bitangent = to_vec3(map.inner_direction(Vec3d(lobe.bitangent)));
  }
  return tree_of(instance).localize(inner, map.inner_point(Vec3d(query.p)));
}

WideSegment InstancedLightTree::localize(const Instance& instance, const Segment& query) const {
  const Similarity& map = instance.to_world;
  const double scale = map.scale();
  Segment inner = query;
  inner.o = map.inner_point(query.o);
  inner.d = map.inner_direction(query.d);
  inner.reach = std::max({query.reach / scale, std::abs(inner.o.x), std::abs(inner.o.y), std::abs(inner.o.z)});
  inner.t0 /= scale;
  inner.t1 /= scale;
  inner.length /= scale;
  for (Segment::Bin& bin : inner.bins) {
    bin.begin /= scale;
    bin.end /= scale;
    bin.sigma *= scale;
  }
  return tree_of(instance).localize(inner);
}

// A length of the object is `scale` of the world's.
double InstancedLightTree::world_importance(const Instance& i, const WideQuery& local) const {
  return tree_of(i).intensity() * i.growth * local.to_world / (i.to_world.scale() * i.to_world.scale());
}
double InstancedLightTree::world_importance(const Instance& i, const WideSegment& local) const {
  return tree_of(i).intensity() * i.growth * local.to_world / i.to_world.scale();
}

template <typename Query>
std::optional<InstancedLightTree::Choice> InstancedLightTree::descend(NodeRef top, const Localized<Query>& query,
                                                                      double u) const {
  if (top_.empty()) return std::nullopt;
  if (is_leaf(top)) return Choice{light_at(place(top)), 1};
  if (u < kByNumber) return select_by_number(top, query, u / kByNumber);
  u = rest(u);
  double chance = 1;
  Place at = place(top);
  if (!at.instance) {
    const auto reached = top_.decide(at.ref, query.top, u);
    if (!reached) return std::nullopt;
    chance = reached->chance;
    u = reached->u;
    at = place(reached->leaf);
    if (!at.instance) return Choice{light_at(at), mixed(chance, count_of(top))};
  }
  const auto reached = tree_of(*at.instance).decide(at.ref, localize(*at.instance, query.world), u);
  if (!reached) return std::nullopt;
  return Choice{light_at({at.instance, reached->leaf}), mixed(chance * reached->chance, count_of(top))};
}

template <typename Query>
std::optional<InstancedLightTree::Choice> InstancedLightTree::select_by_number(NodeRef top, const Localized<Query>& query,
                                                                               double u) const {
  auto number = static_cast<std::uint32_t>(u * count_of(top));
  Place at = place(top);
  if (!at.instance) at = place(top_.numbered(at.ref, number));
  if (at.instance) at.ref = tree_of(*at.instance).numbered(at.ref, number);
  const double pmf = ascend(top, at.instance ? ref_of(*at.instance, at.ref) : at.ref, query);
  if (!(pmf > 0)) return std::nullopt;
  return Choice{light_at(at), pmf};
}

template <typename Query>
double InstancedLightTree::ascend(NodeRef top, NodeRef leaf, const Localized<Query>& query) const {
  if (leaf == top) return 1;
  const Place end = place(top);
  Place at = place(leaf);
  double chance = 1;
  if (at.instance) {
    const NodeRef last = end.instance ? end.ref : kAll;
    const auto inside = tree_of(*at.instance).decided(last, at.ref, localize(*at.instance, query.world));
    if (!inside) return 0;
    chance = *inside;
    at = {nullptr, at.instance->leaf};
  }
  if (!end.instance) {
    const auto outside = top_.decided(end.ref, at.ref, query.top);
    if (!outside) return 0;
    chance *= *outside;
  }
  return mixed(chance, count_of(top));
}

std::size_t InstancedLightTree::memory_bytes() const {
  std::size_t bytes = top_.memory_bytes() + instances_.capacity() * sizeof(Instance);
  for (const Object& o : objects_) bytes += sizeof(Object) + o.tree.memory_bytes() + o.leaf.capacity() * sizeof(NodeRef);
  return bytes;
}

using Point = InstancedLightTree::Localized<PointQuery>;
using Range = InstancedLightTree::Localized<Segment>;
template std::optional<InstancedLightTree::Choice> InstancedLightTree::descend(NodeRef, const Point&, double) const;
template std::optional<InstancedLightTree::Choice> InstancedLightTree::descend(NodeRef, const Range&, double) const;
template double InstancedLightTree::ascend(NodeRef, NodeRef, const Point&) const;
template double InstancedLightTree::ascend(NodeRef, NodeRef, const Range&) const;

}  // namespace tyndall
