/// The noise of a render taken away after it, with an estimate of what is left.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

struct DenoiseSettings {
  int threads = 0;          ///< 0: all cores; the bits are the same for any number
  bool components = false;  ///< the channels of the light split, when they are there, are replaced by their filtered selves too
};

struct DenoiseReport {
  double seconds = 0;
  /// AOVs that would have helped, each with what its absence costs: "Transmittance: edges of smoke are blurred".
  std::vector<std::string> missing;
  /// Estimated, before and after: mean of squared error / (mean^2 + 0.01) over pixels and channels.
  double noisy_relmse = 0, relmse = 0;
};

struct Denoised {
  Image image;
  DenoiseReport report;
};

/// AOVs that a render needs for the best result, as RenderSettings::aovs has them.
std::vector<std::string> denoise_aovs();
/// What a name stands for where AOVs are asked for: "Denoise" for all of denoise_aovs(), "Cryptomatte" for all mattes, any
/// other for itself.
std::vector<std::string> aovs_named(const std::string& name);
/// Bytes that denoise() takes beside the image, at most.
std::size_t denoise_memory(std::size_t pixels);

/// Feature-based regression of each component of light [Bitterli et al. 2016]; docs/denoising.md. `image` must hold Replicate.R
/// .G .B and SampleCount, or attribute tyndall/samples; better are all of denoise_aovs(). Any data window, any values.
///
/// In the result R G B are filtered, noisy.R .G .B as they were, and Mse.R .G .B the squared error that is expected of R G B,
/// bias included. Light groups are filtered too, to the same sum. Other channels stay. Attribute "tyndall/denoised" names what
/// was filtered. Throws Error (scene), naming `name`, for an image without replicates, of one sample a pixel, or that was
/// denoised before.
Denoised denoise(const Image& image, const DenoiseSettings& settings = {}, const std::string& name = "the image");

}  // namespace tyndall
