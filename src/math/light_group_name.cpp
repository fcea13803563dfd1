#include <algorithm>

#include "tyndall/lights.h"

namespace tyndall {

std::string light_group_channel(std::string_view name) { return "LightGroup." + std::string(name) + "."; }

bool is_light_group_name(std::string_view name) {
  constexpr std::size_t kLongest = 64;
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !name.empty() && name.size() <= kLongest && std::all_of(name.begin(), name.end(), allowed);
}

}  // namespace tyndall
