/// Emissive bilinear patches: rectangles by solid angle, others nearly uniformly in area.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "light/emitter_sample.h"
#include "light/light_place.h"
#include "tyndall/scene.h"

namespace tyndall {

class PatchEmitter {
 public:
  /// Keeps texture coordinates only `with_uvs`.
  PatchEmitter(const BilinearMesh& mesh, const Transform& to_world, bool reverse_orientation, bool with_uvs);

  std::uint32_t size() const { return static_cast<std::uint32_t>(positions_.size() / 4); }
  double area(std::uint32_t i) const;
  EmitterExtent extent(std::uint32_t i) const;
  LightPlace place(std::uint32_t i) const;  ///< flat for rectangles

  std::optional<EmitterSample> sample(std::uint32_t i, const RoundedPoint& p, Vec2 u) const;
  /// 1/sr, of the direction from `p` to `hit` on the patch.
  float pdf(std::uint32_t i, const RoundedPoint& p, const RoundedPoint& hit) const;

  std::size_t memory_bytes() const;

 private:
  /// P(u, v) = p00 + u eu + v ev + uv euv, relative to an observer.
  struct Form {
    Vec3d p00, eu, ev, euv;
    Vec3d point(double u, double v) const { return p00 + eu * u + ev * v + euv * (u * v); }
    /// dP/du x dP/dv: not normalised, and affine in u and v, because euv x euv = 0.
    Vec3d normal(double u, double v) const { return cross(eu + euv * v, ev + euv * u); }
    /// Of a rectangle: the observer, who is at `p`, is in its plane.
    bool is_seen_edge_on(const RoundedPoint& p) const { return in_plane(p, p00, cross(eu, ev), length(euv)); }
    /// (u, v) of a point on the patch.
    std::array<double, 2> invert(Vec3d p) const;
  };
  Form form(std::uint32_t i, Vec3d observer) const;
  Vec3d outward(std::uint32_t i, Vec3d n) const { return flipped_[i] ? -n : n; }
  Vec2 uv(std::uint32_t i, double u, double v) const;

  std::vector<Vec3> positions_;  ///< world space, four a patch: (0,0) (1,0) (0,1) (1,1)
  std::vector<Vec2> uvs_;        ///< likewise, or empty: (u, v) themselves
  std::vector<bool> flipped_, rectangle_;
};

}  // namespace tyndall
