#include "render/media_glow.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// A medium's box is cut into about as many cubes as this, of which the brightest are kept.
constexpr float kCubes = 512;
constexpr int kMostCubes = 64;  ///< along an axis
/// Lamps are taken together in the cubes of a grid of this many along an axis.
constexpr int kLampCubes = 8;
constexpr int kReads = 3;  ///< of a medium along a cube's edge

struct Glow {
  Vec3 center;
  float radius, radiance;
};

/// Lamps that are close together, as one.
struct Lamp {
  Vec3 center;
  float power = 0;
};

Bounds3 overlap(const Bounds3& a, const Bounds3& b) { return {max(a.min, b.min), min(a.max, b.max)}; }

/// Cubes that tile a box.
class Cubes {
 public:
  Cubes(const Bounds3& box, float wanted) : box_(box) {
    const Vec3 e = box.extent();
    const float longest = std::max({e.x, e.y, e.z});
    // Flat boxes are cut as if they had some thickness.
    const float volume = std::max(e.x, 1e-3f * longest) * std::max(e.y, 1e-3f * longest) * std::max(e.z, 1e-3f * longest);
    const float edge = std::cbrt(volume / wanted);
    for (int i = 0; i < 3; ++i) counts_[static_cast<std::size_t>(i)] = edge > 0 ? std::clamp(static_cast<int>(e[i] / edge), 1, kMostCubes) : 1;
    step_ = {e.x / static_cast<float>(counts_[0]), e.y / static_cast<float>(counts_[1]), e.z / static_cast<float>(counts_[2])};
  }

  std::size_t size() const { return static_cast<std::size_t>(counts_[0]) * static_cast<std::size_t>(counts_[1]) * static_cast<std::size_t>(counts_[2]); }
  Vec3 step() const { return step_; }
  Vec3 corner(std::size_t index) const {
    const auto nx = static_cast<std::size_t>(counts_[0]), ny = static_cast<std::size_t>(counts_[1]);
    const Vec3 at{static_cast<float>(index % nx), static_cast<float>(index / nx % ny), static_cast<float>(index / (nx * ny))};
    return box_.min + at * step_;
  }
  /// Of the cube that holds `p`, or is next to it.
  std::size_t index(Vec3 p) const {
    const Vec3 from = p - box_.min;
    std::size_t index = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const int count = counts_[static_cast<std::size_t>(axis)];
      const float at = step_[axis] > 0 ? from[axis] / step_[axis] : 0.0f;
      const int cell = std::clamp(static_cast<int>(std::clamp(at, 0.0f, static_cast<float>(kMostCubes))), 0, count - 1);
      index = index * static_cast<std::size_t>(count) + static_cast<std::size_t>(cell);
    }
    return index;
  }

 private:
  Bounds3 box_;
  std::array<int, 3> counts_{};
  Vec3 step_;
};

/// What lamps of a place send out, and where on average they stand.
std::vector<Lamp> gather_lamps(const Lights& lights) {
  if (lights.near_box().empty()) return {};
  const Cubes cubes(lights.near_box(), kLampCubes * kLampCubes * kLampCubes);
  std::vector<Lamp> lamps(cubes.size());
  for (LightId id = 0; id < lights.size(); ++id) {
    const auto power = static_cast<float>(lights.power(id));
    const LightPlace place = lights.place(id);
    if (!place.center || !(power > 0) || !std::isfinite(power)) continue;
    Lamp& lamp = lamps[cubes.index(*place.center)];
    const float sum = lamp.power + power;
    lamp.center = lamp.center * (lamp.power / sum) + *place.center * (power / sum);
    lamp.power = sum;
  }
  std::erase_if(lamps, [](const Lamp& lamp) { return lamp.power == 0; });
  return lamps;
}

/// Radiance through a point from all sides together.
float fluence(const std::vector<Lamp>& lamps, Vec3 p, float radius) {
  float sum = 0;
  for (const Lamp& lamp : lamps) sum += lamp.power / (4 * kPi * (length_squared(p - lamp.center) + radius * radius));
  return sum;
}

