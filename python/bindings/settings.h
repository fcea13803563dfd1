/// Options of a render by their names on the command line, with underscores.
#pragma once

#include "convert.h"

namespace tyndall::python {

/// The scene's settings changed by `options`. Throws TypeError for a name that is no option, ValueError for a value that cannot
/// be.
RenderSettings with_options(const Scene& scene, const py::dict& options);
/// `settings` likewise by those that leave the right picture as it is, which methods that are compared may differ in.
RenderSettings with_method(RenderSettings settings, const py::dict& options);
/// All of them by name.
py::dict from_settings(const RenderSettings& settings);

}  // namespace tyndall::python
