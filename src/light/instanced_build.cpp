// Construction of the instanced light tree: the objects' trees, then the top tree over what is seen of them.
#include "light/instanced_light_tree.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

/// Objects with fewer lights are done before threads have started.
constexpr std::size_t kManyLights = 65536;

/// Of the object's size: what points of a query and the boxes may be off by, once they are in the object's space. Points
/// farther off than twice that size are covered by the margins that clusters are tested with.
constexpr double kRounding = 0x1p-21;

Bounds3 bounds_of(const std::vector<TreeLight>& lights) {
  Bounds3 all;
  for (const TreeLight& l : lights) all.expand(l.bounds.box);
  return all;
}

/// From a tree's unit of length, a power of two.
Bounds3 in_length(const Bounds3& box, double per_unit) {
  const auto length = [&](Vec3 v) { return to_vec3(Vec3d(v) * per_unit); };
  return {length(box.min), length(box.max)};
}

}  // namespace

// Around the middle of its lights, where the most bits are left for what matters.
InstancedLightTree::Object InstancedLightTree::object_of(SharedLights lights, int threads) {
  Object object;
  object.leaf.assign(lights.power.size(), kAll);
  if (lights.near.empty()) return object;
  const Bounds3 all = bounds_of(lights.near);
  const Vec3d low(all.min), high(all.max), extent = high - low;
  object.center = low * 0.5 + high * 0.5;
  const double margin = kRounding * std::max({extent.x, extent.y, extent.z});
  for (TreeLight& l : lights.near) {
    const Vec3d wider(margin, margin, margin);
    l.bounds.box = {to_vec3(Vec3d(l.bounds.box.min) - object.center - wider),
                    to_vec3(Vec3d(l.bounds.box.max) - object.center + wider)};
  }
  object.tree = WideLightTree(std::move(lights.near), lights.power.size() < kManyLights ? 1 : threads);
  object.tree.for_each_leaf([&](LightId light, NodeRef leaf) { object.leaf[light] = leaf; });
  return object;
}

/// All lights of an instance, in the world; their box that of the boxes of the object's first clusters.
Cluster InstancedLightTree::cluster_of(const Instance& instance) const {
  const WideLightTree& tree = tree_of(instance);
  const Similarity& map = instance.to_world;
  const double per_unit = 1 / tree.to_unit({}), scale = map.scale() * per_unit;
  Cluster c = tree.cluster(kAll);
  LightBounds bounds{c.box, c.normals, c.theta_e, 1, c.two_sided};
  c.normals = placed(bounds, map, 1).normals;
  c.box = {};
  const WideNode& first = tree.nodes()[0];
  for (int i = 0; i < WideNode::kWidth; ++i)
    if (first.used(i)) c.box.expand(placed(in_length(first.cluster(i).box, per_unit), map));
  c.mean = map.point(c.mean * per_unit);
  c.variance *= scale * scale;
  const double intensity = tree.intensity() * instance.growth;
  c.intensity_square *= intensity * intensity / (c.intensity * c.intensity);
  c.intensity = intensity;
  return c;
}

TreeLight InstancedLightTree::tree_light(std::uint32_t instance, const Cluster& c) const {
  const auto intensity = static_cast<float>(std::clamp(c.intensity, 1e-37, 1e38));
  return {{c.box, c.normals, c.theta_e, intensity, c.two_sided}, WideLightTree::kCluster + instance};
}

InstancedLightTree::InstancedLightTree(SelectionInput& input) {
  for (SharedLights& lights : input.objects) objects_.push_back(object_of(std::move(lights), input.threads));
  std::vector<TreeLight> lights = std::move(input.near);
  std::vector<Cluster> clusters;
  for (const LightInstance& i : input.instances) {
    const Object& object = objects_[i.object];
    instances_.push_back({i.object, 0, i.first, kAll, i.to_world.from_origin(object.center), i.growth});
    clusters.push_back(object.tree.empty() ? Cluster() : cluster_of(instances_.back()));
    const auto index = static_cast<std::uint32_t>(instances_.size() - 1);
    if (!object.tree.empty()) lights.push_back(tree_light(index, clusters.back()));
  }
  input.objects = {};
  input.instances = {};
  top_ = WideLightTree(std::move(lights), clusters, input.threads);
  top_.for_each_leaf([&](LightId light, NodeRef leaf) {
    if (light >= WideLightTree::kCluster) instances_[light - WideLightTree::kCluster].leaf = leaf;
  });
  number_nodes();
}

void InstancedLightTree::number_nodes() {
  constexpr std::uint64_t kMost = 0x80000000 / WideNode::kWidth;
  std::uint64_t next = top_.nodes().size();
  for (Instance& i : instances_) {
    i.first_node = static_cast<std::uint32_t>(next);
    next += tree_of(i).nodes().size();
    if (next > kMost) throw Error(Failure::scene, "the scene's instances have too many lights; merge some emissive primitives");
  }
}

}  // namespace tyndall
