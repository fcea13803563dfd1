/// A rendered image as the denoiser takes it: components of light in halves, and what explains each.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "denoise/features.h"
#include "denoise/light.h"
#include "tyndall/image.h"

namespace tyndall {

/// Which features explain a component. Media stand before surfaces too: what is behind them changes with them.
enum class Explained { by_all, by_media };

/// Of channels.
inline constexpr std::array kRgb{"R", "G", "B"};

struct Component {
  std::string prefix;  ///< of its channels: "VolumeDirect.", or "" for all light at once
  Explained explained;
  bool emitters = false;  ///< it is what the camera sees of them
};

/// AOVs with which nothing is missing.
std::vector<std::string> input_aovs();

/// The five of the light split when the image holds them all with their replicates, else all light at once. Throws Error
/// (scene), naming `name`, when there are no replicates.
std::vector<Component> components_of(const Image& image, const std::string& name);

/// Prefixes of the channels of light groups whose replicates are there too.
std::vector<std::string> groups_of(const Image& image);

ColorPlanes read_light(const Image& image);
Halves read_halves(const Image& image, const std::string& prefix);

/// Features by what they explain: those of surfaces, then those of media.
struct FeatureInputs {
  std::vector<Feature> surfaces, media;
  std::optional<std::size_t> transmittance;  ///< number of its first channel among those of media
  std::vector<std::string> missing;          ///< AOVs, with what their absence costs
};
FeatureInputs read_features(const Image& image);

}  // namespace tyndall
