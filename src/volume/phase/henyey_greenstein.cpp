#include "volume/phase/direction.h"
#include "volume/phase/phase.h"

namespace tyndall {

/// Exact inversion. With a = 1 - |g| and q = (1 - g^2) / (a + 2 |g| u):
/// cos = (1 + g^2 - q^2) / (2 |g|), rewritten as 1 - cos = a (1 - u) (q + a) / (a + 2 |g| u), good down to g = 0.
PhaseSample HenyeyGreenstein::sample(Vec3 wo, Vec2 u) const {
  const float h = std::min(std::abs(g), kMaxAbsG);
  const float a = 1 - h;
  const float d = a + 2 * h * u.x;
  const float q = a * (1 + h) / d;
  const float one_minus_cos = std::clamp(a * (1 - u.x) * (q + a) / d, 0.0f, 2.0f);
  const Vec3 wi = direction_about(g >= 0 ? -wo : wo, one_minus_cos, u.y);
  return {wi, pdf(wo, wi)};
}

}  // namespace tyndall
