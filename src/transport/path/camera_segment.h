/// The camera's ray through media, along which a path may receive what others have found.
#pragma once

#include <optional>

#include "surface/geometry.h"
#include "transport/media/span.h"
#include "transport/media/span_profile.h"
#include "volume/tracking.h"

namespace tyndall {

class DistanceSampler;

/// Probability of looking at what is behind media, over the chance of passing them.
inline constexpr float kSeenMore = 2;

/// Wherever the path goes by itself, it is one of those that might have collided anywhere along the ray, or passed. What that
/// takes is looked up when somebody asks.
class CameraSegment {
 public:
  /// `u`: uniform in [0, 1).
  CameraSegment(Span span, const std::optional<SurfaceHit>& end, float u, const Rng& rng)
      : span_(std::move(span)), end_(end), u_(u), rng_(rng) {}

  const Span& span() const { return span_; }
  const std::optional<SurfaceHit>& end() const { return end_; }  ///< the surface behind the media
  float u() const { return u_; }
  Rng& rng() { return rng_; }

  void collide(float t) { collision_ = t; }
  float collision() const { return collision_; }  ///< where the path collided, if it did

  /// Nothing: these media do not scatter.
  const std::optional<SpanProfile>& profile();
  /// By the profile, for MIS: of colliding at `t` where extinction is `sigma_t`, 1/length; and the chance of passing it all.
  float density(float t, float sigma_t) { return sigma_t * profile()->transmittance(t); }
  float chance_of_passing();
  /// Of distances at which light from `p`, or from infinity, may be gathered.
  DistanceSampler distances_to(std::optional<Vec3> p);
  /// An estimate of all of it, by roulette where little comes through.
  Rgb transmittance(TransmittanceStrategy strategy, TrackingStats& stats);

 private:
  Span span_;
  std::optional<SurfaceHit> end_;
  float u_;
  Rng rng_;
  float collision_ = 0;
  bool looked_ = false;
  std::optional<SpanProfile> profile_;
  float g_ = 0;  ///< mean cosine of the phase functions, roughly
};

}  // namespace tyndall
