/// Segments of media that need no pairs of a light and a distance.
#pragma once

#include "transport/media/span.h"
#include "transport/sample/light_context.h"

namespace tyndall {

/// Whether choosing lights at the collision that the path draws anyhow suffices:
/// - all lights are so far that they illuminate all of the segment alike, and its media so dense that many rays collide, or
///   after the first bounce such that they are known by reads alone; or
/// - no light comes close to where such media scatter before they are opaque, and after the first bounce not very close; or
/// - after the path's first collision, its media are nearly opaque within the size of the lights' box.
/// With the default settings of media and distance only. Deterministic, from a few reads of the media (docs/measurements.md).
bool collisions_suffice(const LightContext& context, const Span& span);
/// The same for a ray in media, of which only the segment that it starts in is known, and no end but that of their boxes.
bool collisions_suffice(const LightContext& context, const Ray& ray, const Interval& inside);
/// Whether that segment is as dense as that asks for.
bool is_deep(const Ray& ray, const Interval& inside);

}  // namespace tyndall
