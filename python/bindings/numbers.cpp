#include "numbers.h"

#include <cmath>
#include <limits>

namespace tyndall::python {
namespace {

std::string shown(py::handle value) { return py::repr(value).cast<std::string>(); }

[[noreturn]] void refuse(const char* name, const std::string& wanted, py::handle value) {
  throw py::value_error(std::string(name) + " must be " + wanted + ", not " + shown(value));
}

/// Compared in Python, whose whole numbers have any size.
py::int_ whole_within(const char* name, py::handle value, const py::int_& least, const py::int_& most) {
  const std::string wanted = "a whole number from " + shown(least) + " to " + shown(most);
  if (!PyIndex_Check(value.ptr()))
    throw py::type_error(std::string(name) + " = " + shown(value) + " is not understood; give " + wanted);
  const auto exact = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!exact) throw py::error_already_set();
  if (exact < least || exact > most) refuse(name, wanted, value);
  return exact;
}

double number(const char* name, py::handle value) {
  if (!value.is_none() && PyNumber_Check(value.ptr())) {
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred() == nullptr) return number;
    PyErr_Clear();
  }
  throw py::type_error(std::string(name) + " = " + shown(value) + " is not understood; give a number");
}

}  // namespace

int whole(const char* name, py::handle value, int least, int most) {
  return whole_within(name, value, py::int_(least), py::int_(most)).cast<int>();
}

std::uint64_t seed(const char* name, py::handle value) {
  return whole_within(name, value, py::int_(0), py::int_(std::numeric_limits<std::uint64_t>::max())).cast<std::uint64_t>();
}

double positive(const char* name, py::handle value) {
  const double given = number(name, value);
  if (!(given > 0 && std::isfinite(given))) refuse(name, "a number above 0", value);
  return given;
}

double between(const char* name, py::handle value, double least, double most) {
  const double given = number(name, value);
  if (!(given >= least && given <= most))
    refuse(name, "a number from " + shown(py::float_(least)) + " to " + shown(py::float_(most)), value);
  return given;
}

}  // namespace tyndall::python
