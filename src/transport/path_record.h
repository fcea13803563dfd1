/// What one camera path found, split by where its light came from.
#pragma once

#include "tyndall/math.h"

namespace tyndall {

struct PathRecord {
  // Radiance, by the first scattering event and the number of events; their sum is the pixel's sample.
  Rgb emission;                          ///< seen without any scattering: emitters, environment, fire
  Rgb surface_direct, surface_indirect;  ///< first event at a surface; one event, or more
  Rgb volume_direct, volume_indirect;    ///< first event in a medium; one event, or more

  // The camera ray.
  float alpha = 1;           ///< 1 - transmittance where nothing stands behind, on average over samples
  Rgb albedo;                ///< of the first surface or collision, dimmed by the media before it; or the sum of both
  bool hit_surface = false;  ///< a real surface stands behind whatever media there are
  Vec3 p, n;                 ///< that surface's point and shading normal
  float z = 0;               ///< and its depth along the viewing axis
  bool hit_volume = false;   ///< the path's first event was in a medium
  float z_volume = 0;        ///< its depth
  Rgb transmittance{1.0f};   ///< of the media up to the surface; only when the film asks for it

  bool is_finite() const {
    return tyndall::is_finite(radiance()) && tyndall::is_finite(albedo) && tyndall::is_finite(transmittance) &&
           tyndall::is_finite(p) && tyndall::is_finite(n) && std::isfinite(alpha + z + z_volume);
  }
  Rgb radiance() const { return emission + surface_direct + surface_indirect + volume_direct + volume_indirect; }
  void scale_radiance(float s) {
    for (Rgb* part : {&emission, &surface_direct, &surface_indirect, &volume_direct, &volume_indirect}) *part *= s;
  }
};

}  // namespace tyndall
