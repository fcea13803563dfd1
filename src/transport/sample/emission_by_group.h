/// Volume emission along a ray, light group by light group.
#pragma once

#include "transport/media/span.h"
#include "transport/sample/grouped_light.h"

namespace tyndall {

/// How the emission of a part of a span was estimated.
struct PassedEmission {
  const SpanPart& part;
  const Ray& ray;
  EmissionLook look;
  Rng rng;  ///< as it was before
};

/// Adds T times `emitted`, what that estimate gave, to the groups of the media that emit. Where media of several groups overlap
/// each group is estimated by the same numbers again, so that the groups share out what was emitted.
void add_by_medium(const PassedEmission& passed, Rgb emitted, Rgb T, const LightGroups& groups, GroupedLight::Sums& into);

}  // namespace tyndall
