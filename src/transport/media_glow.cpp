#include "transport/media_glow.h"

#include <algorithm>
#include <cmath>

#include "math/cubes.h"
#include "transport/media/media_state.h"

namespace tyndall {
namespace {

/// A medium's box is cut into about as many cubes as this, of which the brightest are kept.
constexpr float kCubes = 512;
/// Lamps are taken together in about as many cubes as this.
constexpr float kLampCubes = 512;
constexpr std::size_t kMostLamps = 1 << 16;
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

/// What lamps of a place send out, and where on average they stand. Of very many lamps some stand for all.
std::vector<Lamp> gather_lamps(const Lights& lights, const FireLights& fire) {
  if (lights.near_box().empty()) return {};
  const Cubes cubes(lights.near_box(), kLampCubes);
  std::vector<Lamp> lamps(cubes.size());
  const std::size_t step = lights.size() / kMostLamps + 1;
  for (std::size_t i = 0; i < lights.size(); i += step) {
    const auto id = static_cast<LightId>(i);
    if (fire.holds(id)) continue;  // it glows by itself, whether it is sought or not
    const LightPlace place = lights.place(id);
    if (!place.center) continue;
    const auto power = static_cast<float>(lights.power(id) * static_cast<double>(step));
    if (!(power > 0) || !std::isfinite(power)) continue;
    Lamp& lamp = lamps[cubes.index(*place.center)];
    const float sum = lamp.power + power;
    lamp.center = lamp.center * (lamp.power / sum) + *place.center * (power / sum);
    lamp.power = sum;
  }
  std::erase_if(lamps, [](const Lamp& lamp) { return lamp.power == 0; });
  return lamps;
}

/// Of lamps at infinity, which stand among the first lights: their power by the disk that it falls on.
float gather_far(const Lights& lights, const FireLights& fire, const Bounds3& scene) {
  const double disk = 0.25 * double{kPi} * double{length_squared(scene.extent())};
  const std::size_t looks = std::min(lights.size(), kMostLamps);
  double sum = 0;
  for (LightId id = 0; id < looks; ++id) {
    if (fire.holds(id) || lights.place(id).center) continue;
    const double power = lights.power(id);
    if (std::isfinite(power) && disk > 0) sum += power / disk;
  }
  return static_cast<float>(sum);
}

/// Radiance through a point from all sides together.
float fluence(const std::vector<Lamp>& lamps, Vec3 p, float radius) {
  float sum = 0;
  for (const Lamp& lamp : lamps) sum += lamp.power / (4 * kPi * (length_squared(p - lamp.center) + radius * radius));
  return sum;
}

/// What a medium does in a box, on average of the channels.
struct Average {
  float sigma_t = 0, sigma_s = 0, emission = 0;

  static Average of(const ParticipatingMedium& medium, Vec3 corner, Vec3 size) {
    Average a;
    const auto along = [](int k) { return (static_cast<float>(k % kReads) + 0.5f) / kReads; };
    for (int i = 0; i < kReads * kReads * kReads; ++i) {
      const Vec3 at{along(i), along(i / kReads), along(i / (kReads * kReads))};
      const Vec3 p = corner + size * at;
      const auto [sigma_a, sigma_s] = medium.optics_at(p);
      a.sigma_t += mean(sigma_a + sigma_s) * kPerRead;
      a.sigma_s += mean(sigma_s) * kPerRead;
      if (medium.emissive()) a.emission += mean(sigma_a * medium.at(p).Le) * kPerRead;
    }
    return a;
  }

 private:
  static constexpr float kPerRead = 1.0f / (kReads * kReads * kReads);
};

/// Seen from outside; `light` is the fluence of lamps there.
float radiance_of(const Average& medium, float radius, float light) {
  if (!(medium.sigma_t > 0)) return 0;
  const float source = medium.sigma_s * light / (4 * kPi) + medium.emission;
  return source / medium.sigma_t * -std::expm1(-medium.sigma_t * 2 * radius);
}

}  // namespace

MediaGlow::MediaGlow(const std::vector<ParticipatingMedium>& media, const Surroundings& around) {
  const auto& [groups, unbounded, lights, fire, scene] = around;
  struct Filled {
    const ParticipatingMedium& medium;
    Bounds3 box;
  };
  std::vector<Filled> filled;
  for (std::size_t i = 0; i < media.size(); ++i) {
    if (media[i].homogeneous()) continue;
    const Bounds3 box = overlap(media[i].bounds(), reach_of(static_cast<MediumId>(i), groups, unbounded));
    if (!box.empty()) filled.push_back({media[i], box});
  }
  if (filled.empty()) return;

  const std::vector<Lamp> lamps = gather_lamps(lights, fire);
  lamps_ = lights.near_box();
  for (const Lamp& lamp : lamps) near_power_ += lamp.power;
  far_light_ = gather_far(lights, fire, scene);

  std::vector<Glow> glows;
  for (const auto& [medium, box] : filled) {
    const Cubes cubes(box, kCubes / static_cast<float>(filled.size()));
    for (std::size_t k = 0; k < cubes.size(); ++k) {
      Glow glow{.center = cubes.corner(k) + cubes.step() * 0.5f, .radius = 0.5f * length(cubes.step()), .radiance = 0};
      const float light = far_light_ + fluence(lamps, glow.center, glow.radius);
      glow.radiance = radiance_of(Average::of(medium, cubes.corner(k), cubes.step()), glow.radius, light);
      if (glow.radiance > 0 && std::isfinite(glow.radiance)) glows.push_back(glow);
    }
  }
  const auto size = [](const Glow& g) { return g.radiance * g.radius * g.radius; };
  std::stable_sort(glows.begin(), glows.end(), [&](const Glow& a, const Glow& b) { return size(a) > size(b); });
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
