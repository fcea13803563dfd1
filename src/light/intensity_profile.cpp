#include "light/intensity_profile.h"

#include <algorithm>
#include <array>

#include "math/vec3d.h"

namespace tyndall {
namespace {

constexpr int kRings = 64;
/// Radians, for the rounding of directions here and in the light's own look-up.
constexpr float kAngleSlack = 1e-3f;
/// Importance does not fall below this share of what the cosine gives along the normals (light/emission_angle.h).
constexpr double kLeastCosine = 1e-3;
/// Of the mean direction: of profiles that are more even than that, directions tell little.
constexpr double kEven = 0.02;

/// The largest intensity in each of kRings rings around an axis, out to `reach`, where all light is.
struct Rings {
  std::array<float, kRings> most{};
  float reach = 0;
};

Rings rings_around(Vec3 axis, const std::function<void(const PartVisitor&)>& visit) {
  Rings rings;
  visit([&](const ProfilePart& part) {
    if (part.lit) rings.reach = std::max(rings.reach, static_cast<float>(angle_between(axis, part.w)) + part.reach);
  });
  visit([&](const ProfilePart& part) {
    const auto ring = static_cast<int>(angle_between(axis, part.w) / rings.reach * kRings);
    float& most = rings.most[static_cast<std::size_t>(std::clamp(ring, 0, kRings - 1))];
    if (part.lit) most = std::max(most, part.value);
  });
  return rings;
}

/// The narrowest cone beyond which intensity falls at least like the cosine of the angle to it.
float core_of(const Rings& rings) {
  const float peak = *std::max_element(rings.most.begin(), rings.most.end());
  double core = 0;
  for (std::size_t i = 0; i < kRings; ++i) {
    const double theta = (static_cast<double>(i) + 0.5) * rings.reach / kRings, share = rings.most[i] / peak;
    if (share > kLeastCosine) core = std::max(core, theta - std::acos(std::min(share, 1.0)));
  }
  return static_cast<float>(core);
}

ProfileLobe everywhere() { return {DirectionCone::everything(), kPi / 2, DirectionCone::everything(), 4.0 * kPi}; }

ProfileLobe lobe_of(const std::function<void(const PartVisitor&)>& visit) {
  Vec3d mean;
  double flux = 0;
  visit([&](const ProfilePart& part) {
    mean = mean + Vec3d(part.w) * (part.value * part.omega);
    flux += part.value * part.omega;
  });
  if (!(flux > 0) || !(length(mean) > kEven * flux)) return everywhere();
  const Vec3 axis = to_vec3(normalize(mean));
  const Rings rings = rings_around(axis, visit);
  const float reach = rings.reach + kAngleSlack, core = core_of(rings);
  if (core >= kPi) return everywhere();
  LightBounds bounds;
  bounds.normals = DirectionCone::around(axis, core);
  bounds.theta_e = std::min(reach, kPi) - core;
  return {bounds.normals, bounds.theta_e, DirectionCone::around(axis, std::min(reach, kPi)),
          std::max(orientation_measure(bounds), 1e-12)};
}

}  // namespace

IntensityProfile::IntensityProfile(Kind kind) : kind_(std::move(kind)) {
  std::visit(
      [this](const auto& profile) {
        flux_ = profile.flux();
        lobe_ = lobe_of([&](const PartVisitor& visitor) { profile.visit(visitor); });
      },
      kind_);
}

Rgb IntensityProfile::at(Vec3 w) const {
  return std::visit([w](const auto& profile) { return profile.at(w); }, kind_);
}

std::size_t IntensityProfile::memory_bytes() const {
  return sizeof(IntensityProfile) + std::visit([](const auto& profile) { return profile.memory_bytes(); }, kind_);
}

}  // namespace tyndall
