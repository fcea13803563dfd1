/// Segments of rays among lights, from the ordinary to the nasty.
#pragma once

#include "light/segment_query.h"
#include "light_cases.h"

namespace tyndall::test {

/// A homogeneous medium of extinction `sigma` as bins of equal optical depth, or of equal length where it is thin. It
/// ends `size` from the ray.
inline SegmentProfile homogeneous_profile(float t0, float t1, float sigma, float size, float g) {
  SegmentProfile p;
  p.g = g;
  const int bins = SegmentProfile::kBins;
  const double depth = double(sigma) * (double(t1) - t0);
  for (int i = 0; i <= bins; ++i) {
    const double share = double(i) / bins;
    const double t = i == 0 ? 0 : !(depth >= 1) ? share * (t1 - t0) : -std::log1p(-share * -std::expm1(-depth)) / sigma;
    p.edge[i] = i == bins ? t1 : static_cast<float>(t0 + t);
  }
  for (int i = 0; i < bins; ++i) {
    const double a = double(sigma) * (p.edge[i] - t0), b = double(sigma) * (p.edge[i + 1] - t0);
    const double mean = b > a ? (b - a < 1e-6 ? std::exp(-a) : (std::exp(-a) - std::exp(-b)) / (b - a)) : 0;
    p.scattering[i] = static_cast<float>(sigma * mean);
    if (t1 == kInfinity && i == bins - 1) p.scattering[i] = 0.02f * sigma;  // a mean over no end of length says nothing
    p.sigma[i] = sigma;
    p.escape[i] = sigma * size;
  }
  return p;
}

/// Through and around the lights, on them, short and long, bounded and not; the importances in turn.
inline std::vector<SegmentQuery> segments_for(const std::vector<LightBounds>& lights, std::size_t count, std::uint64_t seed) {
  Bounds3 box;
  for (const LightBounds& l : lights) box.expand(l.box);
  const Vec3 center = box.min * 0.5f + box.max * 0.5f, half = box.max * 0.5f - box.min * 0.5f;
  const float size = length(half) > 0 ? std::min(length(half), 1e30f) : std::max(length(center), 1.0f);
  Rng rng(seed);
  std::vector<SegmentQuery> queries;
  for (std::size_t i = 0; i < count; ++i) {
    SegmentQuery q{.o = center + half * random_in_cube(rng, 1.5f), .d = random_direction(rng), .t0 = 0, .t1 = 1};
    const LightBounds& light = lights[rng.next() % lights.size()];
    float span = size * (0.1f + 2 * rng.uniform());
    switch (i % 9) {
      case 0:
        break;
      case 1:  // through a light
        q.t0 = size * rng.uniform();
        q.o = light.box.min - q.d * (q.t0 + 0.5f * span);
        break;
      case 2:
        span = kInfinity;
        break;
      case 3:
        span = size * 1e-6f;
        break;
      case 4:
        span = size * 1e6f;
        break;
      case 5:
        q.o = center;
        span = size * 0.1f;
        break;
      case 6:  // toward the lights from afar
        q.d = normalize(center + half * random_in_cube(rng) - q.o * 20.0f);
        q.o = q.o * 20.0f;
        q.t0 = 10 * size;
        span = 30 * size;
        break;
      case 7:  // from a light
        q.o = light.box.min;
        break;
      default:  // along an axis, where much is exactly 0
        q.o = light.box.min;
        q.o.x = center.x - 2 * size;
        q.d = {1, 0, 0};
        span = i % 2 ? kInfinity : 4 * size;
        break;
    }
    if (!(length(q.d) > 0.5f)) q.d = {0, 0, 1};
    q.t1 = q.t0 + span;
    if (!(q.t1 > q.t0)) q.t1 = std::nextafter(q.t0, kInfinity);
    q.reach = size * (0.1f + rng.uniform());
    constexpr MediaStrategy importances[] = {MediaStrategy::closest, MediaStrategy::integral, MediaStrategy::product};
    q.importance = importances[(i / 9) % 3];
    const float depth = std::exp(8 * rng.uniform() - 4), g = i % 2 ? 0 : 1.8f * rng.uniform() - 0.9f;
    q.profile = homogeneous_profile(q.t0, q.t1, depth / size, size, g);
    queries.push_back(q);
  }
  return queries;
}

}  // namespace tyndall::test
