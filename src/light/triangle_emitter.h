/// Emissive triangles: 36 bytes each, sampled by solid angle.
#pragma once

#include <cstdint>
#include <vector>

#include "light/emitter_sample.h"
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

  /// Uniform in solid angle; uniform in area where the triangle is too small or too near its own plane for that.
  std::optional<EmitterSample> sample(std::uint32_t i, Vec3 p, Vec2 u) const;
  float pdf(std::uint32_t i, Vec3 p, Vec3 hit) const;  ///< 1/sr, of the direction from `p` to `hit` on the triangle

  std::size_t memory_bytes() const;

 private:
  Vec3d vertex(std::uint32_t i, int k) const { return Vec3d(positions_[3 * std::size_t(i) + k]); }
  Vec3 normal(std::uint32_t i) const;
  Vec2 uv(std::uint32_t i, double b1, double b2) const;

  std::vector<Vec3> positions_;  ///< world space, three a triangle
  std::vector<Vec2> uvs_;        ///< likewise, or empty: (0,0) (1,0) (1,1)
  std::vector<bool> flipped_;    ///< the normal is against (p1 - p0) x (p2 - p0)
};

}  // namespace tyndall
