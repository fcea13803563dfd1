#include "io/pbrt_boundaries.h"

#include <algorithm>
#include <map>

namespace tyndall::pbrt {
namespace {

/// A boundary where it stands, by its box.
struct PlacedBoundary {
  Bounds3 box;
  Location where;  ///< of its first shape
};

struct ObjectBox {
  Bounds3 operator()(const TriangleMesh& s) const { return of(s.positions); }
  Bounds3 operator()(const BilinearMesh& s) const { return of(s.positions); }
  Bounds3 operator()(const Sphere& s) const { return round(s.radius, s.z_min, s.z_max); }
  Bounds3 operator()(const Disk& s) const { return round(s.radius, s.height, s.height); }
  Bounds3 operator()(const Cylinder& s) const { return round(s.radius, s.z_min, s.z_max); }

 private:
  static Bounds3 of(const std::vector<Vec3>& points) {
    Bounds3 box;
    for (const Vec3& p : points) box.expand(p);
    return box;
  }
  static Bounds3 round(float radius, float low, float high) { return {{-radius, -radius, low}, {radius, radius, high}}; }
};

using Boundaries = std::map<BoundaryId, PlacedBoundary>;

Boundaries boundaries_of(const std::vector<Shape>& shapes) {
  Boundaries boundaries;
  for (const Shape& shape : shapes) {
    if (!shape.boundary) continue;
    const auto place = boundaries.try_emplace(*shape.boundary, PlacedBoundary{{}, shape.where}).first;
    place->second.box.expand(shape.to_world.bounds(std::visit(ObjectBox{}, shape.kind)));
  }
  return boundaries;
}

std::vector<PlacedBoundary> placed_boundaries(const Scene& scene) {
  std::vector<PlacedBoundary> placed;
  for (const auto& [id, boundary] : boundaries_of(scene.shapes)) placed.push_back(boundary);
  std::vector<Boundaries> of_objects;
  for (const Object& object : scene.objects) of_objects.push_back(boundaries_of(object.shapes));
  for (const Instance& instance : scene.instances)
    for (const auto& [id, boundary] : of_objects[instance.object])
      placed.push_back({instance.to_world.bounds(boundary.box), boundary.where});
  return placed;
}

/// Much of the smaller box lies in the other, and each sticks out: nested boundaries are what both renderers understand, and
/// the boxes of neighbours may share a corner.
bool cross_each_other(const Bounds3& a, const Bounds3& b) {
  constexpr float kTouching = 1e-3f, kMuch = 0.15f;
  bool a_sticks_out = false, b_sticks_out = false;
  float share = 1;
  for (int i = 0; i < 3; ++i) {
    const float smaller = std::min(a.max[i] - a.min[i], b.max[i] - b.min[i]), dust = kTouching * smaller;
    const float common = std::min(a.max[i], b.max[i]) - std::max(a.min[i], b.min[i]);
    if (!(common > dust)) return false;
    share *= common / smaller;
    a_sticks_out |= a.min[i] < b.min[i] - dust || a.max[i] > b.max[i] + dust;
    b_sticks_out |= b.min[i] < a.min[i] - dust || b.max[i] > a.max[i] + dust;
  }
  return a_sticks_out && b_sticks_out && share > kMuch;
}

}  // namespace

void warn_of_crossing_boundaries(State& state) {
  constexpr std::size_t kMostPairs = 1'000'000;  // looked at: a fraction of a second
  std::vector<PlacedBoundary> placed = placed_boundaries(state.scene);
  std::stable_sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.box.min.x < b.box.min.x; });
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    for (std::size_t j = i + 1; j < placed.size() && placed[j].box.min.x < placed[i].box.max.x; ++j) {
      if (++pairs > kMostPairs) return;
      if (!cross_each_other(placed[i].box, placed[j].box)) continue;
      state.reports.warn(placed[j].where,
                         "boundaries of media seem to cross here: in Tyndall both media fill what both hold, in pbrt-v4 the "
                         "boundary that a path passed last decides");
      return;
    }
  }
}

}  // namespace tyndall::pbrt
