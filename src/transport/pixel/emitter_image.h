/// What the camera sees of a primitive: where on the film, and through which part of its lens.
#pragma once

#include <cstdint>
#include <optional>

#include "math/polygon.h"
#include "transport/world/built_world.h"

namespace tyndall {

/// A part of the camera's lens, the unit disk.
class LensPart {
 public:
  /// All of it.
  LensPart() {}
  /// What of it is in a polygon.
  explicit LensPart(const ConvexPolygon& polygon);

  bool holds(Point2 lens) const { return !part_ || part_->holds(lens); }
  /// A place, uniform in it; nothing where that is not on the lens, whose outline is a circle, or it is empty.
  std::optional<Point2> sample(Vec2 u) const;
  /// Of the lens' area.
  double share() const { return part_ ? part_->area() / kPi : 1; }

 private:
  std::optional<ConvexPolygon> part_;  ///< none: all
};

class EmitterImage {
 public:
  /// Of a primitive of Geometry::placed(). Nothing where it is not all before the camera, or the camera has no projection.
  static std::optional<EmitterImage> of(const BuiltWorld& world, std::uint32_t shape, std::uint32_t primitive);

  LightId light() const { return world_->first_light[shape_] + primitive_; }
  /// A convex polygon (pixels of the full frame) that holds the image, through whatever place on the lens, and is little
  /// larger.
  const ConvexPolygon& on_film() const { return on_film_; }
  /// Of that, what is lit through a place on the lens: the mean over places, in [0, 1].
  double lit() const { return lit_; }
  /// Holds the places on the lens through which it is seen at `film`, and is little larger.
  LensPart on_lens(Point2 film) const;
  /// Whether film and lens hold a ray.
  bool holds(Point2 film, Point2 lens) const { return on_film_.holds(film) && on_lens(film).holds(lens); }

 private:
  EmitterImage(const BuiltWorld& world, std::uint32_t shape, std::uint32_t primitive)
      : world_(&world), shape_(shape), primitive_(primitive) {}

  const BuiltWorld* world_;
  std::uint32_t shape_, primitive_;
  ConvexPolygon on_film_;
  double lit_ = 1;
};

}  // namespace tyndall
