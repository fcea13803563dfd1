/// The inside of a ParticipatingMedium, for tracking.
#pragma once

#include <optional>

#include "tyndall/scene.h"
#include "volume/affine.h"
#include "volume/blackbody_table.h"
#include "volume/brick_grid.h"
#include "volume/cloud_noise.h"
#include "volume/medium.h"

namespace tyndall {

/// A grid and the map from the world to its local coordinates.
struct PlacedGrid {
  BrickGrid grid;
  Affine to_local;
  float at(Vec3 p) const { return grid.lookup(to_local.point(p)); }
  Rgb rgb_at(Vec3 p) const;
};

/// The radiance scale Le of a medium. Factors that are absent count as 1.
struct EmissionField {
  enum class Kind { none, constant, blackbody, rgb_grid } kind = Kind::none;
  Rgb Le;                                               ///< constant: the colour
  float factor = 1;                                     ///< multiplies everything
  std::optional<PlacedGrid> scale;                      ///< multiplies everything, point by point
  std::optional<PlacedGrid> values;                     ///< blackbody: temperatures; rgb_grid: Le
  float temperature_scale = 1, temperature_offset = 0;  ///< kelvin = (value - offset) * scale
  std::optional<BlackbodyTable> table;

  Rgb at(Vec3 p) const;
};

struct MediumData {
  enum class Kind { homogeneous, grid, cloud } kind = Kind::homogeneous;
  MediumOptics optics;      ///< at density 1; rgbgrid: sigma_a and sigma_s are 1 and the grid has six channels
  PlacedGrid density;       ///< grid: 1 channel, 3 (density per colour) or 6 (sigma_a then sigma_s)
  Box3d clip;               ///< local coordinates beyond which the medium ends: grid, cloud
  CloudMedium cloud;        ///< local coordinates are medium space
  float cloud_mean = 0.5f;  ///< of the density, roughly; any value is correct
  EmissionField emission;
  Bounds3 bounds;

  /// Coefficients for the grid's channels at one point.
  void scale_by(const float* density_values, Rgb& sigma_a, Rgb& sigma_s) const {
    const int channels = density.grid.channels();
    if (channels == 1) {
      sigma_a = optics.sigma_a * density_values[0];
      sigma_s = optics.sigma_s * density_values[0];
    } else {
      const float* d = density_values;
      const float* s = channels == 6 ? d + 3 : d;
      sigma_a = optics.sigma_a * Rgb{d[0], d[1], d[2]};
      sigma_s = optics.sigma_s * Rgb{s[0], s[1], s[2]};
    }
  }
};

/// As build_medium(), of which it is the work.
MediumData build_medium_data(const Medium& medium, const MediumBuildOptions& options, std::vector<std::string>& notes);

}  // namespace tyndall
