/// Directional albedo of lobes that have no closed form.
#pragma once

#include "surface/bsdf_sample.h"

namespace tyndall {

/// Mean sample weight over 16 fixed points (radical inverses in bases 2, 3 and 5), as power: without 1/eta^2.
template <typename Lobe>
Rgb sampled_albedo(const Lobe& lobe, Vec3 wo) {
  constexpr int kSamples = 16;
  const auto radical_inverse = [](int i, int base) {
    float inverse = 0, digit = 1.0f / float(base);
    for (; i > 0; i /= base, digit /= float(base)) inverse += digit * float(i % base);
    return inverse;
  };
  Rgb sum;
  for (int i = 0; i < kSamples; ++i)
    if (const auto s = lobe.sample(wo, radical_inverse(i + 1, 5), {(float(i) + 0.5f) / kSamples, radical_inverse(i, 2)}))
      sum += s->weight * (s->eta * s->eta);
  return sum / kSamples;
}

}  // namespace tyndall
