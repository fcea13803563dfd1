#include "volume/phase/phase.h"

namespace tyndall {

float Rayleigh::pdf(Vec3 wo, Vec3 wi) const {
  const float cosine = dot(wo, wi);
  return 3 / (16 * kPi) * (1 + cosine * cosine);
}

PhaseSample Rayleigh::sample(Vec3 wo, Vec2 u) const {
  const Vec3 wi = Draine(0, 1).sample(wo, u).wi;
  return {wi, pdf(wo, wi)};
}

}  // namespace tyndall
