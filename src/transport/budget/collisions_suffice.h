/// Segments of media that need no pairs of a light and a distance.
#pragma once

#include "transport/media/span.h"
#include "transport/sample/light_context.h"

namespace tyndall {

/// Whether choosing lights at the collision that the path draws anyhow suffices: after the first bounce in media that are known
/// by reads alone; elsewhere where light that is found there and nowhere else hardly varies, as a few reads of the media and
/// the distance to the nearest light tell. With the default settings of media and distance only. Deterministic.
bool collisions_suffice(const LightContext& context, const Span& span);
/// The same for a ray in media, of which only the segment that it starts in is known, and no end but that of their boxes.
bool collisions_suffice(const LightContext& context, const Ray& ray, const Interval& inside);
/// Whether so many rays collide in that segment that they suffice where all of it is lit alike.
bool is_deep(const Ray& ray, const Interval& inside);

}  // namespace tyndall
