#include "light/far_lights.h"

#include "math/vec3d.h"

namespace tyndall {
namespace {

constexpr double kSlack = 1e-6;  ///< in cosines, for float normals at the horizon
/// Light may be anywhere in its cone, so its mean direction alone decides only down to this share of the bound.
constexpr double kShareOfBound = 0.25;

}  // namespace

FarLights::FarLights(std::span<const FarLight> lights) {
  for (const FarLight& light : lights) {
    const auto begin = static_cast<std::uint32_t>(cones_.size());
    for (const FarCone& c : light.cones) {
      const double theta = std::min(static_cast<double>(c.directions.theta), 3.14159265358979323846);
      cones_.push_back({c.directions.axis, c.mean, std::cos(theta), std::sin(theta), c.fluence, c.fluence_partner});
    }
    lights_.push_back({light.light, begin, static_cast<std::uint32_t>(cones_.size())});
  }
}

/// Irradiance by the mean direction where the whole cone is seen; a part of the upper bound where it is not.
double FarLights::cone_importance(const Cone& cone, const PointQuery& query) {
  const double fluence = query.mis_partner ? cone.fluence_partner : cone.fluence;
  const Vec3d n(query.n);
  if (!(dot(n, n) > 0)) return fluence;

  const auto fold = [&](double c) { return query.transmissive ? std::abs(c) : c; };
  const double cos_i = std::clamp(fold(dot(n, Vec3d(cone.axis))), -1.0, 1.0);
  const double sin_i = std::sqrt((1 - cos_i) * (1 + cos_i));
  const double bound = cos_i >= cone.cos ? 1 : cos_i * cone.cos + sin_i * cone.sin;
  if (bound <= -kSlack) return 0;
  return fluence * std::max({fold(dot(n, Vec3d(cone.mean))), kShareOfBound * bound, kSlack});
}

double FarLights::light_importance(std::uint32_t index, const PointQuery& query) const {
  double sum = 0;
  for (std::uint32_t i = lights_[index].begin; i < lights_[index].end; ++i) sum += cone_importance(cones_[i], query);
  return sum;
}

double FarLights::importance(const PointQuery& query) const {
  double sum = 0;
  for (std::uint32_t i = 0; i < lights_.size(); ++i) sum += light_importance(i, query);
  return sum;
}

std::optional<FarLights::Choice> FarLights::select(const PointQuery& query, double u) const {
  const double total = importance(query);
  if (!(total > 0)) return std::nullopt;
  std::optional<Choice> choice;
  double remaining = u * total;
  for (std::uint32_t i = 0; i < lights_.size(); ++i) {
    const double own = light_importance(i, query);
    if (own > 0) choice = Choice{lights_[i].light, own / total};
    if (own > 0 && remaining < own) break;
    remaining -= own;
  }
  return choice;  // rounding leaves the end of the range to the last light that has importance
}

double FarLights::pmf(const PointQuery& query, std::uint32_t index) const {
  const double total = importance(query);
  return total > 0 ? light_importance(index, query) / total : 0;
}

}  // namespace tyndall
