/// The directives Material, MakeNamedMaterial and NamedMaterial.
#pragma once

#include "io/pbrt_state.h"

namespace tyndall::pbrt {

void read_material(State& state, Tokenizer& in, const Location& where);
void read_make_named_material(State& state, Tokenizer& in, const Location& where);
void read_named_material(State& state, Tokenizer& in, const Location& where);

}  // namespace tyndall::pbrt
