/// The directives MakeNamedMedium and MediumInterface.
#pragma once

#include "io/pbrt_state.h"

namespace tyndall::pbrt {

void read_make_named_medium(State& state, Tokenizer& in, const Location& where);
void read_medium_interface(State& state, Tokenizer& in, const Location& where);

}  // namespace tyndall::pbrt
