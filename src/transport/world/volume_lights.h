/// The media of a world that emit, as lights.
///
/// Each cell of a medium that emits (volume/emissive_cells.h) is a light among the others of the tree, chosen by what of its
/// emission leaves the medium. What makes it one like any other is a unit: next-event estimation draws a point y of it with
/// density p_V(y) per volume, at distance t, while rays that are scattered toward it gather all emission along their line,
/// about L_c = EmissiveCells::radiance. A cell of intensity I is therefore taken for a disk of area I / L_c that faces whatever
/// it illuminates: density t^2 L_c / I per solid angle, radiance sigma_a Le L_c / (I p_V). Their quotient is exact, sigma_a Le
/// / (p_V t^2); the density alone is the proxy that MIS compares with that of scattered rays, point by point, so that what is
/// close is left to them. What does not leave counts in I: the more of it there is, the more the points of a cell differ in
/// what arrives from them, and the better it is to leave it to rays (docs/measurements.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "light/lights.h"
#include "surface/geometry.h"
#include "volume/emissive_cells.h"

namespace tyndall {

class VolumeLights {
 public:
  VolumeLights() = default;
  /// Of the media that fill some space: the inside of a group, or `unbounded`. Keeps the media's addresses.
  VolumeLights(const std::vector<ParticipatingMedium>& media, const Geometry& geometry, std::optional<MediumId> unbounded);

  bool empty() const { return emissive_.empty(); }
  std::vector<VolumeEmitter> emitters() const;       ///< in the order of their ids; cells beyond their groups have no power
  void set_first(LightId first) { first_ = first; }  ///< what the first of emitters() became

  bool holds(LightId light) const { return light - first_ < count_; }
  /// The medium whose emission the light is.
  const ParticipatingMedium& medium(LightId light) const { return *medium_of(light).medium; }
  /// A point of the light, as seen from `p`: the medium counts as being there once.
  std::optional<LightSample> sample(LightId light, Vec3 p, Vec2 u) const;

  /// A light that holds some point.
  struct Held {
    LightId light;
    float pdf;  ///< 1/sr, that sample() at `from` gives for the point
  };
  /// The one of `medium` that holds `y`. Nothing: none was found to emit there.
  std::optional<Held> at(const ParticipatingMedium& medium, Vec3 y, Vec3 from) const;

  std::size_t memory_bytes() const;
  /// One row for each medium that emits.
  std::vector<std::string> notes(const std::vector<Medium>& media) const;

 private:
  struct EmissiveMedium {
    const ParticipatingMedium* medium;
    std::size_t id;
    LightId begin;  ///< of its lights, from first_ on
    EmissiveCells cells;
    Bounds3 reach;  ///< of the groups that bring the medium

    float area(std::uint32_t cell) const { return cells.intensity(cell) / cells.radiance(cell); }
  };
  const EmissiveMedium& medium_of(LightId light) const;

  std::vector<EmissiveMedium> emissive_;
  LightId first_ = 0, count_ = 0;
};

}  // namespace tyndall
