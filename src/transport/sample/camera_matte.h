/// What the ray of a sample sees first: the surface, and the media before it, for mattes.
#pragma once

#include <cstdint>
#include <optional>

#include "math/small_vector.h"
#include "transport/media/span.h"
#include "transport/sample/light_context.h"

namespace tyndall {

/// LightContext::matte points to it where the film has mattes. Its random numbers are its own: paths do not know of it.
class CameraMatte {
 public:
  struct Share {
    const ParticipatingMedium* medium;
    float opacity;
  };

  /// The ray ends at `trace`; nothing is in between but what see_through() tells.
  void meet(const Trace& trace);
  /// The media before its end: how much of what is behind each hides, mean of the channels. Where some overlap, what they hide
  /// together is shared out by their extinction at kLooks places.
  void see_through(const LightContext& context, const Span& span);

  const SmallVector<Share, 4>& media() const { return media_; }
  std::optional<std::uint32_t> shape() const { return shape_; }  ///< index into Geometry::placed(); nothing: background
  float transmittance() const { return transmittance_; }         ///< up to it, mean of the channels

 private:
  void share(const SpanPart& part, const Ray& ray, float opacity, Rng& rng);

  SmallVector<Share, 4> media_;
  std::optional<std::uint32_t> shape_;
  float transmittance_ = 1;
};

}  // namespace tyndall
