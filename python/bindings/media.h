/// Media of the Python side: homogeneous ones, and grids of arrays.
#pragma once

#include "convert.h"

namespace tyndall::python {

/// A medium and the box that holds it, in medium space.
struct BoxedMedium {
  Medium medium;
  Bounds3 bounds;
};
BoxedMedium to_medium(py::handle medium);

}  // namespace tyndall::python
