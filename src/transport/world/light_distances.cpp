#include "transport/world/light_distances.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "transport/world/near_lights.h"

namespace tyndall {
namespace {

/// The box is divided into about this many cubes.
constexpr float kCubes = 1 << 15;
constexpr std::size_t kMostLights = 1 << 20;

/// Each cube's nearest light, propagated from cube to cube in two sweeps: occasionally the second nearest.
class Nearest {
 public:
  Nearest(const Cubes& cubes, const std::vector<LightDistances::Near>& near)
      : cubes_(cubes), near_(near), best_(cubes.size(), kNone), distances_(cubes.size(), kInfinity) {
    for (std::size_t i = 0; i < near.size(); ++i) offer_around(cubes.index(near[i].center), static_cast<std::uint32_t>(i));
    for (std::size_t i = 0; i < best_.size(); ++i) take_from(i, 1);
    for (std::size_t i = best_.size(); i-- > 0;) take_from(i, -1);
  }

  /// From each cube's center, 0 within a light.
  std::span<const float> distances() const { return distances_; }

 private:
  static constexpr std::uint32_t kNone = 0xffff'ffff;

  float distance(std::size_t cube, std::uint32_t light) const {
    const Vec3 center = cubes_.corner(cube) + cubes_.step() * 0.5f;
    return std::max(length(center - near_[light].center) - near_[light].radius, 0.0f);
  }

  void offer(std::size_t cube, std::uint32_t light) {
    if (light == kNone || light == best_[cube]) return;
    const float to_light = distance(cube, light);
    if (!(to_light < distances_[cube])) return;
    best_[cube] = light;
    distances_[cube] = to_light;
  }

  /// To the cube and the 26 around it: lights outside of the box, which have no cube of their own, would hide each other.
  void offer_around(std::size_t cube, std::uint32_t light) {
    for (int k = 0; k < 27; ++k) {
      if (const auto to = neighbor(cube, k, 1)) offer(*to, light);
    }
  }
  /// From the 13 of the 26 around it that come before it in that order, 1 or -1.
  void take_from(std::size_t cube, int order) {
    for (int k = 0; k < 13; ++k) {
      if (const auto from = neighbor(cube, k, order)) offer(cube, best_[*from]);
    }
  }

  /// The k-th of the 27 around, in that order of cubes; nothing beyond the box.
  std::optional<std::size_t> neighbor(std::size_t cube, int k, int order) const {
    const auto nx = static_cast<int>(cubes_.count(0)), ny = static_cast<int>(cubes_.count(1)),
               nz = static_cast<int>(cubes_.count(2));
    const auto at = static_cast<int>(cube);
    const int x = at % nx + order * (k % 3 - 1), y = at / nx % ny + order * (k / 3 % 3 - 1),
              z = at / (nx * ny) + order * (k / 9 - 1);
    if (x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz) return std::nullopt;
    return static_cast<std::size_t>((z * ny + y) * nx + x);
  }

  const Cubes& cubes_;
  const std::vector<LightDistances::Near>& near_;
  std::vector<std::uint32_t> best_;
  std::vector<float> distances_;
};

std::vector<LightDistances::Near> gather_near_lights(const Lights& lights, const VolumeLights& volume_lights) {
  std::vector<LightDistances::Near> near;
  for_each_near_light(lights, volume_lights, kMostLights, [&](LightId id, const LightPlace& place, std::size_t) {
    if (lights.power(id) > 0) near.push_back({*place.center, place.radius});
  });
  return near;
}

}  // namespace

LightDistances::LightDistances(const Bounds3& box, const std::vector<Near>& near) : box_(box), cubes_(Cubes(box, kCubes)) {
  const Nearest nearest(*cubes_, near);
  const float half = 0.5f * length(cubes_->step());
  for (const float from_center : nearest.distances()) distances_.push_back(std::max(from_center - half, 0.0f));
}

float LightDistances::distance(Vec3 p) const {
  return std::max(distances_[cubes_->index(p)] - distance_outside(box_, p), 0.0f);
}

LightDistances light_distances(const std::vector<ParticipatingMedium>& media, const std::vector<BoundaryGroup>& groups,
                               std::optional<MediumId> unbounded, const Lights& lights, const VolumeLights& volume_lights) {
  Bounds3 all;
  for (MediumId id = 0; id < media.size(); ++id) {
    const Bounds3 box = reach_of(id, groups, unbounded);
    if (box.empty() || !(length(box.extent()) < kInfinity)) continue;
    all.expand(box.min);
    all.expand(box.max);
  }
  return all.empty() || lights.near_box().empty() ? LightDistances()
                                                  : LightDistances(all, gather_near_lights(lights, volume_lights));
}

}  // namespace tyndall
