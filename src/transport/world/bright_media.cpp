#include "transport/world/bright_media.h"

#include <algorithm>
#include <cmath>

#include "math/cubes.h"
#include "transport/media/media_state.h"
#include "transport/world/near_lights.h"

namespace tyndall {
namespace {

/// A medium's box is divided into about this many cubes, of which the brightest are kept.
constexpr float kCubes = 512;
/// Lights are clustered in about this many cubes.
constexpr float kLightCubes = 512;
constexpr std::size_t kMostLights = 1 << 16;
constexpr int kReads = 3;  ///< of a medium along a cube's edge

struct Cell {
  Vec3 center;
  float radius, radiance, emitted;

  float size() const { return radiance * radius * radius; }
};

/// Lights that are close together, as one.
struct Near {
  Vec3 center;
  float power = 0;
};

/// Power and mean position of the lights of each cube. Of very many lights a subset stands for all.
std::vector<Near> gather_near_lights(const Lights& lights, const VolumeLights& volume_lights) {
  if (lights.near_box().empty()) return {};
  const Cubes cubes(lights.near_box(), kLightCubes);
  std::vector<Near> near(cubes.size());
  for_each_near_light(lights, volume_lights, kMostLights, [&](LightId id, const LightPlace& place, std::size_t stands_for) {
    const auto power = static_cast<float>(lights.power(id) * static_cast<double>(stands_for));
    if (!(power > 0) || !std::isfinite(power)) return;
    Near& light = near[cubes.index(*place.center)];
    const float sum = light.power + power;
    light.center = light.center * (light.power / sum) + *place.center * (power / sum);
    light.power = sum;
  });
  std::erase_if(near, [](const Near& light) { return light.power == 0; });
  return near;
}

/// Of lights at infinity, which come first: their power by the disk that it falls on.
float gather_far(const Lights& lights, const VolumeLights& volume_lights, const Bounds3& scene) {
  const double disk = 0.25 * double{kPi} * double{length_squared(scene.extent())};
  const std::size_t looks = std::min(lights.size(), kMostLights);
  double sum = 0;
  for (LightId id = 0; id < looks; ++id) {
    if (volume_lights.holds(id) || lights.place(id).center) continue;
    const double power = lights.power(id);
    if (std::isfinite(power) && disk > 0) sum += power / disk;
  }
  return static_cast<float>(sum);
}

/// Fluence at a point.
float fluence(const std::vector<Near>& near, Vec3 p, float radius) {
  float sum = 0;
  for (const Near& light : near) sum += light.power / (4 * kPi * (length_squared(p - light.center) + radius * radius));
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

/// Of a `source` in every place, seen from outside.
float radiance_of(const Average& medium, float source, float radius) {
  return medium.sigma_t > 0 ? source / medium.sigma_t * -std::expm1(-medium.sigma_t * 2 * radius) : 0.0f;
}

}  // namespace

BrightMedia::BrightMedia(const std::vector<ParticipatingMedium>& media, const Surroundings& around) {
  const auto& [groups, unbounded, lights, volume_lights, scene] = around;
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

  const std::vector<Near> near = gather_near_lights(lights, volume_lights);
  float near_power = 0;
  for (const Near& light : near) near_power += light.power;
  near_fluence_ = NearFluence(lights.near_box(), near_power);
  far_light_ = gather_far(lights, volume_lights, scene);

  std::vector<Cell> cells;
  for (const auto& [medium, box] : filled) {
    const Cubes cubes(box, kCubes / static_cast<float>(filled.size()));
    for (std::size_t k = 0; k < cubes.size(); ++k) {
      Cell cell{
          .center = cubes.corner(k) + cubes.step() * 0.5f, .radius = 0.5f * length(cubes.step()), .radiance = 0, .emitted = 0};
      const float light = far_light_ + fluence(near, cell.center, cell.radius);
      const Average inside = Average::of(medium, cubes.corner(k), cubes.step());
      cell.emitted = radiance_of(inside, inside.emission, cell.radius);
      cell.radiance = cell.emitted + radiance_of(inside, inside.sigma_s * light / (4 * kPi), cell.radius);
      if (cell.radiance > 0 && std::isfinite(cell.radiance)) cells.push_back(cell);
    }
  }
  std::stable_sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.size() > b.size(); });
  size_ = std::min(cells.size(), kMostCells);
  float all = 0, emitted = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    const auto& [center, radius, radiance, of_emission] = cells[i];
    all += cells[i].size();
    emitted += of_emission * radius * radius;
    x_[i] = center.x, y_[i] = center.y, z_[i] = center.z;
    radius_[i] = radius;
    radiance_[i] = radiance;
  }
  if (emitted > 0 && std::isfinite(all)) emission_share_ = emitted / all;
}

float BrightMedia::in_scattered(Vec3 p) const { return far_light_ + near_fluence_.at(p); }

}  // namespace tyndall
