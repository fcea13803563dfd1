#include "volume/phase/phase_mix.h"

#include <algorithm>

namespace tyndall {
namespace {

/// Channel by channel; 0 where nothing scatters.
Rgb share(Rgb part, Rgb total) {
  return {total.r > 0 ? part.r / total.r : 0, total.g > 0 ? part.g / total.g : 0, total.b > 0 ? part.b / total.b : 0};
}

}  // namespace

void PhaseMix::add(Rgb sigma_s, const Phase& phase) {
  if (is_black(sigma_s)) return;
  total_ += sigma_s;
  for (Lobe& lobe : lobes_)
    if (lobe.phase == &phase || *lobe.phase == phase) {
      lobe.sigma_s += sigma_s;
      return;
    }
  lobes_.push_back({sigma_s, &phase});
}

float PhaseMix::lobe_mass(const Lobe& lobe, Rgb beta) const {
  const Rgb s = share(lobe.sigma_s, total_);
  return std::abs(beta.r) * s.r + std::abs(beta.g) * s.g + std::abs(beta.b) * s.b;
}

float PhaseMix::chance(std::size_t lobe, Rgb beta) const {
  if (lobes_.size() == 1) return 1;
  float mass = 0;
  for (const Lobe& l : lobes_) mass += lobe_mass(l, beta);
  return mass > 0 ? lobe_mass(lobes_[lobe], beta) / mass : 0;
}

Rgb PhaseMix::eval(Vec3 wo, Vec3 wi) const {
  Rgb sum;
  for (const Lobe& lobe : lobes_) sum += share(lobe.sigma_s, total_) * tyndall::pdf(*lobe.phase, wo, wi);
  return sum;
}

float PhaseMix::pdf(Vec3 wo, Vec3 wi, Rgb beta) const {
  if (lobes_.size() == 1) return tyndall::pdf(*lobes_[0].phase, wo, wi);
  float sum = 0, mass = 0;
  for (const Lobe& lobe : lobes_) {
    const float m = lobe_mass(lobe, beta);
    mass += m;
    sum += m * tyndall::pdf(*lobe.phase, wo, wi);
  }
  return mass > 0 ? sum / mass : 0;
}

std::optional<PhaseMix::MixSample> PhaseMix::sample(Vec3 wo, Rgb beta, float uc, Vec2 u) const {
  if (lobes_.empty()) return std::nullopt;
  if (lobes_.size() == 1) {
    const PhaseSample s = tyndall::sample(*lobes_[0].phase, wo, u);
    return MixSample{s.wi, share(total_, total_), s.pdf};
  }
  float mass = 0;
  for (const Lobe& lobe : lobes_) mass += lobe_mass(lobe, beta);
  if (!(mass > 0)) return std::nullopt;

  float rest = uc * mass;
  const Lobe* chosen = lobes_.begin();
  for (const Lobe& lobe : lobes_) {
    const float m = lobe_mass(lobe, beta);
    if (m == 0) continue;
    chosen = &lobe;
    if (rest < m) break;
    rest -= m;
  }
  const Vec3 wi = tyndall::sample(*chosen->phase, wo, u).wi;
  const float density = pdf(wo, wi, beta);
  return MixSample{wi, eval(wo, wi) / density, density};
}

float PhaseMix::mean_cosine() const {
  float sum = 0;
  for (const Lobe& lobe : lobes_) sum += tyndall::mean_cosine(*lobe.phase) * mean(share(lobe.sigma_s, total_));
  return sum;
}

}  // namespace tyndall
