#include "cli/option_values.h"

#include <sstream>

#include "tyndall/error.h"

namespace tyndall::cli {

void refuse_value(const std::string& option, const std::string& value, const std::string& wanted) {
  throw Error(Failure::usage, option + " " + value + " is not understood; give " + wanted);
}

std::vector<int> integers(const std::string& text, char separator) {
  std::vector<int> values;
  if (text.empty() || text.back() == separator) return {};
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    std::size_t used = 0;
    try {
      values.push_back(std::stoi(part, &used));
    } catch (const std::exception&) {
      return {};
    }
    if (used != part.size()) return {};
  }
  return values;
}

std::string join(const std::vector<std::string_view>& names, const char* separator) {
  std::string text;
  for (const auto name : names) text += (text.empty() ? "" : separator) + std::string(name);
  return text;
}

}  // namespace tyndall::cli
