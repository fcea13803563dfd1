/// Emissive triangles: 36 bytes each, sampled by solid angle.
#pragma once

#include <cstdint>
#include <vector>

#include "light/emitter_sample.h"
#include "light/light_place.h"
#include "tyndall/scene.h"

namespace tyndall {

class TriangleEmitter {
 public:
  /// Keeps texture coordinates only `with_uvs`.
  TriangleEmitter(const TriangleMesh& mesh, const Transform& to_world, bool reverse_orientation, bool with_uvs);

  std::uint32_t size() const { return static_cast<std::uint32_t>(positions_.size() / 3); }
  double area(std::uint32_t i) const;
  EmitterExtent extent(std::uint32_t i) const;
  Bounds3 box(std::uint32_t i) const;
  LightPlace place(std::uint32_t i) const;

  /// Uniform in solid angle; uniform in area, which is faster, where the triangle is far off, which comes to the same, and
  /// where it is too small or `p` too near its own plane.
  std::optional<EmitterSample> sample(std::uint32_t i, const RoundedPoint& p, Vec2 u) const;
  /// 1/sr, of the direction from `p` to `hit` on the triangle.
  float pdf(std::uint32_t i, const RoundedPoint& p, const RoundedPoint& hit) const;

  std::size_t memory_bytes() const;

 private:
  Vec3d vertex(std::uint32_t i, int k) const { return Vec3d(positions_[3 * std::size_t(i) + k]); }
  Vec3 normal(std::uint32_t i) const;
  Vec3 oriented(std::uint32_t i, const Vec3d& n) const;  ///< unit, along the outer one of n and -n
  /// Uniform over the area; a vertex relative to the observer, and the edges from it.
  std::optional<EmitterSample> sample_area(std::uint32_t i, const Vec3d& a, const Vec3d& e1, const Vec3d& e2, Vec2 u) const;
  Vec2 uv(std::uint32_t i, double b1, double b2) const;

  std::vector<Vec3> positions_;  ///< world space, three a triangle
  std::vector<Vec2> uvs_;        ///< likewise, or empty: (0,0) (1,0) (1,1)
  std::vector<bool> flipped_;    ///< the normal is against (p1 - p0) x (p2 - p0)
};

}  // namespace tyndall
