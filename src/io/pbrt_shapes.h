/// The directive Shape.
#pragma once

#include "io/pbrt_state.h"

namespace tyndall::pbrt {

void read_shape(State& state, Tokenizer& in, const Location& where);

}  // namespace tyndall::pbrt
