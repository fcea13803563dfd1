#include "light/light_space.h"

#include "math/vec3d.h"

namespace tyndall {
namespace {

bool is_similarity(const Transform& t) {
  const Vec3 x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
  const float s = length(x), tolerance = 1e-5f;
  return std::abs(length(y) - s) <= tolerance * s && std::abs(length(z) - s) <= tolerance * s &&
         std::max({abs_dot(x, y), abs_dot(y, z), abs_dot(z, x)}) <= tolerance * s * s;
}

}  // namespace

std::optional<DeltaArrival> arrival_from(Vec3 light, Vec3 p, Rgb I) {
  const Vec3d d = Vec3d(light) - Vec3d(p);
  const double d2 = dot(d, d);
  if (!(d2 > 0)) return std::nullopt;
  const auto scaled = [&](float channel) { return static_cast<float>(channel / d2); };
  const Rgb E{scaled(I.r), scaled(I.g), scaled(I.b)};
  if (!is_finite(E)) return std::nullopt;
  return DeltaArrival{to_vec3(d / std::sqrt(d2)), static_cast<float>(std::sqrt(d2)), E};
}

LightBounds bounds_at(Vec3 p, DirectionCone normals, float theta_e) {
  LightBounds bounds;
  bounds.box.expand(p);
  bounds.normals = normals;
  bounds.theta_e = theta_e;
  return bounds;
}

DirectionCone cone_in_world(const Transform& to_world, const DirectionCone& cone) {
  if (!is_similarity(to_world)) return DirectionCone::everything();
  return DirectionCone::around(normalize(to_world.vector(cone.axis)), cone.theta);
}

/// The rows are each divided by the same length so that floats hold them at any scale.
LightSpace::LightSpace(const Transform& to_world) {
  const Transform::Matrix inverse = to_world.inverse().matrix();
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) largest = std::max(largest, std::abs(inverse[i][j]));
  for (std::size_t i = 0; i < 3; ++i) rows_[i] = to_vec3(Vec3d(inverse[i][0], inverse[i][1], inverse[i][2]) / largest);
}

}  // namespace tyndall
