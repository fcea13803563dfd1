/// Values of options that are texts of a form of their own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tyndall::cli {

/// Throws Error (usage): `option` `value` is not understood; give `wanted`.
[[noreturn]] void refuse_value(const std::string& option, const std::string& value, const std::string& wanted);

/// Integers separated by `separator`, all of the text; else nothing.
std::vector<int> integers(const std::string& text, char separator);

std::string join(const std::vector<std::string_view>& names, const char* separator);

}  // namespace tyndall::cli
