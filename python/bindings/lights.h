/// Lights and the camera: each a small class of the Python side with the fields of its struct.
#pragma once

#include "convert.h"

namespace tyndall::python {

Light to_light(py::handle light);
py::object from_light(const Light& light);

/// What a Python camera does not say (the medium around it, lenses) stays as it is in `camera`.
void set_camera(Camera& camera, py::handle value);
py::object from_camera(const Camera& camera);

}  // namespace tyndall::python
