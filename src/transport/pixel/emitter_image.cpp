#include "transport/pixel/emitter_image.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/warp.h"

namespace tyndall {
namespace {

/// Corners of the polygon about the lens: 1.024 times its area.
constexpr std::size_t kCorners = 12;

ConvexPolygon about_lens() {
  std::array<Point2, kCorners> corners;
  const double step = 2 * double{kPi} / kCorners, radius = 1 / std::cos(step / 2);
  for (std::size_t i = 0; i < kCorners; ++i) {
    const double angle = step * static_cast<double>(i);
    corners[i] = {radius * std::cos(angle), radius * std::sin(angle)};
  }
  return ConvexPolygon::hull(corners);
}

bool is_on_lens(Point2 p) { return p.x * p.x + p.y * p.y <= 1; }

ConvexPolygon hull(const SmallVector<Point2, 64>& points) { return ConvexPolygon::hull({points.data(), points.size()}); }

}  // namespace

LensPart::LensPart(const ConvexPolygon& polygon) {
  if (std::all_of(polygon.corners().begin(), polygon.corners().end(), is_on_lens)) {
    part_ = polygon;
    return;
  }
  static const ConvexPolygon lens = about_lens();
  const ConvexPolygon part = lens.cut(polygon);
  if (!(part.area() >= lens.area())) part_ = part;
}

std::optional<Point2> LensPart::sample(Vec2 u) const {
  if (!part_) {
    const Vec2 p = square_to_concentric_disk(u);
    return Point2{p.x, p.y};
  }
  if (part_->empty()) return std::nullopt;
  const Point2 p = part_->sample(u);
  return is_on_lens(p) ? std::optional(p) : std::nullopt;
}

std::optional<EmitterImage> EmitterImage::of(const BuiltWorld& world, std::uint32_t shape, std::uint32_t primitive) {
  if (!world.camera.has_projection()) return std::nullopt;
  // Wider than what rays through the film are rounded by: those that miss for it are made up for by those that hit.
  const double margin = world.camera.film_rounding();
  SmallVector<Point2, 64> corners, sharp;
  for (const Vec3d& p : world.geometry.outline(shape, primitive, world.camera.view())) {
    const auto image = world.camera.blurred_image_of(p);
    if (!image) return std::nullopt;
    const double x = margin + std::abs(image->by.x), y = margin + std::abs(image->by.y);
    for (const double sx : {-1, 1}) {
      for (const double sy : {-1, 1}) corners.push_back({image->at.x + sx * x, image->at.y + sy * y});
    }
    sharp.push_back(image->at);
  }
  EmitterImage image(world, shape, primitive);
  image.on_film_ = hull(corners);
  if (!world.camera.is_sharp() && !image.on_film_.empty())
    image.lit_ = std::min(hull(sharp).area() / image.on_film_.area(), 1.0);
  return image;
}

LensPart EmitterImage::on_lens(Point2 film) const {
  if (world_->camera.is_sharp()) return {};
  SmallVector<Point2, 64> corners;
  std::optional<bool> behind;  // what is in focus
  for (const Vec3d& p : world_->geometry.outline(shape_, primitive_, {world_->camera.focus_of(film)})) {
    const auto image = world_->camera.blurred_image_of(p);
    if (!image) return {};
    const Point2 at = image->on_lens(film);
    if (!std::isfinite(at.x) || !std::isfinite(at.y)) return {};
    if (behind.value_or(image->by.x > 0) != (image->by.x > 0)) return {};
    behind = image->by.x > 0;
    corners.push_back(at);
  }
  return corners.empty() ? LensPart() : LensPart(hull(corners));
}

}  // namespace tyndall
