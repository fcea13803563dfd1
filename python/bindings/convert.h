/// Between Python's values and Tyndall's. The Python side (python/tyndall) has checked shapes and types: what arrives here are
/// tuples of numbers and contiguous arrays.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <string_view>
#include <vector>

#include "tyndall/image.h"
#include "tyndall/scene.h"

namespace tyndall::python {

namespace py = pybind11;
using namespace py::literals;

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;

/// `value` as a T. TypeError, which calls it `name`, for what is none.
template <typename T>
T as(py::handle value, const char* name) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    throw py::type_error(std::string(name) + " = " + py::repr(value).cast<std::string>() +
                         " is not understood; give another value");
  }
}
template <typename T>
T get(py::handle object, const char* name) {
  return as<T>(object.attr(name), name);
}
template <typename T>
T entry(const py::dict& options, const char* name) {
  return as<T>(options[name], name);
}

/// Names, of files or of what a scene holds, are bytes in Tyndall; in Python they are what os.fsdecode makes of them, so that
/// the same bytes come back. ValueError for a name with a NUL, which would end it.
std::string to_name(py::handle value, const char* what);
py::str from_name(std::string_view name);
/// What is for reading: bad bytes become U+FFFD.
py::str from_text(std::string_view text);
py::list from_names(const std::vector<std::string>& names);

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
