#include "transport/near_lamps.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace tyndall {
namespace {

/// The box is cut into about as many cubes as this.
constexpr float kCubes = 1 << 15;
constexpr std::size_t kMostLamps = 1 << 20;

/// Each cube's nearest lamp, by passing lamps on from cube to cube, forth and back: now and then the second nearest.
class Nearest {
 public:
  Nearest(const Cubes& cubes, const std::vector<NearLamps::Lamp>& lamps)
      : cubes_(cubes), lamps_(lamps), best_(cubes.size(), kNone), distances_(cubes.size(), kInfinity) {
    for (std::size_t i = 0; i < lamps.size(); ++i) offer_around(cubes.index(lamps[i].center), static_cast<std::uint32_t>(i));
    for (std::size_t i = 0; i < best_.size(); ++i) take_from(i, 1);
    for (std::size_t i = best_.size(); i-- > 0;) take_from(i, -1);
  }

  /// From each cube's center, 0 within a lamp.
  std::span<const float> distances() const { return distances_; }

 private:
  static constexpr std::uint32_t kNone = 0xffff'ffff;

  float distance(std::size_t cube, std::uint32_t lamp) const {
    const Vec3 center = cubes_.corner(cube) + cubes_.step() * 0.5f;
    return std::max(length(center - lamps_[lamp].center) - lamps_[lamp].radius, 0.0f);
  }

  void offer(std::size_t cube, std::uint32_t lamp) {
    if (lamp == kNone || lamp == best_[cube]) return;
    const float to_lamp = distance(cube, lamp);
    if (!(to_lamp < distances_[cube])) return;
    best_[cube] = lamp;
    distances_[cube] = to_lamp;
  }

  /// To the cube and the 26 around it: lamps outside of the box, which have no cube of their own, would hide each other.
  void offer_around(std::size_t cube, std::uint32_t lamp) {
    for (int k = 0; k < 27; ++k) {
      if (const auto to = neighbor(cube, k, 1)) offer(*to, lamp);
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
  const std::vector<NearLamps::Lamp>& lamps_;
  std::vector<std::uint32_t> best_;
  std::vector<float> distances_;
};

std::vector<NearLamps::Lamp> gather_lamps(const Lights& lights, const FireLights& fire) {
  std::vector<NearLamps::Lamp> lamps;
  const std::size_t step = lights.size() / kMostLamps + 1;
  for (std::size_t i = 0; i < lights.size(); i += step) {
    const auto id = static_cast<LightId>(i);
    if (fire.holds(id)) continue;
    const LightPlace place = lights.place(id);
    if (place.center && lights.power(id) > 0) lamps.push_back({*place.center, place.radius});
  }
  return lamps;
}

}  // namespace

NearLamps::NearLamps(const Bounds3& box, const std::vector<Lamp>& lamps) : box_(box), cubes_(Cubes(box, kCubes)) {
  const Nearest nearest(*cubes_, lamps);
  const float half = 0.5f * length(cubes_->step());
  for (const float from_center : nearest.distances()) distances_.push_back(std::max(from_center - half, 0.0f));
}

float NearLamps::distance(Vec3 p) const {
  const float outside = length(max(max(box_.min - p, p - box_.max), Vec3{0, 0, 0}));
  return std::max(distances_[cubes_->index(p)] - outside, 0.0f);
}

NearLamps near_lamps(const std::vector<ParticipatingMedium>& media, const std::vector<BoundaryGroup>& groups,
                     std::optional<MediumId> unbounded, const Lights& lights, const FireLights& fire) {
  Bounds3 all;
  for (MediumId id = 0; id < media.size(); ++id) {
    const Bounds3 box = reach_of(id, groups, unbounded);
    if (box.empty() || !(length(box.extent()) < kInfinity)) continue;
    all.expand(box.min);
    all.expand(box.max);
  }
  return all.empty() || lights.near_box().empty() ? NearLamps() : NearLamps(all, gather_lamps(lights, fire));
}

}  // namespace tyndall
