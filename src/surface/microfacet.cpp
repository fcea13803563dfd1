#include "surface/microfacet.h"

#include "math/warp.h"

namespace tyndall {

Ggx::Ggx(float alpha_x, float alpha_y) : ax_(alpha_x), ay_(alpha_y), mirror_(!(std::max(alpha_x, alpha_y) >= 1e-3f)) {
  // Rough along one axis only: the other keeps a width that floats can resolve.
  if (!mirror_) {
    ax_ = std::max(ax_, 1e-4f);
    ay_ = std::max(ay_, 1e-4f);
  }
}

float Ggx::D(Vec3 m) const {
  const float x = m.x / ax_, y = m.y / ay_;
  const float e = x * x + y * y + m.z * m.z;
  return kInvPi / (ax_ * ay_ * e * e);
}

float Ggx::G_over_cosine(Vec3 wo, Vec3 wi) const { return 2 / (stretched(wo) + stretched(wi) * (wo.z / wi.z)); }

float Ggx::shadowing(Vec3 wo, Vec3 wi) const {
  const float so = stretched(wo);
  return (so + wo.z) / (so + stretched(wi) * (wo.z / wi.z));
}

Vec3 Ggx::sample_visible(Vec3 w, Vec2 u) const {
  // Range until the surface is a hemisphere, seen along wh.
  const Vec3 wh = normalize(Vec3{ax_ * w.x, ay_ * w.y, w.z});
  // Perpendicular to wh however near the pole it is: an error here is as large as the lobe of a small alpha.
  const float across = std::hypot(wh.x, wh.y);
  const Vec3 t1 = across > 1e-15f ? Vec3{-wh.y / across, wh.x / across, 0} : Vec3{1, 0, 0};
  const Vec3 t2 = cross(wh, t1);

  // A point of its projection: a full disk whose lower half is squeezed by the tilt.
  const Vec2 disk = square_to_concentric_disk(u);
  const float h = std::sqrt(std::max(0.0f, 1 - disk.x * disk.x));
  const float y = std::lerp(h, disk.y, 0.5f * (1 + wh.z));

  // Back onto the hemisphere, unstretched.
  const float z = std::sqrt(std::max(0.0f, 1 - disk.x * disk.x - y * y));
  const Vec3 n = t1 * disk.x + t2 * y + wh * z;
  return normalize(Vec3{ax_ * n.x, ay_ * n.y, std::max(1e-6f, n.z)});
}

float Ggx::visible_pdf(Vec3 w, Vec3 m) const { return 2 * D(m) * std::max(0.0f, dot(w, m)) / (stretched(w) + w.z); }

float Ggx::reflected_pdf(Vec3 wo, Vec3 m) const { return dot(wo, m) > 0 ? 0.5f * D(m) / (stretched(wo) + wo.z) : 0.0f; }

}  // namespace tyndall
