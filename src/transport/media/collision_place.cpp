#include "transport/media/collision_place.h"

#include <algorithm>

#include "math/vec3d.h"

namespace tyndall {
namespace {

/// Farther than this from both ends of a part, relative to coordinates, rounding crosses no boundary that the ray does not
/// nearly graze: 1024 roundings. Nearer, the geometry is asked: to move every collision as far would thin media whose mean free
/// paths are as short.
constexpr float kFar = 0x1p-13f;
/// A boundary nearer than this may be on either side: roundings of double precision, and to spare.
constexpr float kOn = 0x1p-40f;

float size_of(Vec3 p) { return static_cast<float>(largest_coordinate(Vec3d(p))); }

/// Whether lines from `p` along `d` and -d leave just the groups of `state`. Not on a boundary, therefore.
bool holds(const Geometry& geometry, Vec3 p, Vec3 d, const MediaState& state) {
  for (const Vec3 side : {d, -d}) {
    MediaState left = state;
    for (const Crossing& c : geometry.trace_all({p, side}, kOn * size_of(p), kInfinity)) {
      if (!left.cross(c.group, c.sign)) return false;
    }
    if (left.in_any_group()) return false;
  }
  return true;
}

}  // namespace

float collision_margin(const Ray& ray, float t) { return kFar * (size_of(ray.o) + t); }

float collision_place(const Geometry& geometry, const Ray& ray, const SpanPart& part, const std::optional<SurfaceHit>& hit,
                      float t) {
  const float size = size_of(ray.o) + t;
  const float far = std::min(collision_margin(ray, t), 0.5f * (part.t1 - part.t0));
  if (t - part.t0 >= far && part.t1 - t >= far) return t;

  const auto fits = [&](float moved) { return holds(geometry, ray.at(moved), ray.d, part.state); };
  const bool at_surface = hit && part.t1 >= hit->t;
  const float from_surface = at_surface ? hit->position_error / std::max(abs_dot(hit->ng, ray.d), 1e-3f) : 0;
  for (const float roundings : {0.0f, 0.25f, 0.5f, 1.0f, 2.0f, 4.0f, 16.0f}) {
    const float margin = roundings * 0x1p-23f * size;
    const float last = part.t1 - std::max(margin, from_surface);
    if (margin >= far || part.t0 + margin > last) break;
    const float moved = std::clamp(t, part.t0 + margin, last);
    if (fits(moved)) return moved;
  }
  // A ray that all but grazes the boundary at its end: back toward where it began.
  if (part.t0 == 0) {
    for (const float moved : {0.25f * t, 0.0f}) {
      if (fits(moved)) return moved;
    }
  }
  return std::clamp(t, part.t0 + far, part.t1 - far);
}

}  // namespace tyndall
