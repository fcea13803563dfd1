/// Volume emission of a medium, cell by cell: what each cell emits, points drawn in proportion to that, and the radiance of a
/// ray through it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "tyndall/math.h"
#include "volume/medium.h"

namespace tyndall {

struct EmissiveCellData;  // emissive_data.h

/// A part of a straight line: distances along it.
struct Chord {
  float t0, t1;
};

/// Where a medium is.
struct MediumReach {
  /// Holds all of it.
  Bounds3 box;
  /// The parts of a ray that are in the medium, apart and in order; what is beyond the box does not matter.
  std::function<std::vector<Chord>(const Ray&)> chords = [](const Ray&) { return std::vector<Chord>{{0, kInfinity}}; };
};

/// Cubes of 4^3 voxels of the medium's grid, or of more where these would be too many, that emit something; of a homogeneous
/// medium equal parts of the box that it lies in, smaller ones where it is thick. In each, points are drawn by a trilinear
/// density on a lattice of 5^3 points: a tenth of it is even, the rest is the emission there, in a homogeneous medium what of
/// it gets out. Immutable.
class EmissiveCells {
 public:
  static constexpr std::size_t kMost = 100'000;

  /// None in a medium that does not emit, nor in a homogeneous one whose box is infinite.
  EmissiveCells(const ParticipatingMedium& medium, const MediumReach& reach, std::size_t most = kMost);
  EmissiveCells(EmissiveCells&&) noexcept;
  EmissiveCells& operator=(EmissiveCells&&) noexcept;
  ~EmissiveCells();

  std::size_t size() const;
  bool empty() const { return size() == 0; }
  Bounds3 box(std::uint32_t cell) const;      ///< world space
  float intensity(std::uint32_t cell) const;  ///< int sigma_a Le dV, mean of channels
  /// What of the intensity leaves the medium, on average over both ways along each of the grid's axes.
  float power(std::uint32_t cell) const;
  /// What a ray through the cell gathers of the whole medium's emission, about: the mean over the grid's axes of what leaves
  /// the row of cells that it lies in, attenuated by these cells. Above 0; mean of channels.
  float radiance(std::uint32_t cell) const;
  std::size_t memory_bytes() const;

  /// The cell that holds `p`, if one that emits does.
  std::optional<std::uint32_t> at(Vec3 p) const;
  /// A point of the cell, world space.
  Vec3 sample(std::uint32_t cell, Vec3 u) const;
  /// Density of sample() at `p`, 1/volume; 0 outside of the cell.
  double pdf(std::uint32_t cell, Vec3 p) const;

 private:
  std::unique_ptr<const EmissiveCellData> data_;
};

}  // namespace tyndall
