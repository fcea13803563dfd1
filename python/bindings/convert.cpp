#include "convert.h"

#include <algorithm>

#include "tyndall/utf8.h"

namespace tyndall::python {

std::string to_name(py::handle value, const char* what) {
  const std::string shown = std::string(what) + " = " + py::repr(value).cast<std::string>();
  PyObject* encoded = nullptr;
  if (PyUnicode_FSConverter(value.ptr(), &encoded) == 0) {
    const bool is_none = PyErr_ExceptionMatches(PyExc_TypeError) != 0;
    PyErr_Clear();
    if (is_none) throw py::type_error(shown + " is not understood; give a name");
    throw py::value_error(shown + " is no name; leave NUL, and characters that the system's encoding lacks, out");
  }
  return py::reinterpret_steal<py::bytes>(encoded);
}

py::str from_name(std::string_view name) {
  const auto decoded =
      py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefaultAndSize(name.data(), static_cast<py::ssize_t>(name.size())));
  if (!decoded) throw py::error_already_set();
  return decoded;
}

py::str from_text(std::string_view text) { return py::str(valid_utf8(text)); }

py::list from_names(const std::vector<std::string>& names) {
  py::list list;
  for (const std::string& name : names) list.append(from_name(name));
  return list;
}

Vec3 to_vec3(py::handle triple) {
  const auto [x, y, z] = as<std::array<float, 3>>(triple, "a triple");
  return {x, y, z};
}

Rgb to_rgb(py::handle triple) {
  const auto [r, g, b] = as<std::array<float, 3>>(triple, "a triple");
  return {r, g, b};
}

py::tuple from_vec3(Vec3 v) { return py::make_tuple(v.x, v.y, v.z); }
py::tuple from_rgb(Rgb c) { return py::make_tuple(c.r, c.g, c.b); }

Transform to_transform(py::handle matrix) { return Transform(matrix.attr("tolist")().cast<Transform::Matrix>()); }

py::object from_transform(const Transform& transform) {
  return py::module_::import("numpy").attr("array")(transform.matrix(), "dtype"_a = "float64");
}

Location to_location(py::handle where) {
  const auto [file, line, column] = as<std::tuple<py::object, int, int>>(where, "where");
  return {to_name(file, "the file of where"), line, column};
}

py::tuple from_location(const Location& where) { return py::make_tuple(from_name(where.file), where.line, where.column); }

std::vector<float> to_floats(const Floats& array) { return {array.data(), array.data() + array.size()}; }

py::object python_class(const char* module, const char* name) { return py::module_::import(module).attr(name); }

}  // namespace tyndall::python
