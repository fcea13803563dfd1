/// Channels that belong together.
#pragma once

#include <string>

namespace tyndall {

/// "RGB" for "R", "Albedo" for "Albedo.R", "LightGroup.sky" for "LightGroup.sky.R", "Z" for "Z".
inline std::string group_of(const std::string& channel) {
  if (channel == "R" || channel == "G" || channel == "B") return "RGB";
  return channel.substr(0, channel.rfind('.'));
}

}  // namespace tyndall
