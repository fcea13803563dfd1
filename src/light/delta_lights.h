/// Lights without extent: no ray can hit them.
#pragma once

#include <optional>

#include "light/far_lights.h"
#include "light/light_space.h"
#include "tyndall/scene.h"

namespace tyndall {

class PointEmitter {
 public:
  explicit PointEmitter(const PointLight& light) : position_(light.position), I_(light.I) {}
  std::optional<DeltaArrival> arrival(Vec3 p) const;
  Rgb power() const { return I_ * (4 * kPi); }
  Rgb intensity() const { return I_; }
  Vec3 position() const { return position_; }
  LightBounds bounds() const;  ///< without intensity

 private:
  Vec3 position_;
  Rgb I_;
};

/// Falls off by pbrt's smoothstep of the cosine; under a transform that is not a similarity, by that in light space.
class SpotEmitter {
 public:
  explicit SpotEmitter(const SpotLight& light);
  std::optional<DeltaArrival> arrival(Vec3 p) const;
  Rgb power() const;  ///< of the undistorted cone
  Rgb intensity() const { return I_; }
  Vec3 position() const { return position_; }
  LightBounds bounds() const;  ///< without intensity
  /// All directions that it emits into, everything when the transform distorts it.
  DirectionCone beam() const { return core_.full() ? core_ : DirectionCone::around(core_.axis, end_); }

 private:
  Vec3 position_;
  LightSpace space_;
  Rgb I_;
  float start_, end_;  ///< half angles where the falloff begins and ends, radians
  float cos_start_, cos_end_;
  DirectionCone core_;  ///< where its intensity is full; everything when the transform distorts it
};

class DistantEmitter {
 public:
  explicit DistantEmitter(const DistantLight& light) : wi_(normalize(-light.direction)), E_(light.E) {}
  DeltaArrival arrival() const { return {wi_, kInfinity, E_}; }
  Rgb irradiance() const { return E_; }
  FarCone cone() const;

 private:
  Vec3 wi_;  ///< toward the light
  Rgb E_;
};

}  // namespace tyndall
