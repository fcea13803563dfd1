#include "transport/film_lamps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

/// Pixels. Whoever filters more widely has no use for a peak.
constexpr float kWidestFilter = 32;
/// Of the filter's radius. Farther from lamps its own samples do as well: in smoke of depth 5 and 10, one event and 16 samples
/// a pixel, MSE is the same for 0.2 and 0.3, 1.0 to 1.1 times as much for 0.12, 1.2 to 1.4 for 0.07 and 1.9 to 2.4 for 1.
constexpr float kReach = 0.3f;

int pixel_of(float x) { return static_cast<int>(std::floor(x)); }

/// The pixels, and around them what their filters overlap.
PixelBounds with_rim(const PixelBounds& pixels, Vec2 radius) {
  const int x = static_cast<int>(std::ceil(radius.x)), y = static_cast<int>(std::ceil(radius.y));
  return {pixels.x0 - x, pixels.y0 - y, pixels.x1 + x, pixels.y1 + y};
}

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

PixelLamps::Draw PixelLamps::draw(float which, Vec2 around) const {
  const FilmLamp& lamp = lamps_.draw(which);
  const Vec2 x = reach_.draw(lamp.at, around);
  return {lamp.light, x, lamp.brightness * reach_.pdf(lamp.at, x), lamp.g};
}

float PixelLamps::pdf(LightId light, Vec2 x) const {
  const FilmLamp* lamp = lamps_.find(light);
  return lamp ? lamp->brightness * reach_.pdf(lamp->at, x) : 0.0f;
}

bool FilmLamps::View::sees(Vec2 at) const {
  if (!(std::max(filter_radius.x, filter_radius.y) <= kWidestFilter)) return false;
  const PixelBounds cells = with_rim(pixels, filter_radius);
  return at.x >= static_cast<float>(cells.x0) && at.y >= static_cast<float>(cells.y0) && at.x < static_cast<float>(cells.x1) &&
         at.y < static_cast<float>(cells.y1);
}

FilmLamps::FilmLamps(const View& view, std::vector<FilmLamp> lamps)
    : reach_(view.filter_radius, view.finest), radius_(view.filter_radius), lamps_(std::move(lamps)) {
  std::erase_if(lamps_, [&](const FilmLamp& lamp) {
    return !(lamp.brightness > 0 && lamp.brightness < kInfinity && view.sees(lamp.at));
  });
  if (lamps_.empty()) return;
  cells_ = with_rim(view.pixels, radius_);
  const auto cell_of = [&](const FilmLamp& lamp) { return cells_.index(pixel_of(lamp.at.x), pixel_of(lamp.at.y)); };
  std::sort(lamps_.begin(), lamps_.end(), [&](const FilmLamp& a, const FilmLamp& b) {
    const std::size_t in_a = cell_of(a), in_b = cell_of(b);
    return in_a != in_b ? in_a < in_b : brighter(a, b);
  });
  // More of one cell than a pixel takes would only be looked through.
  begin_.resize(static_cast<std::size_t>(cells_.width()) * cells_.height() + 1);
  std::size_t kept = 0;
  for (const FilmLamp& lamp : lamps_) {
    std::uint32_t& count = begin_[cell_of(lamp) + 1];
    if (count == PixelLamps::Lamps::kMost) continue;
    ++count;
    lamps_[kept++] = lamp;
  }
  lamps_.resize(kept);
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
}

PixelLamps FilmLamps::of(int x, int y) const {
  PixelLamps::Lamps::List seen;
  if (begin_.empty()) return {reach_, {}};
  const Vec2 center{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
  for (int row = pixel_of(center.y - radius_.y); row <= pixel_of(center.y + radius_.y); ++row) {
    const std::uint32_t end = begin_[cells_.index(pixel_of(center.x + radius_.x), row) + 1];
    for (std::uint32_t i = begin_[cells_.index(pixel_of(center.x - radius_.x), row)]; i < end; ++i) {
      FilmLamp lamp = lamps_[i];
      const float dx = (lamp.at.x - center.x) / radius_.x, dy = (lamp.at.y - center.y) / radius_.y;
      if (!(std::abs(dx) < 1 && std::abs(dy) < 1)) continue;
      lamp.brightness *= toward_rim(dx, dy);
      seen.push_back(lamp);
    }
  }
  return {reach_, std::move(seen)};
}

}  // namespace tyndall
