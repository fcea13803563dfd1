/// The parameter "lightgroup" of what emits.
#pragma once

#include "io/pbrt_params.h"

namespace tyndall::pbrt {

/// Empty where there is none. Not of pbrt, which refuses it at the light itself but takes it from an Attribute directive.
std::string read_light_group(ParamList& params);

}  // namespace tyndall::pbrt
