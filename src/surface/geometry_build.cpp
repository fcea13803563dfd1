#include <xmmintrin.h>
#include <algorithm>

#include <map>
#include <string>
#include <thread>

#include "math/parallel.h"
#include "surface/geometry_impl.h"
#include "texture/textures.h"

namespace tyndall {
namespace {

const char* describe(RTCError code) {
  switch (code) {
    case RTC_ERROR_OUT_OF_MEMORY:
      return "out of memory; the scene needs more than this computer has";
    case RTC_ERROR_UNSUPPORTED_CPU:
      return "this processor is not supported; SSE2 is needed";
    case RTC_ERROR_INVALID_ARGUMENT:
      return "invalid argument";
    case RTC_ERROR_INVALID_OPERATION:
      return "invalid operation";
    case RTC_ERROR_CANCELLED:
      return "the build was cancelled";
    default:
      return "unknown error";
  }
}

void on_error(void* impl, RTCError code, const char* text) {
  auto& self = *static_cast<GeometryImpl*>(impl);
  const std::lock_guard lock(self.error_mutex);
  if (self.error.empty()) self.error = std::string(describe(code)) + (text && *text ? " (" + std::string(text) + ")" : "");
}

bool on_memory(void* impl, ssize_t bytes, bool) {
  static_cast<GeometryImpl*>(impl)->embree_bytes += bytes;
  return true;
}

/// Embree builds with denormals flushed; the caller's setting comes back whatever happens.
class KeepFloatMode {
 public:
  KeepFloatMode() = default;
  ~KeepFloatMode() { _mm_setcsr(saved_); }
  KeepFloatMode(const KeepFloatMode&) = delete;
  KeepFloatMode& operator=(const KeepFloatMode&) = delete;

 private:
  unsigned saved_ = _mm_getcsr();
};

bool is_interface(const Scene& scene, const Shape& shape) {
  if (shape.material >= scene.materials.size()) {
    throw Error(shape.where, "the shape's material does not exist; add it to Scene::materials");
  }
  return std::holds_alternative<InterfaceMaterial>(scene.materials[shape.material].kind);
}

/// The textures, when the shape's alpha can be below 1.
const Textures* textures_of_alpha(const Shape& shape, const Textures* textures) {
  if (!shape.alpha || !textures) return nullptr;
  if (*shape.alpha >= textures->size()) throw Error(shape.where, "the shape's alpha texture does not exist");
  if (textures->is_constant(*shape.alpha) && textures->eval_float(*shape.alpha, {}) >= 1) return nullptr;
  return textures;
}

Part make_part(const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape.kind)) return {.shape = &shape, .form = place_mesh(*mesh, shape)};
  if (const auto* mesh = std::get_if<BilinearMesh>(&shape.kind)) {
    return {.shape = &shape, .form = place_mesh(*mesh, shape), .is_patch = true};
  }
  return {.shape = &shape, .form = PlacedQuadric(shape)};
}

/// Plain opaque or alpha-tested triangles; boundaries take the exact test instead.
bool uses_embree_triangles(const Part& part) {
  return std::holds_alternative<PlacedMesh>(part.form) && !part.is_patch && !part.shape->boundary;
}

/// Rays that start farther out could not be traced (see kFarthest).
bool within_reach(const Bounds3& bounds) {
  const Vec3 reach = max(max(bounds.max, -bounds.max), max(bounds.min, -bounds.min));
  return bounds.empty() || (is_finite(reach) && std::max({reach.x, reach.y, reach.z}) <= kFarthestShape);
}

void require_within_reach(const Bounds3& bounds, const Shape& shape) {
  if (within_reach(bounds)) return;
  throw Error(shape.where,
              "the shape is not within finite reach (1e17 times the size of the scene); correct its size or transform");
}

}  // namespace

GeometryImpl::GeometryImpl(const Scene& scene, const Textures* textures, int threads) {
  const KeepFloatMode keep;
  create_device(threads);
  place_shapes(scene);
  sets.push_back(make_set(scene, scene.shapes, textures));
  find_simple_boundaries();
  for (const Object& object : scene.objects) sets.push_back(make_set(scene, object.shapes, textures));
  for (std::size_t i = 1; i < sets.size(); ++i) build_set(*sets[i], false);

  auto first = static_cast<std::uint32_t>(scene.shapes.size());
  for (const Instance& instance : scene.instances) {
    const PartSet& set = *sets[instance.object + 1];
    objects.push_back({&set, AffineMap(instance.to_world), first});
    first += static_cast<std::uint32_t>(set.parts.size());
  }
  build_set(*sets.front(), true);

  bounds = world().bounds;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].set->bounds.empty()) continue;
    bounds.expand(scene.instances[i].to_world.bounds(objects[i].set->bounds));
    if (!within_reach(bounds)) {
      throw Error(Failure::scene,
                  (scene.source.empty() ? "the scene" : scene.source) + ": instance " + std::to_string(i) + " of object \"" +
                      scene.objects[scene.instances[i].object].name +
                      "\" is not within finite reach (1e17 times the size of the scene); correct its transform");
    }
  }
  bound_groups();
  turn_groups();
}

