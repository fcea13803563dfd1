#include "light/delta_lights.h"

#include "math/vec3d.h"

namespace tyndall {
namespace {

float radians(float degrees) { return degrees * (kPi / 180); }

/// I / d^2 from one point to another; nothing where that is not a finite number.
std::optional<DeltaArrival> arrival_from(Vec3 light, Vec3 p, Rgb I) {
  const Vec3d d = Vec3d(light) - Vec3d(p);
  const double d2 = dot(d, d);
  if (!(d2 > 0)) return std::nullopt;
  const auto scaled = [&](float channel) { return static_cast<float>(channel / d2); };
  const Rgb E{scaled(I.r), scaled(I.g), scaled(I.b)};
  if (!is_finite(E)) return std::nullopt;
  return DeltaArrival{to_vec3(d / std::sqrt(d2)), static_cast<float>(std::sqrt(d2)), E};
}

LightBounds at_point(Vec3 p, DirectionCone normals, float theta_e) {
  LightBounds bounds;
  bounds.box.expand(p);
  bounds.normals = normals;
  bounds.theta_e = theta_e;
  return bounds;
}

float smoothstep(float x, float a, float b) {
  if (a == b) return x < a ? 0.0f : 1.0f;
  const float t = std::clamp((x - a) / (b - a), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// The map keeps angles.
bool is_similarity(const Transform& t) {
  const Vec3 x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
  const float s = length(x), tolerance = 1e-5f;
  return std::abs(length(y) - s) <= tolerance * s && std::abs(length(z) - s) <= tolerance * s &&
         std::max({abs_dot(x, y), abs_dot(y, z), abs_dot(z, x)}) <= tolerance * s * s;
}

}  // namespace

std::optional<DeltaArrival> PointEmitter::arrival(Vec3 p) const { return arrival_from(position_, p, I_); }

LightBounds PointEmitter::bounds() const { return at_point(position_, DirectionCone::everything(), kPi / 2); }

SpotEmitter::SpotEmitter(const SpotLight& light)
    : position_(light.to_world.point({})),
      I_(light.I),
      start_(radians(std::clamp(std::min(light.falloff_start_degrees, light.cone_angle_degrees), 0.0f, 180.0f))),
      end_(radians(std::clamp(light.cone_angle_degrees, 0.0f, 180.0f))),
      cos_start_(std::cos(start_)),
      cos_end_(std::cos(end_)) {
  // Rows of the inverse, each divided by the same length so that floats hold them at any scale.
  const Transform::Matrix inverse = light.to_world.inverse().matrix();
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(inverse[i][j]));
  for (int i = 0; i < 3; ++i) to_light_[i] = to_vec3(Vec3d(inverse[i][0], inverse[i][1], inverse[i][2]) / largest);
  core_ = is_similarity(light.to_world) ? DirectionCone::around(normalize(light.to_world.vector({0, 0, 1})), start_)
                                        : DirectionCone::everything();
}

std::optional<DeltaArrival> SpotEmitter::arrival(Vec3 p) const {
  auto arrival = arrival_from(position_, p, I_);
  if (!arrival) return std::nullopt;
  const Vec3 w = -arrival->wi;
  const Vec3 local{dot(to_light_[0], w), dot(to_light_[1], w), dot(to_light_[2], w)};
  const float falloff = smoothstep(local.z / length(local), cos_end_, cos_start_);
  if (!(falloff > 0)) return std::nullopt;
  arrival->L *= falloff;
  return arrival;
}

// Smoothstep is symmetric: between the two cosines it averages to 1/2.
Rgb SpotEmitter::power() const { return I_ * (2 * kPi * ((1 - cos_start_) + (cos_start_ - cos_end_) / 2)); }

LightBounds SpotEmitter::bounds() const { return at_point(position_, core_, end_ - start_); }

}  // namespace tyndall
