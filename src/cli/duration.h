/// Times for people.
#pragma once

#include <string>

namespace tyndall::cli {

/// "7s", "2m05s", "3h10m".
std::string duration(double seconds);

}  // namespace tyndall::cli