/// Finds the closed groups whose normals point inward.
void GeometryImpl::turn_groups() {
  constexpr double kClosed = 0.01;  // of the area; what shapes of a closed surface leave over are tessellated quadrics
  // Of an instance the set decides, as a mirroring map turns normals along with it.
  std::map<const PartSet*, std::vector<std::uint32_t>> inverted;  // a part of each such group
  for (const auto& set : sets) {
    std::map<BoundaryId, std::pair<std::uint32_t, Enclosure>> enclosures;
    for (const Part& part : set->parts) {
      if (!part.shape->boundary || part.box.empty()) continue;
      const auto entry = enclosures.try_emplace(*part.shape->boundary, part.index, Enclosure{}).first;
      entry->second.second.add(part.enclosure(Vec3d(set->bounds.center())));
    }
    for (const auto& [boundary, found] : enclosures) {
      const auto& [part, e] = found;
      if (e.volume < 0 && length(e.vector_area) <= kClosed * e.area) inverted[set.get()].push_back(part);
    }
  }
  const auto turn = [&](const PartSet& set, std::uint32_t first) {
    const auto parts = inverted.find(&set);
    if (parts == inverted.end()) return;
    for (const std::uint32_t part : parts->second) {
      BoundaryGroup& group = groups[placed[first + part].group];
      group.inverted = true;
      if (group.outside) std::swap(group.inside, group.outside);
    }
  };
  turn(world(), 0);
  for (const PlacedObject& object : objects) turn(*object.set, object.first_placed);
}

/// A part that is turned takes the box around its turned box.
void GeometryImpl::bound_groups() {
  const auto expand = [&](const PartSet& set, std::uint32_t first, const AffineMap* map) {
    for (const Part& part : set.parts) {
      const std::uint32_t group = placed[first + part.index].group;
      if (group == kNone || part.box.empty()) continue;
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p = part.box.corner(corner);
        groups[group].bounds.expand(map ? to_vec3(map->point(Vec3d(p))) : p);
      }
    }
  };
  expand(world(), 0, nullptr);
  for (const PlacedObject& object : objects) expand(*object.set, object.first_placed, &object.map);
}

void GeometryImpl::create_device(int threads) {
  // The library's limit holds for all of TBB as long as the device lives: as many threads as cores or more must stay
  // the default, or a render could not use them.
  if (kThreadsAreWatched) threads = 1;  // Embree builds with TBB, which a sanitizer cannot follow
  const bool fewer = threads > 0 && static_cast<unsigned>(threads) < std::thread::hardware_concurrency();
  const std::string count = fewer ? "threads=" + std::to_string(threads) + "," : "";
  device.reset(rtcNewDevice((count + "set_affinity=0").c_str()));
  if (!device) {
    throw Error(Failure::run_time,
                std::string("the ray tracing library cannot start: ") + describe(rtcGetDeviceError(nullptr)));
  }
  rtcSetDeviceErrorFunction(device.get(), on_error, this);
  rtcSetDeviceMemoryMonitorFunction(device.get(), on_memory, this);
}

void GeometryImpl::place_shapes(const Scene& scene) {
  std::map<std::pair<BoundaryId, std::uint32_t>, std::uint32_t> group_of;
  const auto place = [&](const Shape& shape, const Transform& to_world, std::uint32_t instance) {
    std::uint32_t group = kNone;
    if (shape.boundary) {
      if (*shape.boundary >= scene.boundaries.size()) {
        throw Error(shape.where, "the shape's boundary does not exist; add it to Scene::boundaries");
      }
      const Boundary& boundary = scene.boundaries[*shape.boundary];
      const auto next = static_cast<std::uint32_t>(groups.size());
      const auto [entry, is_new] = group_of.try_emplace({*shape.boundary, instance}, next);
      if (is_new) groups.push_back({boundary.inside, boundary.outside, {}});
      group = entry->second;
    }
    placed.push_back({&shape, to_world, instance, group});
  };
  for (const Shape& shape : scene.shapes) place(shape, shape.to_world, kNone);
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    if (instance.object >= scene.objects.size()) {
      throw Error(Failure::scene, "an instance refers to an object that does not exist; add it to Scene::objects");
    }
    for (const Shape& shape : scene.objects[instance.object].shapes) place(shape, instance.to_world * shape.to_world, i);
  }
}

