/// The phase function of a medium.
#pragma once

#include "io/pbrt_params.h"
#include "tyndall/phase.h"

namespace tyndall::pbrt {

/// By "string phase", HG unless given, and the parameters that its kind has.
Phase read_phase(ParamList& params);

}  // namespace tyndall::pbrt
