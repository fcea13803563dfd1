#include "light/delta_lights.h"

#include "math/smoothstep.h"

namespace tyndall {
namespace {

float radians(float degrees) { return degrees * (kPi / 180); }

/// A step where its ends are one.
float smoothstep_or_step(float a, float b, float x) {
  if (a == b) return x < a ? 0.0f : 1.0f;
  return smoothstep(a, b, x);
}

}  // namespace

std::optional<DeltaArrival> PointEmitter::arrival(Vec3 p) const { return arrival_from(position_, p, I_); }

LightBounds PointEmitter::bounds() const { return bounds_at(position_, DirectionCone::everything(), kPi / 2); }

SpotEmitter::SpotEmitter(const SpotLight& light)
    : position_(light.to_world.point({})),
      space_(light.to_world),
      I_(light.I),
      start_(radians(std::clamp(std::min(light.falloff_start_degrees, light.cone_angle_degrees), 0.0f, 180.0f))),
      end_(radians(std::clamp(light.cone_angle_degrees, 0.0f, 180.0f))),
      cos_start_(std::cos(start_)),
      cos_end_(std::cos(end_)) {
  core_ = cone_in_world(light.to_world, DirectionCone::around({0, 0, 1}, start_));
}

std::optional<DeltaArrival> SpotEmitter::arrival(Vec3 p) const {
  auto arrival = arrival_from(position_, p, I_);
  if (!arrival) return std::nullopt;
  const Vec3 local = space_.local(-arrival->wi);
  const float falloff = smoothstep_or_step(cos_end_, cos_start_, local.z / length(local));
  if (!(falloff > 0)) return std::nullopt;
  arrival->L *= falloff;
  return arrival;
}

// Smoothstep is symmetric: between the two cosines it averages to 1/2.
Rgb SpotEmitter::power() const { return I_ * (2 * kPi * ((1 - cos_start_) + (cos_start_ - cos_end_) / 2)); }

LightBounds SpotEmitter::bounds() const { return bounds_at(position_, core_, end_ - start_); }

FarCone DistantEmitter::cone() const {
  const auto E = static_cast<float>(strength(E_));
  return {DirectionCone::around(wi_), wi_, E, E};
}

}  // namespace tyndall