std::unique_ptr<PartSet> GeometryImpl::make_set(const Scene& scene, const std::vector<Shape>& shapes,
                                                const Textures* textures) {
  auto set = std::make_unique<PartSet>();
  set->parts.reserve(shapes.size());
  for (const Shape& shape : shapes) {
    Part part = make_part(shape);
    part.index = static_cast<std::uint32_t>(set->parts.size());
    part.real = !is_interface(scene, shape);
    part.alpha_textures = textures_of_alpha(shape, textures);
    if (std::holds_alternative<TriangleMesh>(shape.kind)) triangle_count += part.primitive_count();
    for (std::uint32_t i = 0; i < part.primitive_count(); ++i) part.box.expand(part.primitive_bounds(i));
    require_within_reach(part.box, shape);
    set->bounds.expand(part.box);
    set->parts.push_back(std::move(part));
  }
  return set;
}

void GeometryImpl::build_set(PartSet& set, bool with_objects) {
  set.real = build_scene(set, true, with_objects);
  set.boundary = build_scene(set, false, with_objects);
}

Embree<RTCScene> GeometryImpl::build_scene(PartSet& set, bool real, bool with_objects) {
  Embree<RTCScene> scene(rtcNewScene(device.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  bool empty = true;
  for (Part& part : set.parts) {
    const auto is_this = [&](const SimpleBoundary& boundary) { return boundary.part == &part; };
    const bool is_simple = std::any_of(simple.begin(), simple.end(), is_this);
    const bool belongs = real ? part.real : part.shape->boundary && !is_simple;
    if (!belongs || part.primitive_count() == 0) continue;
    attach_part(scene.get(), part, real);
    empty = false;
  }
  for (std::uint32_t i = 0; with_objects && i < objects.size(); ++i) {
    if (!(real ? objects[i].set->real : objects[i].set->boundary)) continue;
    attach_object(scene.get(), objects[i], static_cast<std::uint32_t>(set.parts.size()) + i, real);
    empty = false;
  }
  if (empty) return nullptr;
  rtcCommitScene(scene.get());
  check_embree();
  return scene;
}

void GeometryImpl::attach_part(RTCScene scene, Part& part, bool real) {
  const bool triangles = real && uses_embree_triangles(part);
  const Embree<RTCGeometry> geometry(
      rtcNewGeometry(device.get(), triangles ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_USER));
  RTCGeometry g = geometry.get();
  rtcSetGeometryUserData(g, &part);
  if (triangles) {
    const auto& mesh = std::get<PlacedMesh>(part.form);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(), 0, sizeof(Vec3),
                               mesh.positions.size());
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices->data(), 0,
                               3 * sizeof(std::uint32_t), mesh.indices->size() / 3);
    if (part.alpha_textures) {
      rtcSetGeometryIntersectFilterFunction(g, part_alpha_filter);
      rtcSetGeometryOccludedFilterFunction(g, part_alpha_filter);
    }
  } else {
    rtcSetGeometryUserPrimitiveCount(g, part.primitive_count());
    rtcSetGeometryBoundsFunction(g, part_bounds, nullptr);
    rtcSetGeometryIntersectFunction(g, real ? part_intersect : part_record);
    if (real) rtcSetGeometryOccludedFunction(g, part_occluded);
  }
  rtcCommitGeometry(g);
  rtcAttachGeometryByID(scene, g, part.index);
  check_embree();
}

void GeometryImpl::attach_object(RTCScene scene, PlacedObject& object, std::uint32_t id, bool real) {
  const Embree<RTCGeometry> geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserData(geometry.get(), &object);
  rtcSetGeometryUserPrimitiveCount(geometry.get(), 1);
  rtcSetGeometryBoundsFunction(geometry.get(), object_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), real ? object_intersect : object_record);
  if (real) rtcSetGeometryOccludedFunction(geometry.get(), object_occluded);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene, geometry.get(), id);
}

void GeometryImpl::check_embree() {
  const std::lock_guard lock(error_mutex);
  if (!error.empty()) throw Error(Failure::run_time, "building the ray tracing structures failed: " + error);
}

std::size_t GeometryImpl::vertex_bytes() const {
  std::size_t bytes = 0;
  for (const auto& set : sets) {
    for (const Part& part : set->parts) {
      if (const auto* mesh = std::get_if<PlacedMesh>(&part.form)) {
        bytes += (mesh->positions.capacity() + mesh->normals.capacity()) * sizeof(Vec3);
      }
    }
  }
  return bytes;
}

}  // namespace tyndall
