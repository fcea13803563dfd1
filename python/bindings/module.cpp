/// tyndall._core: what the Python package tyndall stands on. Nothing in it is for users; the package's own modules are.
#include "define.h"
#include "watch.h"

namespace tyndall::python {
namespace {

const char* name_of(Failure failure) {
  switch (failure) {
    case Failure::run_time:
      return "run_time";
    case Failure::usage:
      return "usage";
    case Failure::scene:
      return "scene";
    case Failure::output:
      return "output";
    case Failure::differs:
      return "differs";
    case Failure::incomplete:
      return "incomplete";
  }
  return "run_time";
}

/// As tyndall.Error, with the place that the message begins with. A value of a type that nothing else has named is a TypeError.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const Error& e) {
    const Location& where = e.where();
    const auto number = [](int n) { return n > 0 ? py::object(py::int_(n)) : py::object(py::none()); };
    const py::object file = where.file.empty() ? py::object(py::none()) : py::object(from_name(where.file));
    const py::object type = python_class("tyndall.errors", "Error");
    const py::object error = type(from_text(e.what()), "failure"_a = name_of(e.failure()), "file"_a = file,
                                  "line"_a = number(where.line), "column"_a = number(where.line > 0 ? where.column : 0));
    PyErr_SetObject(type.ptr(), error.ptr());
  } catch (const py::cast_error&) {
    PyErr_SetString(PyExc_TypeError, "a value of the wrong type was given; help() of what was called tells which it takes");
  }
}

}  // namespace
}  // namespace tyndall::python

PYBIND11_MODULE(_core, m) {
  pybind11::register_local_exception_translator(tyndall::python::translate);
  tyndall::python::define_scene(m);
  tyndall::python::define_render(m);
  tyndall::python::define_images(m);
  m.def("end_works", tyndall::python::end_works);
  pybind11::module_::import("atexit").attr("register")(m.attr("end_works"));
}
