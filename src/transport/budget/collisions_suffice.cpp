#include "transport/budget/collisions_suffice.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "volume/coarse.h"

namespace tyndall {
namespace {

/// Light found at collisions alone, E[x^2] / E[x]^2, below which pairs of lights and distances are not worth their cost.
constexpr float kMostVaried = 2.5f;
/// Looks at the media of each part, and the transmittance beyond which there is nothing to see.
constexpr int kLooks = 8;
constexpr float kOpaque = 0.05f;

/// How light that is found at collisions alone varies: a path collides in look i with probability w_i, and finds E(t) =
/// 1 / d(t)^2 there, d being the distance to the nearest light: E[x^2] / E[x]^2 = sum_i w_i <E^2>_i / (sum_i w_i <E>_i)^2.
class FoundAtCollisions {
 public:
  FoundAtCollisions(const BuiltWorld& world, const Ray& ray)
      : distances_(world.light_distances), lights_(world.lights.near_box()), ray_(ray) {}

  void look_through(const Interval& part) {
    const auto extent = coarse_extent(part.view(), ray_, part.t0, part.t1);
    if (!extent) return;
    if (!(extent->second < kInfinity)) return look_beyond();
    const CoarseRay coarse(part.view(), ray_);
    const float step = (extent->second - extent->first) / kLooks;
    for (int i = 0; i < kLooks && passes_ > kOpaque && squares_ < kInfinity; ++i) {
      const float begin = extent->first + static_cast<float>(i) * step;
      look_at(begin, step, coarse.at(begin + 0.5f * step).sigma_t);
    }
  }
  /// Without bound where a light holds the middle of a look, and where no path collides.
  float varied() const { return mean_ > 0 && squares_ < kInfinity ? squares_ / (mean_ * mean_) : kInfinity; }

 private:
  /// Media without end: every path collides, anywhere.
  void look_beyond() {
    if (!lights_.empty()) squares_ = kInfinity;
    add(passes_, 1, 1);
    passes_ = 0;
  }

  void look_at(float begin, float length, float sigma_t) {
    if (!(sigma_t > 0)) return;
    length = std::min(length, std::log(2 * passes_ / kOpaque) / sigma_t);  // as far as kOpaque / 2 pass: it is the last one
    const float passes = passes_ * std::exp(-sigma_t * length), collides = passes_ - passes;
    passes_ = passes;
    const float d = distance(ray_.at(begin + 0.5f * length)), half = 0.5f * length;
    if (d == kInfinity) return add(collides, 1, 1);
    // Means of 1 / (d^2 + x^2) and its square over |x| < half: the light stands abreast of the middle.
    const float mean = std::atan(half / d) / (half * d);
    add(collides, mean, 0.5f * (1 / (d * d + half * half) + mean) / (d * d));
  }

  /// To the nearest light that is not at infinity; where media have no bounds, to the box of all.
  float distance(Vec3 p) const {
    if (lights_.empty()) return kInfinity;
    return distances_.empty() ? distance_outside(lights_, p) : distances_.distance(p);
  }

  void add(float collides, float mean, float squares) { mean_ += collides * mean, squares_ += collides * squares; }

  const LightDistances& distances_;
  const Bounds3& lights_;
  const Ray& ray_;
  float passes_ = 1, mean_ = 0, squares_ = 0;
};

/// Whether nothing of the media is known in closed form.
template <typename Parts>
bool read_throughout(const Parts& parts) {
  return std::none_of(parts.begin(), parts.end(), [](const Interval& part) {
    const MediaView media = part.view();
    return std::any_of(media.begin(), media.end(), [](const ParticipatingMedium* m) { return m->homogeneous(); });
  });
}

template <typename Parts>
bool suffice(const LightContext& context, const Ray& ray, const Parts& parts) {
  const RenderSettings& settings = context.settings;
  const bool by_default = settings.media == MediaStrategy::product && settings.distance == DistanceStrategy::automatic;
  if (!by_default || seeks_volume_lights(context)) return false;
  if (is_single_scattering(context)) return false;  // it draws many pairs
  if (context.bounce > 0 && read_throughout(parts)) return true;
  FoundAtCollisions found(context.world, ray);
  for (const Interval& part : parts) found.look_through(part);
  return found.varied() < kMostVaried;
}

}  // namespace

bool collisions_suffice(const LightContext& context, const Span& span) { return suffice(context, span.ray, span.parts); }

bool collisions_suffice(const LightContext& context, const Ray& ray, const Interval& inside) {
  return suffice(context, ray, std::span(&inside, 1));
}

bool is_deep(const Ray& ray, const Interval& inside) {
  const float depth = coarse_optical_depth(inside.view(), ray, inside.t0, inside.t1);
  return -std::expm1(-depth) * kMostVaried > 1;
}

}  // namespace tyndall
