#include "transport/pixel/point_images.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "transport/pixel/chosen_by_brightness.h"

namespace tyndall {
namespace {

/// Pixels. For wider filters the peak does not matter.
constexpr float kWidestFilter = 32;
/// Of the filter's radius. Farther from the images of lights its own samples suffice (docs/measurements.md).
constexpr float kReach = 0.3f;

int pixel_of(float x) { return static_cast<int>(std::floor(x)); }

/// The pixels, and around them what their filters overlap.
PixelBounds with_rim(const PixelBounds& pixels, Vec2 radius) {
  const int x = static_cast<int>(std::ceil(radius.x)), y = static_cast<int>(std::ceil(radius.y));
  return {pixels.x0 - x, pixels.y0 - y, pixels.x1 + x, pixels.y1 + y};
}

/// Of equals the first.
bool brighter(const FilmPoint& a, const FilmPoint& b) {
  return a.brightness != b.brightness ? a.brightness > b.brightness : a.light < b.light;
}

/// Weight of a light at an offset from the pixel, in radii of its filter. Less at the rim, as the filter is there, but what
/// reaches in from beyond has its share.
float toward_rim(float dx, float dy) { return std::exp(-2.25f * std::min(dx * dx + dy * dy, 1.5f)); }

}  // namespace

FilmReach::FilmReach(Vec2 filter_radius, float finest)
    : least_(finest), most_(std::max(kReach * std::min(filter_radius.x, filter_radius.y), 2 * finest)) {}

Vec2 FilmReach::draw(Vec2 at, Vec2 u) const {
  const float distance = least_ + (most_ - least_) * u.x, phi = 2 * kPi * u.y;
  return {at.x + distance * std::cos(phi), at.y + distance * std::sin(phi)};
}

float FilmReach::pdf(Vec2 at, Vec2 x) const {
  const float distance = std::hypot(x.x - at.x, x.y - at.y);
  if (!(distance >= least_ && distance <= most_)) return 0;
  return 1 / (2 * kPi * distance * (most_ - least_));
}

PixelPoints::PixelPoints(const FilmReach& reach, List points) : reach_(reach), points_(std::move(points)) {
  keep_brightest(points_, kMost, brighter);
}

PixelPoints::Draw PixelPoints::draw(float which, Vec2 around) const {
  const FilmPoint& chosen = chosen_by_brightness(points_, which);
  const Vec2 x = reach_.draw(chosen.at, around);
  return {chosen.light, x, pdf(chosen, x), chosen.g};
}

float PixelPoints::pdf(LightId light, Vec2 x) const {
  const auto* const at = std::find_if(points_.begin(), points_.end(), [&](const FilmPoint& p) { return p.light == light; });
  return at == points_.end() ? 0.0f : pdf(*at, x);
}

bool FilmPoints::View::sees(Vec2 at) const {
  if (!(std::max(filter_radius.x, filter_radius.y) <= kWidestFilter)) return false;
  const PixelBounds cells = with_rim(pixels, filter_radius);
  return at.x >= static_cast<float>(cells.x0) && at.y >= static_cast<float>(cells.y0) && at.x < static_cast<float>(cells.x1) &&
         at.y < static_cast<float>(cells.y1);
}

FilmPoints::FilmPoints(const View& view, std::vector<FilmPoint> points)
    : reach_(view.filter_radius, view.finest), radius_(view.filter_radius), points_(std::move(points)) {
  std::erase_if(points_, [&](const FilmPoint& point) {
    return !(point.brightness > 0 && point.brightness < kInfinity && view.sees(point.at));
  });
  if (points_.empty()) return;
  cells_ = with_rim(view.pixels, radius_);
  const auto cell_of = [&](const FilmPoint& point) { return cells_.index(pixel_of(point.at.x), pixel_of(point.at.y)); };
  std::sort(points_.begin(), points_.end(), [&](const FilmPoint& a, const FilmPoint& b) {
    const std::size_t in_a = cell_of(a), in_b = cell_of(b);
    return in_a != in_b ? in_a < in_b : brighter(a, b);
  });
  // More lights of one cell than a pixel takes are not needed.
  begin_.resize(static_cast<std::size_t>(cells_.width()) * cells_.height() + 1);
  std::size_t kept = 0;
  for (const FilmPoint& point : points_) {
    std::uint32_t& count = begin_[cell_of(point) + 1];
    if (count == PixelPoints::kMost) continue;
    ++count;
    points_[kept++] = point;
  }
  points_.resize(kept);
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
}

PixelPoints FilmPoints::of(int x, int y) const {
  PixelPoints::List seen;
  if (begin_.empty()) return {reach_, {}};
  const Vec2 center{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
  for (int row = pixel_of(center.y - radius_.y); row <= pixel_of(center.y + radius_.y); ++row) {
    const std::uint32_t end = begin_[cells_.index(pixel_of(center.x + radius_.x), row) + 1];
    for (std::uint32_t i = begin_[cells_.index(pixel_of(center.x - radius_.x), row)]; i < end; ++i) {
      FilmPoint point = points_[i];
      const float dx = (point.at.x - center.x) / radius_.x, dy = (point.at.y - center.y) / radius_.y;
      if (!(std::abs(dx) < 1 && std::abs(dy) < 1)) continue;
      point.brightness *= toward_rim(dx, dy);
      seen.push_back(point);
    }
  }
  return {reach_, std::move(seen)};
}

}  // namespace tyndall
