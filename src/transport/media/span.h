/// The media along one ray, up to where it ends: its intervals between boundaries, one after the other or all together.
#pragma once

#include <algorithm>
#include <vector>

#include "transport/media/media_state.h"
#include "volume/homogeneous.h"

namespace tyndall {

/// One segment of a ray through an unchanging set of media.
struct Interval {
  float t0, t1;
  ActiveMedia media;  ///< never empty
  MediaView view() const { return {media.data(), media.size()}; }
};

/// Walks a ray's intervals in order: `while (auto i = walk.next()) ...`. Segments without a medium are skipped.
/// state() is the membership within the last interval given, and at t_end once next() gave nothing.
class SpanWalk {
 public:
  /// What the walk goes through: the world's groups and media.
  struct Context {
    const std::vector<BoundaryGroup>& groups;
    const std::vector<ParticipatingMedium>& media;
  };

  SpanWalk(const Context& context, const MediaState& start, const Crossings& crossings, float t_end)
      : context_(context), state_(start), crossings_(crossings), t_end_(t_end) {}

  std::optional<Interval> next() {
    while (t_ < t_end_) {
      pass_crossings();
      const float t0 = t_;
      t_ = next_crossing_ < crossings_.size() ? crossings_[next_crossing_].t : t_end_;
      Interval interval{t0, t_, state_.active(context_.groups, context_.media)};
      if (!interval.media.empty()) return interval;
    }
    return std::nullopt;
  }

  const MediaState& state() const { return state_; }
  int parity_errors() const { return parity_errors_; }

 private:
  void pass_crossings() {
    for (; next_crossing_ < crossings_.size() && crossings_[next_crossing_].t <= t_; ++next_crossing_) {
      const Crossing& c = crossings_[next_crossing_];
      if (!state_.cross(c.group, c.sign)) ++parity_errors_;
    }
  }

  Context context_;
  MediaState state_;
  const Crossings& crossings_;
  float t_end_;
  float t_ = 0;
  std::size_t next_crossing_ = 0;
  int parity_errors_ = 0;
};

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
