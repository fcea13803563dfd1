/// The parts of the module tyndall._core.
#pragma once

#include "convert.h"

namespace tyndall::python {

void define_render(py::module_& m);
void define_scene(py::module_& m);
void define_images(py::module_& m);

}  // namespace tyndall::python
