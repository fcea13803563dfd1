/// The directives LightSource and AreaLightSource.
#pragma once

#include "io/pbrt_state.h"

namespace tyndall::pbrt {

void read_light_source(State& state, Tokenizer& in, const Location& where);
void read_area_light_source(State& state, Tokenizer& in, const Location& where);

}  // namespace tyndall::pbrt
