#include "transport/film_emitters.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

/// Of the filter's radius: what is larger is hit often enough.
constexpr float kLargest = 1;
/// Pixels; slivers of larger circles may lie between pixel centers too, but are seen at others.
constexpr float kLargestMissed = 2;
/// Share of the filter's support that the circles may cover together; they are larger than the emitters in them.
constexpr float kMostFilled = 1;

/// Pixels along one axis whose filters cover an interval of the film, within bounds.
struct Range {
  int begin, end;
  Range(float at, float reach, int least, int most)
      : begin(std::max(static_cast<int>(std::ceil(at - reach - 0.5f)), least)),
        end(std::min(static_cast<int>(std::floor(at + reach - 0.5f)) + 1, most)) {}
};
Range columns_of(const FilmEmitters::View& view, const FilmEmitters::Spot& spot) {
  return {spot.at.x, spot.radius + view.filter_radius.x, view.pixels.x0, view.pixels.x1};
}
Range rows_of(const FilmEmitters::View& view, const FilmEmitters::Spot& spot) {
  return {spot.at.y, spot.radius + view.filter_radius.y, view.pixels.y0, view.pixels.y1};
}

/// The footprints that one pixel's filter covers.
struct Gathered {
  std::vector<FilmEmitter> lights;
  float filled = 0;  ///< pixels^2
  bool too_large = false;
};

}  // namespace

bool FilmEmitters::View::wants(const Spot& spot) const {
  const float least = std::min(filter_radius.x, filter_radius.y), widest = std::max(filter_radius.x, filter_radius.y);
  if (!(widest <= kWidestFilter) || !(spot.radius < std::max(kLargest * least, kLargestMissed))) return false;
  if (!(spot.brightness > 0 && spot.brightness < kInfinity)) return false;
  // In floats: places far off do not fit an int.
  const float rim = widest + spot.radius;
  return spot.at.x > static_cast<float>(pixels.x0) - rim && spot.at.x < static_cast<float>(pixels.x1) + rim &&
         spot.at.y > static_cast<float>(pixels.y0) - rim && spot.at.y < static_cast<float>(pixels.y1) + rim;
}

bool FilmEmitters::View::aims_at(const Spot& spot) const {
  return spot.radius < kLargest * std::min(filter_radius.x, filter_radius.y);
}

FilmEmitters::FilmEmitters(const View& view, const std::vector<Spot>& spots) : pixels_(view.pixels) {
  // Row by row: what all pixels see would be too much to keep at once.
  std::vector<std::vector<std::uint32_t>> by_row(static_cast<std::size_t>(pixels_.height()));
  for (std::size_t i = 0; i < spots.size(); ++i) {
    if (!view.wants(spots[i])) continue;
    const Range rows = rows_of(view, spots[i]);
    for (int y = rows.begin; y < rows.end; ++y) {
      by_row[static_cast<std::size_t>(y - pixels_.y0)].push_back(static_cast<std::uint32_t>(i));
    }
  }
  const auto none = [](const auto& row) { return row.empty(); };
  if (std::all_of(by_row.begin(), by_row.end(), none)) return;
  begin_.push_back(0);
  for (int y = pixels_.y0; y < pixels_.y1; ++y) add_row(view, y, spots, by_row[static_cast<std::size_t>(y - pixels_.y0)]);
}

void FilmEmitters::add_row(const View& view, int y, const std::vector<Spot>& spots, const std::vector<std::uint32_t>& seen) {
  const Vec2 radius = view.filter_radius;
  std::vector<Gathered> row(static_cast<std::size_t>(pixels_.width()));
  for (const std::uint32_t i : seen) {
    const Spot& spot = spots[i];
    const Range columns = columns_of(view, spot);
    for (int x = columns.begin; x < columns.end; ++x) {
      const float dx = (spot.at.x - (static_cast<float>(x) + 0.5f)) / radius.x;
      const float dy = (spot.at.y - (static_cast<float>(y) + 0.5f)) / radius.y;
      Gathered& g = row[static_cast<std::size_t>(x - pixels_.x0)];
      if (view.aims_at(spot)) {
        g.lights.push_back({spot.light, spot.brightness * toward_rim(dx, dy)});
        g.filled += kPi * spot.radius * spot.radius;
      } else {
        g.too_large = true;
      }
    }
  }
  for (Gathered& g : row) {
    const bool aims = g.filled < kMostFilled * 4 * radius.x * radius.y;
    unaimed_.push_back(g.too_large ? Unaimed::large : aims ? Unaimed::none : Unaimed::crowd);
    if (aims) {
      const auto end = g.lights.begin() + static_cast<std::ptrdiff_t>(std::min(g.lights.size(), PixelEmitters::kMost));
      std::partial_sort(g.lights.begin(), end, g.lights.end(), brighter<FilmEmitter>);
      lights_.insert(lights_.end(), g.lights.begin(), end);
    }
    begin_.push_back(static_cast<std::uint32_t>(lights_.size()));
  }
}

PixelEmitters FilmEmitters::of(int x, int y) const {
  if (begin_.empty()) return {};
  const std::size_t pixel = pixels_.index(x, y);
  PixelEmitters::List list;
  for (std::uint32_t i = begin_[pixel]; i < begin_[pixel + 1]; ++i) {
    if (lights_[i].brightness > 0) list.push_back(lights_[i]);
  }
  return PixelEmitters(std::move(list));
}

}  // namespace tyndall
