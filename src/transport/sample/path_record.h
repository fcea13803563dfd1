/// What one camera path found, split by where its light came from.
#pragma once

#include "tyndall/math.h"

namespace tyndall {

struct PathRecord {
  // Radiance, by the first bounce and the number of bounces; their sum is the pixel's sample.
  Rgb emission;                          ///< directly visible: emitters, environment, volume emission
  Rgb surface_direct, surface_indirect;  ///< first bounce at a surface; one bounce, or more
  Rgb volume_direct, volume_indirect;    ///< first bounce in a medium; one bounce, or more

  // The camera ray.
  float alpha = 1;           ///< 1 - transmittance where nothing is behind, on average over samples
  Rgb albedo;                ///< of the first surface or collision, attenuated by the media before it; or the sum of both
  bool hit_surface = false;  ///< a real surface is behind whatever media there are
  Vec3 p, n;                 ///< that surface's point and shading normal
  float z = 0;               ///< and its depth along the viewing axis
  bool hit_volume = false;   ///< the path's first bounce was in a medium
  float z_volume = 0;        ///< its depth along the viewing axis
  Rgb transmittance{1.0f};   ///< of the media up to the surface; only when the film asks for it

  bool is_finite() const {
    return tyndall::is_finite(radiance()) && tyndall::is_finite(albedo) && tyndall::is_finite(transmittance) &&
           tyndall::is_finite(p) && tyndall::is_finite(n) && std::isfinite(alpha + z + z_volume);
  }
  Rgb radiance() const { return emission + surface_direct + surface_indirect + volume_direct + volume_indirect; }
  /// Light of one bounce or more.
  Rgb& scattered(bool first_in_medium, int bounces) {
    if (first_in_medium) return bounces == 1 ? volume_direct : volume_indirect;
    return bounces == 1 ? surface_direct : surface_indirect;
  }
  void scale_radiance(float s) {
    for (Rgb* part : {&emission, &surface_direct, &surface_indirect, &volume_direct, &volume_indirect}) *part *= s;
  }
};

}  // namespace tyndall
