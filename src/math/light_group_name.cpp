#include <algorithm>

#include "tyndall/image.h"
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

std::vector<std::string> light_groups_in(const Image& image) {
  const std::string begin = "LightGroup.", end = ".R";
  std::vector<std::string> groups;
  for (const Channel& c : image.channels) {
    if (!c.name.starts_with(begin) || !c.name.ends_with(end) || c.name.size() < begin.size() + end.size()) continue;
    const std::string group = c.name.substr(begin.size(), c.name.size() - begin.size() - end.size());
    const bool whole = image.find(light_group_channel(group) + "G") && image.find(light_group_channel(group) + "B");
    if (is_light_group_name(group) && whole) groups.push_back(group);
  }
  return groups;
}

}  // namespace tyndall
