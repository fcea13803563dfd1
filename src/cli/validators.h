/// Ranges of numbers on the command line, refused in words: what the option must be, and what was given instead. Each
/// takes the whole text; none takes NaN or infinity. For CLI11's check().
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <limits>

namespace tyndall::cli {

CLI::Validator positive();                                     ///< a number above 0
CLI::Validator non_negative();                                 ///< a number of 0 or more
CLI::Validator fraction();                                     ///< a number from 0 to 1
CLI::Validator open_fraction();                                ///< a number above 0 and below 1: a probability
CLI::Validator number_between(double lowest, double highest);  ///< both included
/// A whole number in decimal digits, ends included; 64 unsigned bits unless told otherwise, as for a seed.
CLI::Validator whole_number(std::uint64_t lowest = 0, std::uint64_t highest = std::numeric_limits<std::uint64_t>::max());

}  // namespace tyndall::cli
