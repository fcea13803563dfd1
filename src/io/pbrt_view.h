/// The directives before WorldBegin that set up the picture: Camera, Film, PixelFilter.
#pragma once

#include "io/pbrt_state.h"

namespace tyndall::pbrt {

void read_camera(State& state, Tokenizer& in, const Location& where);
void read_film(State& state, Tokenizer& in, const Location& where);
void read_pixel_filter(State& state, Tokenizer& in, const Location& where);

}  // namespace tyndall::pbrt
