#include "convert.h"

#include <algorithm>

namespace tyndall::python {

Vec3 to_vec3(py::handle triple) {
  const auto [x, y, z] = triple.cast<std::array<float, 3>>();
  return {x, y, z};
}

Rgb to_rgb(py::handle triple) {
  const auto [r, g, b] = triple.cast<std::array<float, 3>>();
  return {r, g, b};
}

py::tuple from_vec3(Vec3 v) { return py::make_tuple(v.x, v.y, v.z); }
py::tuple from_rgb(Rgb c) { return py::make_tuple(c.r, c.g, c.b); }

Transform to_transform(py::handle matrix) { return Transform(matrix.attr("tolist")().cast<Transform::Matrix>()); }

py::object from_transform(const Transform& transform) {
  return py::module_::import("numpy").attr("array")(transform.matrix(), "dtype"_a = "float64");
}

Location to_location(py::handle where) {
  const auto [file, line, column] = where.cast<std::tuple<std::string, int, int>>();
  return {file, line, column};
}

py::tuple from_location(const Location& where) { return py::make_tuple(where.file, where.line, where.column); }

std::vector<float> to_floats(const Floats& array) { return {array.data(), array.data() + array.size()}; }

py::object python_class(const char* module, const char* name) { return py::module_::import(module).attr(name); }

}  // namespace tyndall::python
