/// Stretches of media that need no pairs of a light and a distance.
#pragma once

#include "transport/light_context.h"
#include "transport/media/span.h"

namespace tyndall {

/// Whether choosing lights at the collision that the path draws anyhow says as much as pairs do:
/// - all lights are so far from the stretch that they shine on all of it alike, and its media so dense that many rays
///   collide: for 0.5 to 0.7 of the time; or
/// - no lamp comes close to where such media scatter before they are opaque, and after the first event not very close: in front
///   of a plume in a hall of bulbs for 0.66 of the instructions, with the same error; or
/// - after the path's first event, its media are all but opaque within the size of the lights' box: at depths of 10 to 50
///   for 0.8 to 1 of the time, with less error.
/// With the default settings of media and distance only. Deterministic, from a few reads of the media.
bool collisions_suffice(const LightContext& context, const Span& span);
/// The same for a ray in media, of which only the stretch that it starts in is known, and no end but that of their boxes.
bool collisions_suffice(const LightContext& context, const Ray& ray, const Interval& inside);
/// Whether that stretch is as dense as that asks for.
bool is_deep(const Ray& ray, const Interval& inside);

}  // namespace tyndall
