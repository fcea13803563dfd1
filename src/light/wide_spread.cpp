#include "light/wide_spread.h"

#include "light/wide_glossy.h"

namespace tyndall {
namespace {

/// Within this many standard deviations of its mean a cluster is taken to hold the point.
constexpr float kInside = 1.5f;

/// Where a lobe is seen within this many of its widths, widened by the cluster, its shape makes contributions differ.
constexpr float kReach2 = 4;

/// Second moment over the square of the first, of a lobe over a cluster that widens it.
Float8 lobe_moment(const QueryLobe& lobe, const Arrival& a) {
  const Facets f(lobe, a);
  const Float8 narrow = lobe.slope2_t * lobe.slope2_b, moment = sqrt(f.slope2_t * f.slope2_b / narrow);
  return choose(f.t * f.t / f.slope2_t + f.b * f.b / f.slope2_b < kReach2 * f.n * f.n, moment, 1.0f);
}

/// The same for Henyey-Greenstein, which falls to a quarter near 1.2 (1 - |g|) off its axis.
Float8 phase_moment(const WideQuery& query, const Vector8& toward, Float8 variance) {
  const float width = 1.2f * (1 - std::abs(query.g)), width2 = width * width;
  const Vec3 axis = query.g > 0 ? query.forward : -query.forward;
  const Float8 off2 = 2 - 2 * (axis.x * toward.x + axis.y * toward.y + axis.z * toward.z);
  return choose(off2 < kReach2 * (width2 + variance), 1 + variance / width2, 1.0f);
}

}  // namespace

// Directions and distances of a cluster's lights vary with the variance of their positions; so does what depends on them,
// to first order. Taken as independent, the variations multiply [Conty Estevez and Kulla 2018, sec. 5.4].
[[gnu::flatten]] ChildSpread child_spread(const WideNode& node, const WideQuery& query) {
  const auto to_mean = [&](int k, float p) {
    return load8(node.center[k]) - p + load8(node.mean[k]) * WideNode::kMeanStep * load8_upper(node.half[k]);
  };
  const Vector8 mean{to_mean(0, query.p.x), to_mean(1, query.p.y), to_mean(2, query.p.z)};
  const Float8 deviation = load8_upper(node.deviation), d2 = max(dot(mean, mean), Float8(1e-33f));
  const Float8 per_distance = 1 / sqrt(d2);
  const Vector8 toward{mean.x * per_distance, mean.y * per_distance, mean.z * per_distance};
  const Float8 v = deviation * deviation / d2;  // of direction, both axes, and of relative distance
  Float8 moment = (1 + load8_upper(node.intensity_cv2)) * (1 + 4.0f / 3 * v);
  if (query.surface) {
    const Vector8 n{query.n.x, query.n.y, query.n.z};
    const Float8 cosine = max(abs(dot(n, toward)), Float8(0.1f)), cos2 = cosine * cosine;
    const Arrival arrival{toward, v, cosine, 0, 0};
    Float8 glossy = 1;
    for (int i = 0; i < query.lobe_count; ++i) glossy = max(glossy, lobe_moment(query.lobes[i], arrival));
    moment *= (1 + 0.5f * v * (1 - cos2) / cos2) * glossy;
  } else if (query.g != 0) {
    moment *= phase_moment(query, toward, v);
  }
  const auto beyond = [&](int k, float p) { return abs(load8(node.center[k]) - p) - load8_upper(node.half[k]); };
  const Float8 outside = max(max(beyond(0, query.p.x), beyond(1, query.p.y)), beyond(2, query.p.z));
  const Mask8 inside = outside <= 0.0f || d2 <= kInside * kInside * deviation * deviation;
  const Mask8 leaf = load8(node.count) == 1.0f;
  ChildSpread result;
  store8(result.cv2.data(), choose(leaf, 0.0f, choose(inside, 1e30f, moment - 1)));
  return result;
}

}  // namespace tyndall