/// Where a medium can be.
Bounds3 reach_of(std::size_t medium, const std::vector<BoundaryGroup>& groups, std::optional<MediumId> unbounded) {
  if (unbounded == medium) return {Vec3{-kInfinity, -kInfinity, -kInfinity}, Vec3{kInfinity, kInfinity, kInfinity}};
  Bounds3 reach;
  for (const BoundaryGroup& group : groups) {
    if (group.inside == medium) reach.expand(group.bounds);
  }
  return reach;
}

Glow glow_of(const ParticipatingMedium& medium, const Cubes& cubes, std::size_t index, float far_light, const std::vector<Lamp>& lamps) {
  const Vec3 corner = cubes.corner(index), step = cubes.step();
  float sigma_t = 0, sigma_s = 0, own = 0;
  for (int i = 0; i < kReads * kReads * kReads; ++i) {
    const auto along = [](int k) { return (static_cast<float>(k) + 0.5f) / kReads; };
    const Coefficients c = medium.at(corner + step * Vec3{along(i % kReads), along(i / kReads % kReads), along(i / (kReads * kReads))});
    sigma_t += mean(c.sigma_t());
    sigma_s += mean(c.sigma_s);
    own += mean(c.sigma_a * c.Le);
  }
  Glow glow{.center = corner + step * 0.5f, .radius = 0.5f * length(step), .radiance = 0};
  if (!(sigma_t > 0) || !std::isfinite(sigma_t) || !std::isfinite(own)) return glow;
  const float depth = sigma_t / (kReads * kReads * kReads) * 2 * glow.radius;
  const float scattered = sigma_s > 0 ? sigma_s * (fluence(lamps, glow.center, glow.radius) + far_light) / (4 * kPi) : 0.0f;
  glow.radiance = (scattered + own) / sigma_t * -std::expm1(-depth);
  return glow;
}

}  // namespace

MediaGlow::MediaGlow(const std::vector<ParticipatingMedium>& media, const std::vector<BoundaryGroup>& groups,
                     std::optional<MediumId> unbounded, const Lights& lights, const Bounds3& scene) {
  std::vector<std::size_t> filled;
  for (std::size_t i = 0; i < media.size(); ++i) {
    if (!media[i].homogeneous() && !overlap(media[i].bounds(), reach_of(i, groups, unbounded)).empty()) filled.push_back(i);
  }
  if (filled.empty()) return;

  const std::vector<Lamp> lamps = gather_lamps(lights);
  lamps_ = lights.near_box();
  for (const Lamp& lamp : lamps) near_power_ += lamp.power;
  const float disk = kPi * 0.25f * length_squared(scene.extent());
  for (LightId id = 0; id < lights.size(); ++id) {
    const double power = lights.power(id);
    if (!lights.place(id).center && std::isfinite(power) && disk > 0) far_light_ += static_cast<float>(power) / disk;
  }

  std::vector<Glow> glows;
  for (const std::size_t i : filled) {
    const Cubes cubes(overlap(media[i].bounds(), reach_of(i, groups, unbounded)), kCubes / static_cast<float>(filled.size()));
    for (std::size_t k = 0; k < cubes.size(); ++k) {
      const Glow glow = glow_of(media[i], cubes, k, far_light_, lamps);
      if (glow.radiance > 0 && std::isfinite(glow.radiance)) glows.push_back(glow);
    }
  }
  const auto brighter = [](const Glow& a, const Glow& b) { return a.radiance * a.radius * a.radius > b.radiance * b.radius * b.radius; };
  std::stable_sort(glows.begin(), glows.end(), brighter);
  size_ = std::min(glows.size(), kMostCells);
  for (std::size_t i = 0; i < size_; ++i) {
    const auto& [center, radius, radiance] = glows[i];
    x_[i] = center.x, y_[i] = center.y, z_[i] = center.z;
    radius_[i] = radius;
    radiance_[i] = radiance;
  }
}

float MediaGlow::lamplight(Vec3 p) const {
  if (near_power_ == 0) return far_light_;
  const float half = 0.5f * length(lamps_.extent());
  return far_light_ + near_power_ / (4 * kPi * std::max(length_squared(p - lamps_.center()), half * half));
}

}  // namespace tyndall
