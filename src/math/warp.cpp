#include "math/warp.h"

namespace tyndall {

namespace {

constexpr float kInvTwoPi = 0.5f * kInvPi;

/// Direction with height z = 1 - drop; 1 - z^2 is formed as drop (2 - drop), which keeps its digits near the pole.
Vec3 direction_at(float drop, float u) {
  const float r = std::sqrt(std::max(0.0f, drop * (2 - drop)));
  const float phi = 2 * kPi * u;
  return {r * std::cos(phi), r * std::sin(phi), 1 - drop};
}

}  // namespace

Vec2 square_to_concentric_disk(Vec2 u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const float r = wide ? a : b;
  const float phi = wide ? kPi / 4 * (b / a) : kPi / 2 - kPi / 4 * (a / b);
  return {r * std::cos(phi), r * std::sin(phi)};
}

float concentric_disk_pdf(Vec2 p) { return p.x * p.x + p.y * p.y <= 1 ? kInvPi : 0.0f; }

Vec3 square_to_uniform_hemisphere(Vec2 u) { return direction_at(u.x, u.y); }

float uniform_hemisphere_pdf(Vec3 w) { return w.z >= 0 ? kInvTwoPi : 0.0f; }

Vec3 square_to_cosine_hemisphere(Vec2 u) {
  const Vec2 d = square_to_concentric_disk(u);
  return {d.x, d.y, std::sqrt(std::max(0.0f, 1 - d.x * d.x - d.y * d.y))};
}

float cosine_hemisphere_pdf(Vec3 w) { return std::max(0.0f, w.z) * kInvPi; }

Vec3 square_to_uniform_sphere(Vec2 u) { return direction_at(2 * u.x, u.y); }

float uniform_sphere_pdf(Vec3) { return 0.25f * kInvPi; }

Vec3 square_to_uniform_cone(Vec2 u, float h) { return direction_at(u.x * h, u.y); }

float uniform_cone_pdf(Vec3 w, float h) {
  // 1 - cos theta from the sine where the cosine has run out of digits.
  const float drop = w.z > 0.9f ? (w.x * w.x + w.y * w.y) / (1 + w.z) : 1 - w.z;
  return drop <= h * (1 + 1e-6f) ? kInvTwoPi / h : 0.0f;
}

}  // namespace tyndall
