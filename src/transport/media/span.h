/// The media along one ray, up to where it ends.
#pragma once

#include <algorithm>
#include <vector>

#include "transport/media/span_walk.h"
#include "volume/homogeneous.h"

namespace tyndall {

/// A segment with an unchanging set of media, and the membership there.
struct SpanPart : Interval {
  MediaState state;
  Bounds3 box;  ///< around these media
};

struct Span {
  Ray ray;
  float t_end = 0;              ///< Trace::t_end: infinite where nothing stops the ray
  std::vector<SpanPart> parts;  ///< in order, those without a medium left out
  MediaState end;               ///< membership at t_end

  bool empty() const { return parts.empty(); }
  /// The part that holds `t`; the nearest one where rounding has left all.
  const SpanPart& part_at(float t) const;
};

/// Whether all segments, SpanParts or other Intervals, have media that are known in closed form.
template <typename Parts>
bool homogeneous_throughout(const Parts& parts) {
  return std::all_of(parts.begin(), parts.end(), [](const Interval& part) { return all_homogeneous(part.view()); });
}

/// Mean cosine of the phase functions along a span, roughly: of all media alike.
float mean_cosine(const Span& span);

/// Walks the ray once, from where `start` is the membership. Adds what does not pair up to `parity_errors`.
Span make_span(const SpanWalk::Context& context, const MediaState& start, const Ray& ray, const Trace& trace,
               std::uint64_t& parity_errors);

}  // namespace tyndall
