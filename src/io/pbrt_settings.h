/// The directives Sampler, Integrator and Option: how to render.
#pragma once

#include "io/pbrt_state.h"

namespace tyndall::pbrt {

void read_sampler(State& state, Tokenizer& in, const Location& where);
void read_integrator(State& state, Tokenizer& in, const Location& where);
/// At WorldBegin, when all of them are read: a limit of time or error alone leaves the number of samples open.
void finish_settings(State& state);
/// At the end of the scene.
void warn_of_media_passed_over(State& state);
void read_option(State& state, Tokenizer& in, const Location& where);

}  // namespace tyndall::pbrt
