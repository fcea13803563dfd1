/// The intervals of a ray between media boundaries.
#pragma once

#include "transport/media/media_state.h"

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

}  // namespace tyndall
