#include "transport/budget/collisions_suffice.h"

#include <algorithm>
#include <span>

#include "volume/coarse.h"

namespace tyndall {
namespace {

/// Lights this many times as far from the middle of a span as its ends are.
constexpr float kFarAway = 1.5f;
/// Optical depths from which collisions suffice. Pairs cost more in media that are read than in those known in closed form
/// (docs/measurements.md).
constexpr float kDeep = 0.5f, kDeepUniform = 2;
/// On later spans of this optical depth within the size of the lights' box, among lights as well. With less, collisions next to
/// lights make fireflies in thinner smoke (docs/measurements.md).
constexpr float kDeepLater = 8;
constexpr int kReads = 4;
/// Least distance of lights from all of a segment, in half lengths of it (docs/measurements.md).
constexpr float kKeptDistance = 0.5f;
/// After the first collision, where less of the picture depends on it; and the share of the optical depth above that suffices
/// there (docs/measurements.md).
constexpr float kKeptDistanceLater = 0.125f, kDeepShareLater = 0.5f;
/// The segment is where the optical depth passed is between these.
constexpr float kClear = 0.01f, kOpaque = 2;
constexpr int kLooks = 8;  ///< reads in one part of it

bool far_from(const Bounds3& lights, const Ray& ray, float t0, float t1) {
  if (lights.empty()) return true;
  const float half = 0.5f * (t1 - t0);
  return half < kInfinity && distance_outside(lights, ray.at(t0 + half)) > kFarAway * half;
}

/// Whether the optical depth before `end` is more than that.
template <typename Parts>
bool deeper_than(float enough, const Ray& ray, const Parts& parts, float end = kInfinity) {
  float depth = 0;
  for (const Interval& part : parts) {
    if (part.t0 >= end) break;
    depth += coarse_optical_depth(part.view(), ray, part.t0, std::min(part.t1, end), kReads);
    if (depth > enough) return true;
  }
  return false;
}

template <typename Parts>
float enough_depth(const Parts& parts) {
  return homogeneous_throughout(parts) ? kDeepUniform : kDeep;
}
template <typename Parts>
bool deep(const Ray& ray, const Parts& parts) {
  return deeper_than(enough_depth(parts), ray, parts);
}

/// Whether the media ahead are nearly opaque within the size of `lights`: emitters that matter are as near as the next
/// collision.
template <typename Parts>
bool opaque_among(const Bounds3& lights, const Ray& ray, const Parts& parts) {
  return !lights.empty() && deeper_than(kDeepLater, ray, parts, parts.front().t0 + length(lights.max - lights.min));
}

/// Where media scatter before they are opaque, read from the ray's origin on, and the distance to the nearest light there.
class Approach {
 public:
  Approach(const LightDistances& lights, const Ray& ray, float kept_distance)
      : lights_(lights), ray_(ray), kept_distance_(kept_distance) {}

  /// False: a light is too near.
  bool look_through(const Interval& part) {
    const auto extent = coarse_extent(part.view(), ray_, part.t0, part.t1);
    if (!extent) return true;
    const CoarseRay coarse(part.view(), ray_);
    const float step = (extent->second - extent->first) / kLooks;
    for (int i = 0; i < kLooks && !opaque_; ++i) {
      const float begin = extent->first + static_cast<float>(i) * step;
      if (!look_at(begin, step, coarse.at(begin + 0.5f * step).sigma_t)) return false;
    }
    return true;
  }
  bool deep(float enough) const { return opaque_ || depth_ > enough; }

 private:
  bool look_at(float begin, float length, float sigma_t) {
    const float left = kOpaque - depth_;
    opaque_ = sigma_t * length >= left;
    if (opaque_) length = left / sigma_t;
    depth_ += sigma_t * length;
    if (!(depth_ > kClear) || !(sigma_t > 0)) return true;
    begin_ = std::min(begin_, begin);
    nearest_ = std::min(nearest_, lights_.distance(ray_.at(begin + 0.5f * length)));
    return nearest_ > kept_distance_ * 0.5f * (begin + length - begin_);
  }

  const LightDistances& lights_;
  const Ray& ray_;
  float kept_distance_;
  float depth_ = 0, begin_ = kInfinity, nearest_ = kInfinity;
  bool opaque_ = false;
};

template <typename Parts>
bool lights_keep_distance(const LightContext& context, const Ray& ray, const Parts& parts) {
  if (context.world.light_distances.empty() || !(parts.back().t1 < kInfinity)) return false;
  const bool later = context.bounce > 0;
  Approach approach(context.world.light_distances, ray, later ? kKeptDistanceLater : kKeptDistance);
  for (const Interval& part : parts) {
    if (!approach.look_through(part)) return false;
  }
  return approach.deep(enough_depth(parts) * (later ? kDeepShareLater : 1));
}

/// A few reads may pass by what is dense on later spans through a grid. Pairs then draw their distances elsewhere, and make
/// fireflies (docs/measurements.md).
template <typename Parts>
bool may_be_missed(const LightContext& context, const Parts& parts) {
  return context.bounce > 0 && !homogeneous_throughout(parts);
}

template <typename Parts>
bool suffice(const LightContext& context, const Ray& ray, const Parts& parts) {
  const RenderSettings& settings = context.settings;
  const bool by_default = settings.media == MediaStrategy::product && settings.distance == DistanceStrategy::automatic;
  if (!by_default || seeks_volume_lights(context)) return false;
  if (is_single_scattering(context)) return false;  // it draws many pairs
  const Bounds3& lights = context.world.lights.near_box();
  if (context.bounce > 0 && opaque_among(lights, ray, parts)) return true;
  if (far_from(lights, ray, parts.front().t0, parts.back().t1)) return may_be_missed(context, parts) || deep(ray, parts);
  return lights_keep_distance(context, ray, parts);
}

}  // namespace

bool collisions_suffice(const LightContext& context, const Span& span) { return suffice(context, span.ray, span.parts); }

bool collisions_suffice(const LightContext& context, const Ray& ray, const Interval& inside) {
  return suffice(context, ray, std::span(&inside, 1));
}

bool is_deep(const Ray& ray, const Interval& inside) { return deep(ray, std::span(&inside, 1)); }

}  // namespace tyndall
