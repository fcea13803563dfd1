/// How the sums of a deep image are laid out: what they need to be understood.
#pragma once

#include <optional>
#include <string>

#include "session/world_parts.h"
#include "transport/sample/depth_bins.h"

namespace tyndall {

/// Sums a key, of light, opacity, depth, and of how many samples the depth is.
inline constexpr std::size_t kSumsOfDepth = 6;

struct DeepLayout {
  DepthBins bins;
  float unit = 1;  ///< scene units of 1 in its depths

  /// "16 from 0.5 to 2 by 10": numbers that are read back as they are.
  std::string str() const;
  /// Nothing for what is no such text.
  static std::optional<DeepLayout> parse(const std::string& text);
};

/// That of a render; nothing where no deep image is asked for. Throws Error (usage) for numbers of bins that cannot be.
std::optional<DeepLayout> deep_layout(const World::Parts& world, const RenderSettings& settings);

}  // namespace tyndall
