/// The place of a collision, as single precision can hold it.
#pragma once

#include "transport/media/span.h"

namespace tyndall {

/// `t` of a collision in `part` of `ray`, moved as little as makes ray.at() of it lie among the media of the part: rounded,
/// a place right at a boundary can be across it, and the next ray would never pass it. `hit`: what ends the ray, whose
/// surface keeps as far away as rays that leave it start.
float collision_place(const Geometry& geometry, const Ray& ray, const SpanPart& part, const std::optional<SurfaceHit>& hit,
                      float t);

/// Farther than this from all boundaries on the ray, a collision at `t` stays where it is.
float collision_margin(const Ray& ray, float t);

}  // namespace tyndall
