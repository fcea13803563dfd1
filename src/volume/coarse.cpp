#include "volume/coarse.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "volume/grid_ray.h"
#include "volume/medium_data.h"

namespace tyndall {
namespace {

CoarseOptics means_of(const MediumOptics& optics, float density) {
  const float s = mean(optics.sigma_s);
  return {(mean(optics.sigma_a) + s) * density, s * density};
}

/// A cloud's density is expensive: its mean over the whole stands in for it.
float cloud_level(const MediumData& medium) { return std::max(medium.cloud_mean, 1e-4f); }

/// Of a medium that is not homogeneous, at a local point inside its clip box.
CoarseOptics optics_around(const MediumData& medium, const GridVec& p) {
  if (medium.kind == MediumData::Kind::cloud) return means_of(medium.optics, cloud_level(medium));
  float values[kMaxChannels];
  medium.density.grid.block_mean(p, values);
  if (medium.density.grid.channels() == 1) return means_of(medium.optics, values[0]);
  Rgb sigma_a, sigma_s;
  medium.scale_by(values, sigma_a, sigma_s);
  const float s = mean(sigma_s);
  return {mean(sigma_a) + s, s};
}

/// At a place on a ray inside the clip box, but for rounding.
double sigma_t_at(const MediumData& medium, const GridRay& ray, double t) {
  GridVec p = ray.at(t);
  for (int axis = 0; axis < 3; ++axis) p[axis] = std::clamp(p[axis], medium.clip.lo[axis], medium.clip.hi[axis]);
  return double{optics_around(medium, p).sigma_t};
}

double depth_of(const MediumData& medium, const Ray& ray, double t0, double t1, int taps) {
  if (medium.kind == MediumData::Kind::homogeneous) {
    const float sigma_t = means_of(medium.optics, 1).sigma_t;
    return sigma_t > 0 ? sigma_t * (t1 - t0) : 0;
  }
  const GridRay local(medium.density.to_local, ray);
  const auto [begin, end] = local.clip(medium.clip, t0, t1);
  if (!(begin < end) || taps < 1) return 0;
  if (medium.kind == MediumData::Kind::cloud)
    return double{means_of(medium.optics, cloud_level(medium)).sigma_t} * (end - begin);

  // Denser points would read the same blocks again. Points farther apart than blocks are wide read blocks all the same:
  // the mean of a larger node that the ray only grazes is worse than a gap.
  const double cells = (end - begin) * local.speed();
  const int count = static_cast<int>(std::clamp(std::ceil(cells / BlockMeans::kCells), 1.0, double(taps)));
  const double step = (end - begin) / count;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    sum += sigma_t_at(medium, local, begin + (i + 0.5) * step);
  }
  return sum * step;
}

/// Steps from one block, growing by kGrowth.
double nearby_depth_of(const MediumData& medium, const Ray& ray, double t1, double most) {
  constexpr double kGrowth = 1.25;
  if (medium.kind != MediumData::Kind::grid) return depth_of(medium, ray, 0, t1, 1);
  const GridRay local(medium.density.to_local, ray);
  const auto [begin, end] = local.clip(medium.clip, 0, t1);
  double sum = 0, step = BlockMeans::kCells / std::max(local.speed(), 1e-300);
  for (double t = begin; t < end && sum < most; t += step, step *= kGrowth) {
    const double length = std::min(step, end - t);
    sum += sigma_t_at(medium, local, t + 0.5 * length) * length;
  }
  return sum;
}

}  // namespace

CoarseRay::CoarseRay(MediaView media, const Ray& ray) {
  for (const ParticipatingMedium* medium : media) {
    const MediumData& m = medium->data();
    if (m.kind == MediumData::Kind::homogeneous) {
      homogeneous_ += means_of(m.optics, 1);
    } else {
      locals_.push_back({&m, m.density.to_local.point(ray.o), m.density.to_local.vector(ray.d)});
    }
  }
}

CoarseOptics CoarseRay::at(float t) const {
  CoarseOptics sum = homogeneous_;
  for (const auto& [medium, o, d] : locals_) {
    const GridVec p{{o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]}};
    if (medium->clip.contains(p)) sum += optics_around(*medium, p);
  }
  return sum;
}

float coarse_optical_depth(MediaView media, const Ray& ray, float t0, float t1, int taps) {
  double sum = 0;
  if (t0 < t1)
    for (const ParticipatingMedium* medium : media) sum += depth_of(medium->data(), ray, t0, t1, taps);
  return static_cast<float>(sum);
}

float nearby_optical_depth(MediaView media, const Ray& ray, float t1, float most) {
  double sum = 0;
  for (const ParticipatingMedium* medium : media) sum += nearby_depth_of(medium->data(), ray, t1, most);
  return static_cast<float>(sum);
}

float clearest_channel(MediaView media) {
  float part = 1;
  for (const ParticipatingMedium* medium : media) {
    const MediumData& m = medium->data();
    if (m.kind == MediumData::Kind::grid && m.density.grid.channels() != 1) return 0;
    const Rgb sigma_t = m.optics.sigma_a + m.optics.sigma_s;
    if (!is_black(sigma_t)) part = std::min(part, std::min({sigma_t.r, sigma_t.g, sigma_t.b}) / mean(sigma_t));
  }
  return part;
}

std::optional<std::pair<float, float>> coarse_extent(MediaView media, const Ray& ray, float t0, float t1) {
  if (!(t0 < t1)) return std::nullopt;
  double lo = kInfinity, hi = -kInfinity;
  for (const ParticipatingMedium* medium : media) {
    const MediumData& m = medium->data();
    const auto [begin, end] = m.kind == MediumData::Kind::homogeneous ? std::pair{double{t0}, double{t1}}
                                                                      : GridRay(m.density.to_local, ray).clip(m.clip, t0, t1);
    lo = std::min(lo, begin);
    hi = std::max(hi, end);
  }
  if (!(lo < hi)) return std::nullopt;
  const auto first = static_cast<float>(lo), last = static_cast<float>(hi);
  return std::pair{std::max(t0, first > lo ? std::nextafter(first, -kInfinity) : first),
                   std::min(t1, last < hi ? std::nextafter(last, kInfinity) : last)};
}

}  // namespace tyndall
