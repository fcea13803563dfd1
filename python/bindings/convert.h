/// Between Python's values and Tyndall's. The Python side (python/tyndall) has checked shapes and types: what arrives here are
/// tuples of numbers and contiguous arrays.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "tyndall/image.h"
#include "tyndall/scene.h"

namespace tyndall::python {

namespace py = pybind11;
using namespace py::literals;

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;

template <typename T>
T get(py::handle object, const char* name) {
  return object.attr(name).cast<T>();
}

Vec3 to_vec3(py::handle triple);
Rgb to_rgb(py::handle triple);
py::tuple from_vec3(Vec3 v);
py::tuple from_rgb(Rgb c);

Transform to_transform(py::handle matrix);  ///< of four rows, column vectors
py::object from_transform(const Transform& transform);

Location to_location(py::handle where);  ///< (file, line, column)
py::tuple from_location(const Location& where);

std::vector<float> to_floats(const Floats& array);

/// A class of the Python side: "tyndall.lights", "PointLight".
py::object python_class(const char* module, const char* name);

/// Shapes of the Python class tyndall.Image; the arrays that come out own the image's floats.
Image to_image(py::handle image);
py::object from_image(Image image);

}  // namespace tyndall::python
