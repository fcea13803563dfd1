/// What media do at a point.
#pragma once

#include "transport/media/media_state.h"
#include "volume/phase/phase_mix.h"

namespace tyndall {

struct Scattering {
  Rgb sigma_s;
  float sigma_t = 0;  ///< mean of the channels
  PhaseMix phase;

  static Scattering at(const ActiveMedia& media, Vec3 p) {
    Scattering s;
    for (const ParticipatingMedium* medium : media) {
      const auto [sigma_a, sigma_s] = medium->optics_at(p);
      s.sigma_s += sigma_s;
      s.sigma_t += mean(sigma_a + sigma_s);
      s.phase.add(sigma_s, medium->phase());
    }
    return s;
  }
  /// 1/sr, without regard to the path: both sides of MIS know it.
  float pdf(Vec3 wo, Vec3 wi) const { return phase.pdf(wo, wi, Rgb(1.0f)); }
};

}  // namespace tyndall
