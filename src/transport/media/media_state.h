/// Which boundary groups hold a point, and so which media are there.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "math/small_vector.h"
#include "surface/geometry.h"
#include "volume/tracking.h"

namespace tyndall {

/// Media that overlap somewhere; a medium that two groups bring counts twice.
using ActiveMedia = SmallVector<const ParticipatingMedium*, 4>;

/// A box that holds `medium` wherever it is the inside of a group, infinite where it is `unbounded`; empty where it is nowhere.
Bounds3 reach_of(MediumId medium, const std::vector<BoundaryGroup>& groups, std::optional<MediumId> unbounded);

/// What both boxes hold.
Bounds3 overlap(const Bounds3& a, const Bounds3& b);

/// How far `p` is outside of `box`.
float distance_outside(const Bounds3& box, Vec3 p);

/// How far `ray` goes until it has left `box` for good: infinite where the box is.
float exit_distance(const Bounds3& box, const Ray& ray);

/// The path's place among the media, carried from vertex to vertex. docs/methods.md, "Membership of media": per group the
/// signed crossings are summed, and the point is inside while the sum is positive.
class MediaState {
 public:
  MediaState() = default;
  /// `unbounded`: a medium that fills all space (the camera's fog).
  explicit MediaState(std::optional<MediumId> unbounded) : unbounded_(unbounded) {}

  /// Pass one boundary: sign +1 enters the group, -1 leaves it. Leaving a group that does not hold the point changes
  /// nothing and returns false: the crossing and its partner did not pair up.
  bool cross(std::uint32_t group, int sign);

  /// Media here: each group's inside medium less its outside medium, never below zero.
  ActiveMedia active(const std::vector<BoundaryGroup>& groups, const std::vector<ParticipatingMedium>& media) const;

  /// A box that holds all of the media that are here: infinite with an unbounded one.
  Bounds3 bounds(const std::vector<BoundaryGroup>& groups) const;

  /// Distance after which the ray may have left one of the groups that hold its origin; infinite where none does.
  float first_exit(const std::vector<BoundaryGroup>& groups, const Ray& ray) const;

  bool in_any_group() const { return !inside_.empty(); }
  std::optional<MediumId> unbounded() const { return unbounded_; }
  void set_unbounded(std::optional<MediumId> medium) { unbounded_ = medium; }
  /// Whether some group that holds the point has `medium` as its inside.
  bool brings(MediumId medium, const std::vector<BoundaryGroup>& groups) const;

 private:
  struct Membership {
    std::uint32_t group;
    std::int32_t count;  ///< > 0
  };
  std::optional<MediumId> unbounded_;
  SmallVector<Membership, 4> inside_;
};

}  // namespace tyndall
