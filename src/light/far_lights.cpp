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
      cones_.push_back({c.directions.axis, c.mean, std::cos(theta), std::sin(theta), c.sampled});
    }
    lights_.push_back({light.light, begin, static_cast<std::uint32_t>(cones_.size())});
  }
}

/// Irradiance by the mean direction where the whole cone is seen; a part of the upper bound where it is not.
double FarLights::cone_importance(const Cone& cone, const PointQuery& query) {
  const double fluence = cone.sampled;
  const Vec3d n(query.n);
  if (!(dot(n, n) > 0)) return fluence;

  const auto fold = [&](double c) { return query.transmissive ? std::abs(c) : c; };
  const double cos_i = std::clamp(fold(dot(n, Vec3d(cone.axis))), -1.0, 1.0);
  const double sin_i = std::sqrt((1 - cos_i) * (1 + cos_i));
  const double bound = cos_i >= cone.cos ? 1 : cos_i * cone.cos + sin_i * cone.sin;
  if (bound <= -kSlack) return 0;
  return fluence * std::max({fold(dot(n, Vec3d(cone.mean))), kShareOfBound * bound, kSlack});
}

/// A segment with what all cones ask of it.
struct FarLights::LitSegment {
  const Segment& segment;
  double lit_length = segment.lit_length();
};

/// The cone's spread blurs the phase function: of a convolution the mean cosine is the product of both.
double FarLights::cone_importance(const Cone& cone, const LitSegment& query) {
  const Segment& segment = query.segment;
  const double bundled = length(Vec3d(cone.mean));
  const double cosine = bundled > 0 ? dot(segment.d, Vec3d(cone.mean)) / bundled : 0;
  const bool weighted = segment.importance == MediaStrategy::product;
  const double phase = weighted ? phase_ratio(segment.g * std::min(bundled, 1.0), cosine) : 1;
  return cone.sampled * std::max(phase * query.lit_length, kLeastScattering * segment.length);
}

template <typename Query>
double FarLights::light_importance(std::uint32_t index, const Query& query) const {
  double all = 0;
  for (std::uint32_t i = lights_[index].begin; i < lights_[index].end; ++i) all += cone_importance(cones_[i], query);
  return all;
}

template <typename Query>
double FarLights::sum(const Query& query) const {
  double all = 0;
  for (std::uint32_t i = 0; i < lights_.size(); ++i) all += light_importance(i, query);
  return all;
}

template <typename Query>
std::optional<FarLights::Choice> FarLights::choose(const Query& query, double u) const {
  const double total = sum(query);
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

template <typename Query>
double FarLights::share(const Query& query, std::uint32_t index) const {
  const double total = sum(query);
  return total > 0 ? light_importance(index, query) / total : 0;
}

std::optional<FarLights::Choice> FarLights::select(const PointQuery& query, double u) const { return choose(query, u); }
double FarLights::pmf(const PointQuery& query, std::uint32_t index) const { return share(query, index); }
double FarLights::importance(const PointQuery& query) const { return sum(query); }

std::optional<FarLights::Choice> FarLights::select(const Segment& query, double u) const {
  return choose(LitSegment{query}, u);
}
double FarLights::pmf(const Segment& query, std::uint32_t index) const { return share(LitSegment{query}, index); }
double FarLights::importance(const Segment& query) const { return sum(LitSegment{query}); }

}  // namespace tyndall
