/// Maps that rotate, may mirror, scale evenly and move.
#pragma once

#include <optional>

#include "math/vec3d.h"

namespace tyndall {

/// Length scale of the linear part of `map` where it does nothing else, to within 1e-6; else nothing.
std::optional<double> similarity_scale(const Transform::Matrix& map);

/// From an inner space, an object's say, to an outer one. All in double precision; where the map is a similarity only
/// to 1e-6, so are the lengths of directions, while points and planes stay exact.
class Similarity {
 public:
  Similarity() = default;  ///< identity
  /// Nothing where the map is none.
  static std::optional<Similarity> of(const Transform& map);
  /// The same from an inner space whose origin is at `origin` of this one's.
  Similarity from_origin(Vec3d origin) const;

  double scale() const { return scale_; }  ///< outer lengths in one inner
  Vec3d point(Vec3d p) const { return out_.linear(p) + out_.move; }
  Vec3d direction(Vec3d d) const { return out_.linear(d) * (1 / scale_); }  ///< unit stays unit
  Vec3d normal(Vec3d n) const { return in_.transposed(n) * scale_; }        ///< likewise: perpendicular to what it was

  Vec3d inner_point(Vec3d p) const { return in_.linear(p) + in_.move; }
  Vec3d inner_direction(Vec3d d) const { return in_.linear(d) * scale_; }
  Vec3d inner_normal(Vec3d n) const { return out_.transposed(n) * (1 / scale_); }

 private:
  struct Map {
    Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, move;  ///< columns
    Vec3d linear(Vec3d v) const { return x * v.x + y * v.y + z * v.z; }
    Vec3d transposed(Vec3d v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
  };
  static Map map_of(const Transform::Matrix& m);

  Map out_, in_;
  double scale_ = 1;
};

}  // namespace tyndall
