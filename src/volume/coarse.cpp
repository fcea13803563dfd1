#include "volume/coarse.h"

#include <algorithm>
#include <cmath>

#include "volume/grid_ray.h"
#include "volume/medium_data.h"

namespace tyndall {
namespace {

CoarseOptics means_of(Rgb sigma_a, Rgb sigma_s) {
  const float s = mean(sigma_s);
  return {mean(sigma_a) + s, s};
}
/// At density 1.
CoarseOptics means_of(const MediumOptics& optics) { return means_of(optics.sigma_a, optics.sigma_s); }

/// A cloud's density is expensive: its mean over the whole stands in for it.
float cloud_level(const MediumData& medium) { return std::max(medium.cloud_mean, 1e-4f); }

/// Of a medium that is not homogeneous and `dense` at density 1, at a place of a line in local coordinates that its clip box
/// holds.
CoarseOptics optics_around(const MediumData& medium, const CoarseOptics& dense, const Line& line, double t) {
  if (medium.kind == MediumData::Kind::cloud) return dense * cloud_level(medium);
  const BrickGrid& grid = medium.density.grid;
  if (grid.channels() == 1) return dense * grid.block_mean(line, t);
  float values[kMaxChannels];
  Rgb sigma_a, sigma_s;
  grid.block_mean(line.at(t), values);
  medium.scale_by(values, sigma_a, sigma_s);
  return means_of(sigma_a, sigma_s);
}

double depth_of(const MediumData& medium, const Ray& ray, double t0, double t1, int taps) {
  if (medium.kind == MediumData::Kind::homogeneous) {
    const float sigma_t = means_of(medium.optics).sigma_t;
    return sigma_t > 0 ? sigma_t * (t1 - t0) : 0;
  }
  const GridRay local(medium.density.to_local, ray);
  const auto [begin, end] = local.clip(medium.clip, t0, t1);
  if (!(begin < end) || taps < 1) return 0;
  const CoarseOptics dense = means_of(medium.optics);
  if (medium.kind == MediumData::Kind::cloud) return double{dense.sigma_t} * cloud_level(medium) * (end - begin);

  // Denser points would read the same blocks again. Points farther apart than blocks are wide read blocks all the same:
  // the mean of a larger node that the ray only grazes is worse than a gap.
  const double cells = (end - begin) * local.speed();
  const int count = static_cast<int>(std::clamp(std::ceil(cells / BlockMeans::kCells), 1.0, double(taps)));
  const double step = (end - begin) / count;
  const Line line = local.line();
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += double{optics_around(medium, dense, line, begin + (i + 0.5) * step).sigma_t};
  return sum * step;
}

/// Steps grow as the ray goes on; the first is a block.
double nearby_depth_of(const MediumData& medium, const Ray& ray, double t1, double most) {
  constexpr double kGrowth = 1.25;
  if (medium.kind != MediumData::Kind::grid) return depth_of(medium, ray, 0, t1, 1);
  const GridRay local(medium.density.to_local, ray);
  const auto [begin, end] = local.clip(medium.clip, 0, t1);
  const CoarseOptics dense = means_of(medium.optics);
  const Line line = local.line();
  double sum = 0, step = BlockMeans::kCells / std::max(local.speed(), 1e-300);
  for (double t = begin; t < end && sum < most; t += step, step *= kGrowth) {
    const double length = std::min(step, end - t);
    sum += double{optics_around(medium, dense, line, t + 0.5 * length).sigma_t} * length;
  }
  return sum;
}

}  // namespace

CoarseRay::CoarseRay(MediaView media, const Ray& ray) {
  for (const ParticipatingMedium* medium : media) {
    const MediumData& m = medium->data();
    const CoarseOptics dense = means_of(m.optics);
    if (m.kind == MediumData::Kind::homogeneous) {
      homogeneous_ += dense;
    } else {
      locals_.push_back({&m, GridRay(m.density.to_local, ray).line(), dense});
    }
  }
}

CoarseOptics CoarseRay::at(float t) const {
  CoarseOptics sum = homogeneous_;
  for (const auto& [medium, line, dense] : locals_) {
    if (medium->clip.contains(line.at(t))) sum += optics_around(*medium, dense, line, t);
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
  for (const ParticipatingMedium* medium : media) part = std::min(part, medium->clearest_channel());
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
