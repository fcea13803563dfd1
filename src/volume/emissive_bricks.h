/// Volume emission of a medium, brick by brick: what each brick emits, points drawn in proportion to that, and the density of
/// the points of a brick along a ray.
#pragma once

#include <cstdint>
#include <memory>

#include "math/small_vector.h"
#include "tyndall/math.h"
#include "volume/medium.h"

namespace tyndall {

/// One brick along a ray from x: integrals of its density p_V over the ray. A point drawn in the brick lies in direction
/// w from x with the density int p_V(x + t w) t^2 dt.
struct BrickOnRay {
  std::uint32_t brick;
  double column;     ///< int p_V dt, 1/area; times the intensity: what the brick emits along the ray, roughly
  double direction;  ///< int p_V t^2 dt, 1/sr
};
using BricksOnRay = SmallVector<BrickOnRay, 16>;

struct EmissiveBrickData;  // emissive_data.h

/// Cubes of 8^3 cells of the medium's grid, or of more where these would be too many, that emit something. In each,
/// points are drawn by 4^3 blocks in proportion to their emission, a tenth of them anywhere. Immutable.
class EmissiveBricks {
 public:
  static constexpr std::size_t kMost = 100'000;

  /// None in a medium that does not emit, or has no grid: where it emits is then not known.
  explicit EmissiveBricks(const ParticipatingMedium& medium, std::size_t most = kMost);
  EmissiveBricks(EmissiveBricks&&) noexcept;
  EmissiveBricks& operator=(EmissiveBricks&&) noexcept;
  ~EmissiveBricks();

  std::size_t size() const;
  bool empty() const { return size() == 0; }
  Bounds3 box(std::uint32_t brick) const;      ///< world space
  float intensity(std::uint32_t brick) const;  ///< int sigma_a Le dV, mean of channels
  std::size_t memory_bytes() const;

  /// A point of the brick, world space.
  Vec3 sample(std::uint32_t brick, Vec3 u) const;
  /// Density of sample() at `p`, 1/volume.
  double pdf(std::uint32_t brick, Vec3 p) const;
  /// Every brick that the ray passes, in order, with the exact integrals of pdf() along it.
  BricksOnRay along(const Ray& ray) const;

 private:
  std::unique_ptr<const EmissiveBrickData> data_;
};

}  // namespace tyndall
