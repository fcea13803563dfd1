/// What the boundaries of media of a whole scene say together.
#pragma once

#include "io/pbrt_state.h"

namespace tyndall::pbrt {

/// Says, at the end of the reading, when boundaries seem to cross each other: media add up there, and in pbrt they do not.
void warn_of_crossing_boundaries(State& state);

}  // namespace tyndall::pbrt
