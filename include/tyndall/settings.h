/// How to render: every option of the command line and the Integrator line, with its default and bounds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

/// How one light is chosen for next-event estimation. ALGORITHMS: see README.
enum class LightStrategy { uniform, power, exhaustive, tree_binary };
/// Estimator of transmittance along shadow rays.
enum class TransmittanceStrategy { residual, ratio, delta };

struct RenderSettings {
  int spp = 64;                  ///< samples a pixel, >= 1
  std::optional<double> time{};  ///< seconds; stops at the first pass end after it, if spp have not been reached before
  /// relMSE (mean of variance / (mean^2 + 0.01), from the render's own replicates) to stop below; looked at when the
  /// samples are 64, 128, 256 ...
  std::optional<double> error{};
  int max_depth = 5;             ///< scattering events a path, counted as pbrt's volpath; >= 0
  std::uint64_t seed = 0;
  int threads = 0;               ///< 0: all cores
  LightStrategy lights = LightStrategy::tree_binary;  ///< one that the World was built with
  TransmittanceStrategy transmittance = TransmittanceStrategy::residual;
  std::vector<std::string> aovs{};  ///< names from aov_names()
  std::optional<PixelBounds> crop{};
  bool reproducible = false;     ///< leave times and dates out of the image header
};

/// Names as on the command line ("tree-binary"); empty optional for an unknown one.
std::optional<LightStrategy> parse_light_strategy(std::string_view name);
std::optional<TransmittanceStrategy> parse_transmittance_strategy(std::string_view name);
std::string_view name_of(LightStrategy strategy);
std::string_view name_of(TransmittanceStrategy strategy);
std::vector<std::string_view> light_strategy_names();
std::vector<std::string_view> transmittance_strategy_names();
/// Every AOV that `aovs` accepts: "Albedo", "N", ...
std::vector<std::string_view> aov_names();

}  // namespace tyndall
