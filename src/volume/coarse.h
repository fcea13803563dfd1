/// Media seen coarsely: coefficients around a point and optical depth along a ray, for choices, never for estimates.
///
/// Everything here is deterministic and cheap. Grids answer with means over blocks of 2^3 cells that are kept beside the bricks
/// in a byte each, a procedural cloud with its mean.
#pragma once

#include <optional>
#include <utility>

#include "math/small_vector.h"
#include "volume/tracking.h"
#include "volume/trilinear.h"

namespace tyndall {

struct MediumData;

/// Means over the colour channels, 1/world unit.
struct CoarseOptics {
  float sigma_t = 0, sigma_s = 0;
  friend CoarseOptics operator*(CoarseOptics o, float factor) { return {o.sigma_t * factor, o.sigma_s * factor}; }
  CoarseOptics& operator+=(const CoarseOptics& o) {
    sigma_t += o.sigma_t;
    sigma_s += o.sigma_s;
    return *this;
  }
};

/// Mean of the media in a block around points of a ray; exact where homogeneous. Above 0 wherever a grid's density is, but
/// for rounding at the faces of blocks. Keeps the media's addresses.
class CoarseRay {
 public:
  CoarseRay() = default;
  CoarseRay(MediaView media, const Ray& ray);
  CoarseOptics at(float t) const;

 private:
  /// A medium that is not homogeneous, and the ray in its local coordinates.
  struct Local {
    const MediumData* medium;
    Line line;
    CoarseOptics dense;  ///< at density 1
  };
  CoarseOptics homogeneous_;
  SmallVector<Local, 2> locals_;
};

/// Reads of a medium that tell its depth well enough for choices.
inline constexpr int kCoarseTaps = 4;
/// Integral of sigma_t over [t0, t1], t1 may be infinite. Exact for homogeneous media; of any other, means are read at no
/// more than `taps` points, evenly in the part of the ray inside it.
float coarse_optical_depth(MediaView media, const Ray& ray, float t0, float t1, int taps = kCoarseTaps);

/// The same from the ray's origin, where it is looked at closely, up to t1 and no further than a value of `most`.
float nearby_optical_depth(MediaView media, const Ray& ray, float t1, float most);

/// The extinction of the clearest channel, over the mean of all, at least: 1 in grey media, 0 where grids have channels of
/// their own.
float clearest_channel(MediaView media);

/// The part of [t0, t1] where the media can be anything but empty, rounded outward: the hull over the media.
std::optional<std::pair<float, float>> coarse_extent(MediaView media, const Ray& ray, float t0, float t1);

}  // namespace tyndall
