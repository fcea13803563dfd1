/// A light at a point whose intensity depends on direction: goniometric and projection lights.
#pragma once

#include "light/intensity_profile.h"
#include "light/light_space.h"

namespace tyndall {

class ProfileEmitter {
 public:
  /// `I` is the intensity where the profile is 1; where `power` is given, it is instead what I = 1 emits. The profile must
  /// outlive the light.
  struct Strength {
    Rgb I;
    std::optional<float> power;
  };
  ProfileEmitter(const Transform& to_world, const Strength& strength, const IntensityProfile& profile);

  std::optional<DeltaArrival> arrival(Vec3 p) const;
  Rgb power() const { return I_ * profile_->flux(); }  ///< of the profile as it is, without what the transform distorts
  Vec3 position() const { return position_; }
  LightBounds bounds() const;
  DirectionCone beam() const { return beam_; }  ///< all directions that it emits into

 private:
  Vec3 position_;
  LightSpace space_;
  Rgb I_;
  DirectionCone normals_, beam_;
  const IntensityProfile* profile_;
};

}  // namespace tyndall
