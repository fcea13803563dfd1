#include "surface/bump.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// `frame` about the normal of the tangents, turned to the side of `ng`; as it was when they are parallel or not finite.
Frame bent(const Frame& frame, Vec3 ng, Vec3 dpdu, Vec3 dpdv) {
  const Vec3 n = normalize(cross(dpdu, dpdv));
  if (!is_finite(n) || length_squared(n) == 0) return frame;
  return Frame::around(face_forward(n, ng), dpdu);
}

}  // namespace

Footprint footprint_on(const SurfaceTangents& tangents, Vec3 dpdx, Vec3 dpdy) {
  constexpr float kMost = 1e8f;
  const Vec3 u = tangents.dpdu, v = tangents.dpdv;
  const float uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), determinant = uu * vv - uv * uv;
  const auto solve = [&](Vec3 step) {
    const float bu = dot(u, step), bv = dot(v, step);
    const float du = (vv * bu - uv * bv) / determinant, dv = (uu * bv - uv * bu) / determinant;
    return Vec2{std::isfinite(du) ? std::clamp(du, -kMost, kMost) : 0, std::isfinite(dv) ? std::clamp(dv, -kMost, kMost) : 0};
  };
  return {dpdx, dpdy, solve(dpdx), solve(dpdy)};
}

Frame normal_mapped(const Frame& shading, Vec3 ng, Rgb texel) {
  const Vec3 local = normalize(Vec3{2 * texel.r - 1, 2 * texel.g - 1, 2 * texel.b - 1});
  const Vec3 n = shading.to_world(local);
  if (!(length_squared(n) > 0.5f)) return shading;  // a grey texel holds no direction
  return Frame::around(face_forward(n, ng), shading.x);
}

Frame bumped(const Frame& shading, const TextureQuery& at, const SurfaceTangents& tangents,
             const std::function<float(const TextureQuery&)>& height) {
  constexpr float kLeast = 0.0005f;
  const Footprint none{};
  const Footprint& f = at.footprint ? *at.footprint : none;
  const float du = std::max(kLeast, 0.5f * (std::abs(f.duvdx.x) + std::abs(f.duvdy.x)));
  const float dv = std::max(kLeast, 0.5f * (std::abs(f.duvdx.y) + std::abs(f.duvdy.y)));
  TextureQuery along_u = at, along_v = at;
  along_u.p += du * tangents.shading_dpdu;
  along_u.uv.x += du;
  along_v.p += dv * tangents.shading_dpdv;
  along_v.uv.y += dv;
  // dp'/du = dp/du + dh/du n + h dn/du
  const float h = height(at);
  const Vec3 dpdu = tangents.shading_dpdu + (height(along_u) - h) / du * shading.z + h * tangents.dndu;
  const Vec3 dpdv = tangents.shading_dpdv + (height(along_v) - h) / dv * shading.z + h * tangents.dndv;
  return bent(shading, at.n, dpdu, dpdv);
}

}  // namespace tyndall
