#include "light/profile_emitter.h"

#include <algorithm>

namespace tyndall {

ProfileEmitter::ProfileEmitter(const Transform& to_world, const Strength& strength, const IntensityProfile& profile)
    : position_(to_world.point({})),
      space_(to_world),
      I_(strength.I),
      normals_(cone_in_world(to_world, profile.lobe().normals)),
      beam_(cone_in_world(to_world, profile.lobe().beam)),
      profile_(&profile) {
  if (!strength.power) return;
  const float flux = luminance(profile.flux());
  I_ *= flux > 0 ? *strength.power / flux : 0;
}

std::optional<DeltaArrival> ProfileEmitter::arrival(Vec3 p) const {
  auto arrival = arrival_from(position_, p, I_);
  if (!arrival) return std::nullopt;
  arrival->L *= profile_->at(normalize(space_.local(-arrival->wi)));
  return arrival;
}

LightBounds ProfileEmitter::bounds() const {
  const ProfileLobe& lobe = profile_->lobe();
  const bool even = normals_.full();
  LightBounds bounds = bounds_at(position_, normals_, even ? kPi / 2 : lobe.theta_e);
  const double intensity = strength(power()) / (even ? 4.0 * kPi : lobe.measure);
  bounds.intensity = static_cast<float>(std::clamp(intensity, 1e-37, 1e38));
  return bounds;
}

}  // namespace tyndall
