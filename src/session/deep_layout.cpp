#include "session/deep_layout.h"

#include <cstdio>

#include "tyndall/error.h"
#include "tyndall/settings.h"

namespace tyndall {

std::string DeepLayout::str() const {
  char text[96];
  std::snprintf(text, sizeof text, "%d from %.9g to %.9g by %.9g", bins.count(), static_cast<double>(bins.near()),
                static_cast<double>(bins.far()), static_cast<double>(unit));
  return text;
}

std::optional<DeepLayout> DeepLayout::parse(const std::string& text) {
  int count = 0, used = 0;
  float near = 0, far = 0, unit = 0;
  const int read = std::sscanf(text.c_str(), "%d from %f to %f by %f%n", &count, &near, &far, &unit, &used);
  if (read != 4 || static_cast<std::size_t>(used) != text.size() || count < 1 || count > kMostDeepBins) return std::nullopt;
  if (!(near >= 0 && near <= far && unit > 0)) return std::nullopt;
  return DeepLayout{DepthBins(near, far, count), unit};
}

std::optional<DeepLayout> deep_layout(const World::Parts& world, const RenderSettings& settings) {
  if (!settings.deep_bins) return std::nullopt;
  const int count = *settings.deep_bins;
  if (count < 1 || count > kMostDeepBins)
    throw Error(Failure::usage,
                "a deep image cannot have " + std::to_string(count) + " bins; give 1 to " + std::to_string(kMostDeepBins));
  return DeepLayout{DepthBins(world.built, count), world.unit};
}

}  // namespace tyndall
