/// The directives that change the current transformation matrix.
#pragma once

#include "io/pbrt_state.h"

namespace tyndall::pbrt {

void read_identity(State& state, Tokenizer& in, const Location& where);
void read_translate(State& state, Tokenizer& in, const Location& where);
void read_scale(State& state, Tokenizer& in, const Location& where);
void read_rotate(State& state, Tokenizer& in, const Location& where);
void read_look_at(State& state, Tokenizer& in, const Location& where);
void read_transform(State& state, Tokenizer& in, const Location& where);
void read_concat_transform(State& state, Tokenizer& in, const Location& where);
void read_coordinate_system(State& state, Tokenizer& in, const Location& where);
void read_coord_sys_transform(State& state, Tokenizer& in, const Location& where);
void read_active_transform(State& state, Tokenizer& in, const Location& where);
void read_transform_times(State& state, Tokenizer& in, const Location& where);

}  // namespace tyndall::pbrt
