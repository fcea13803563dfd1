#include "surface/fresnel.h"

namespace tyndall {

namespace {

constexpr float sqr(float x) { return x * x; }

/// cos^2 of the refracted angle by Snell's law; negative on total internal reflection.
/// 1 - (1 - c^2) / eta^2, written so that eta = 1 gives exactly c^2.
float cos2_refracted(float cos_i, float eta) { return (sqr(eta) - 1 + sqr(cos_i)) / sqr(eta); }

/// For |n|^2 = (eta + i k)^2: the complex cosine enters through a^2 + b^2 and a [Lagarde 2013, after Born and Wolf].
float fresnel_conductor(float c, float eta, float k) {
  const float c2 = c * c, s2 = 1 - c2;
  const float t0 = (eta - 1) * (eta + 1) + c2 - k * k;  // eta^2 - k^2 - sin^2, exact for eta = 1
  const float a2_plus_b2 = std::hypot(t0, 2 * eta * k);
  const float a = std::sqrt(std::max(0.0f, 0.5f * (a2_plus_b2 + t0)));

  const float s_sum = a2_plus_b2 + c2, s_difference = 2 * c * a;
  const float perpendicular = (s_sum - s_difference) / (s_sum + s_difference);
  const float p_sum = c2 * a2_plus_b2 + s2 * s2, p_difference = s_difference * s2;
  const float parallel = perpendicular * (p_sum - p_difference) / (p_sum + p_difference);
  return std::clamp(0.5f * (perpendicular + parallel), 0.0f, 1.0f);
}

}  // namespace

float fresnel_dielectric(float cos_i, float eta) {
  const float ci = std::clamp(cos_i, 0.0f, 1.0f);
  const float ct2 = cos2_refracted(ci, eta);
  if (ct2 <= 0) return 1;
  const float ct = std::sqrt(ct2);
  const float parallel = (eta * ci - ct) / (eta * ci + ct);
  const float perpendicular = (ci - eta * ct) / (ci + eta * ct);
  return 0.5f * (sqr(parallel) + sqr(perpendicular));
}

Rgb fresnel_conductor(float cos_i, Rgb eta, Rgb k) {
  const float c = std::clamp(cos_i, 0.0f, 1.0f);
  if (c * c == 0) return Rgb(1.0f);  // where the formula is 0/0 for index 1
  return {fresnel_conductor(c, eta.r, k.r), fresnel_conductor(c, eta.g, k.g), fresnel_conductor(c, eta.b, k.b)};
}

std::optional<Vec3> refract(Vec3 w, Vec3 n, float eta) {
  const float cos_i = dot(w, n);
  const float ct2 = cos2_refracted(cos_i, eta);
  if (ct2 <= 0) return std::nullopt;
  return normalize(n * (cos_i / eta - std::sqrt(ct2)) - w / eta);
}

}  // namespace tyndall
