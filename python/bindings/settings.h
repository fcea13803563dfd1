/// Options of a render by their names on the command line, with underscores.
#pragma once

#include "convert.h"

namespace tyndall::python {

/// `settings` changed by `options`. Throws TypeError for a name that is no option, ValueError for a value that cannot be.
RenderSettings with_options(RenderSettings settings, const py::dict& options);
/// All of them by name.
py::dict from_settings(const RenderSettings& settings);

}  // namespace tyndall::python
