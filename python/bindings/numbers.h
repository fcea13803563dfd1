/// Numbers of options, within the bounds that the command line has. What is no number is a TypeError, what is out of its bounds
/// a ValueError; both name the option.
#pragma once

#include "convert.h"

namespace tyndall::python {

inline constexpr double kMostStops = 64;  ///< of exposure

/// A whole number from `least` to `most`.
int whole(const char* name, py::handle value, int least, int most);
/// Of random numbers.
std::uint64_t seed(const char* name, py::handle value);
/// A number above 0.
double positive(const char* name, py::handle value);
/// A number from `least` to `most`.
double between(const char* name, py::handle value, double least, double most);

/// What `read` makes of a value; None is none.
template <typename Read>
auto unless_none(py::handle value, Read read) -> std::optional<decltype(read(value))> {
  if (value.is_none()) return std::nullopt;
  return read(value);
}

}  // namespace tyndall::python
