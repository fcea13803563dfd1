#include "transport/pixel/film_emitters.h"

#include <algorithm>
#include <cmath>

#include "transport/pixel/directly_visible.h"

namespace tyndall {
namespace {

/// Film positions a sample where something else ends within an emitter's image (docs/measurements.md).
constexpr std::uint8_t kPositions = 13;
/// Looks at the emitters of a pixel, to know of what hides them.
constexpr std::size_t kLooks = 8;
/// Emitters that fill a pixel: places along each side of the filter's support where they are looked at.
constexpr int kLooksAtOne = 2, kLooksAtMany = 4;
/// Between looks, relative to the brighter: more than emission varies, less than another emitter differs.
constexpr float kLeastContrast = 0.1f;

/// Pixels. Where rays are off by more, images would be mostly margin.
constexpr float kLargestRounding = 0.05f;

/// Not where the film limits samples: a mean over several would be limited less.
bool is_wanted(const BuiltWorld& world, const RenderSettings& settings) {
  if (world.scene.film.max_component < kInfinity || !world.camera.is_sharp()) return false;
  if (!(world.camera.film_rounding() < kLargestRounding)) return false;
  const Vec2 radius = world.scene.filter.radius;
  if (!(std::max(radius.x, radius.y) <= FilmEmitters::kWidestFilter)) return false;
  const bool asked = settings.joint == JointStrategy::points && settings.lights != LightStrategy::exhaustive;
  return asked && world.lights.stats().emitters > 0;
}

/// An emitter of the picture.
struct SeenEmitter {
  std::uint32_t shape, primitive;
  Rectangle box;     ///< of its image
  float brightness;  ///< radiance that it sends
};

/// What a pixel's filter sees.
struct InPixel {
  std::uint32_t emitter;  ///< of the list of all
  float mass;             ///< of the filter, that its image covers
  bool hull;              ///< the polygon is but a hull of what ends there
};

/// Places on an emitter's image that were looked at, and those that saw it.
struct Looks {
  std::size_t looks, met;

  bool partly() const { return met > 0 && met < looks; }
  /// What the emitter's light is weighed by in its share: with that of root mean square the estimate of what is found by such
  /// shares has the least variance, and the mean square of a yes or no is its chance, here by Jeffreys's prior.
  float weight() const { return std::sqrt((static_cast<float>(met) + 0.5f) / (static_cast<float>(looks) + 1)); }
};

/// What the pixels of one row draw, one after the other.
struct Row {
  std::vector<FilmEmitter> emitters;
  std::vector<std::uint32_t> counts;
  std::vector<std::uint8_t> positions;
};

class Search {
 public:
  explicit Search(const FilmSearch& search) : search_(search), world_(search.world), cells_(search.world.filter) {}

  std::vector<SeenEmitter> all() const {
    struct Block {
      std::uint32_t shape, begin, end;
    };
    constexpr std::uint32_t kBlock = 4096;
    std::vector<Block> blocks;
    for (std::uint32_t shape = 0; shape < world_.first_light.size(); ++shape) {
      if (world_.first_light[shape] == kNone) continue;
      const auto count = static_cast<std::uint32_t>(primitives_of(*world_.geometry.placed()[shape].shape));
      for (std::uint32_t i = 0; i < count; i += kBlock) blocks.push_back({shape, i, std::min(count, i + kBlock)});
    }
    std::vector<std::vector<SeenEmitter>> found(blocks.size());
    search_.pool.for_each(blocks.size(), 1, [&](std::size_t b) {
      search_.alive();
      for (std::uint32_t i = blocks[b].begin; i < blocks[b].end; ++i) {
        if (const auto seen = look_for(blocks[b].shape, i)) found[b].push_back(*seen);
      }
    });
    std::vector<SeenEmitter> all;
    for (const auto& block : found) all.insert(all.end(), block.begin(), block.end());
    return all;
  }

  /// Of the pixels of row `y`, of the emitters `seen` there.
  Row row(int y, const std::vector<SeenEmitter>& all, const std::vector<std::uint32_t>& seen) const {
    const PixelBounds& pixels = search_.pixels;
    std::vector<std::vector<InPixel>> found(static_cast<std::size_t>(pixels.width()));
    for (const std::uint32_t e : seen) {
      const auto image = image_of(world_, all[e].shape, all[e].primitive);
      const auto [begin, end] = columns_of(all[e].box);
      for (int x = begin; x < end; ++x) {
        const ConvexPolygon about = image->moved({-center(x), -center(y)});
        const double mass = about.covers(cells_.support()) ? 1 : cells_.mass(about);
        const bool hull = mass < 1 && is_curved(all[e]) && !cells_.support().holds(about.bounds());
        if (mass > 0) found[static_cast<std::size_t>(x - pixels.x0)].push_back({e, static_cast<float>(mass), hull});
      }
    }
    Row row;
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      const std::size_t before = row.emitters.size();
      row.positions.push_back(
          choose({center(x), center(y)}, all, found[static_cast<std::size_t>(x - pixels.x0)], row.emitters));
      row.counts.push_back(static_cast<std::uint32_t>(row.emitters.size() - before));
    }
    return row;
  }

  const FilterCells& cells() const { return cells_; }

  struct Range {
    int begin, end;
  };
  /// Pixels whose filters see a part of a box, within those that are rendered.
  Range columns_of(const Rectangle& box) const {
    return range(box.min.x + cells_.support().min.x, box.max.x + cells_.support().max.x, search_.pixels.x0, search_.pixels.x1);
  }
  Range rows_of(const Rectangle& box) const {
    return range(box.min.y + cells_.support().min.y, box.max.y + cells_.support().max.y, search_.pixels.y0, search_.pixels.y1);
  }

 private:
  bool is_curved(const SeenEmitter& emitter) const {
    return !std::holds_alternative<TriangleMesh>(world_.geometry.placed()[emitter.shape].shape->kind);
  }
  static double center(int pixel) { return pixel + 0.5; }
  static Range range(double from, double to, int least, int most) {
    const double first = std::clamp<double>(std::ceil(from - 0.5), least, most),
                 last = std::clamp<double>(std::floor(to - 0.5) + 1, least, most);
    return {static_cast<int>(first), static_cast<int>(last)};
  }

  std::optional<SeenEmitter> look_for(std::uint32_t shape, std::uint32_t primitive) const {
    const LightId light = world_.first_light[shape] + primitive;
    const auto image = image_of(world_, shape, primitive);
    if (!image || image->empty()) return std::nullopt;
    const Rectangle box = image->bounds();
    const auto [left, right] = columns_of(box);
    const auto [top, bottom] = rows_of(box);
    if (left >= right || top >= bottom) return std::nullopt;
    const auto place = world_.lights.place(light);
    if (!place.center) return std::nullopt;
    const auto sample = world_.lights.sample(light, world_.camera.eye_of(*place.center), {0.5f, 0.5f}, false);
    if (!sample || sample->delta || is_black(sample->L)) return std::nullopt;
    return SeenEmitter{shape, primitive, box, mean(sample->L)};
  }

  /// Adds what the pixel draws to `chosen`; how many film positions it draws there.
  std::uint8_t choose(Point2 center, const std::vector<SeenEmitter>& all, const std::vector<InPixel>& found,
                      std::vector<FilmEmitter>& chosen) const {
    double covered = 0;
    for (const InPixel& f : found) covered += f.mass;
    if (found.empty() || (covered >= 1 && looks_even(center, found.size() == 1 ? kLooksAtOne : kLooksAtMany))) return 0;
    const std::size_t before = chosen.size();
    bool some = false, partly = false;
    double sum = 0;
    for (const InPixel& f : found) {
      const SeenEmitter& emitter = all[f.emitter];
      const Looks looks = look_at(center, emitter, std::max<std::size_t>(kLooks / found.size(), 1));
      some |= looks.met > 0;
      partly |= looks.partly() || (looks.met > 0 && f.hull);  // few looks do not tell of a narrow rest
      chosen.push_back({emitter.shape, emitter.primitive, emitter.brightness * f.mass * looks.weight()});
      sum += chosen.back().share;
    }
    if (!some || !(sum > 0 && sum < kInfinity)) {
      chosen.resize(before);
      return 0;
    }
    for (std::size_t i = before; i < chosen.size(); ++i) chosen[i].share = static_cast<float>(chosen[i].share / sum);
    return partly ? kPositions : 1;
  }

  Ray ray_through(Point2 film) const { return world_.camera.ray_through(film); }

  /// At an emitter's image in the pixel.
  Looks look_at(Point2 center, const SeenEmitter& emitter, std::size_t count) const {
    const ConvexPolygon image = image_of(world_, emitter.shape, emitter.primitive)->moved({-center.x, -center.y});
    const LightId light = world_.first_light[emitter.shape] + emitter.primitive;
    Looks looks{count, 0};
    for (std::size_t i = 0; i < count; ++i) {
      const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(count),
                  across = 0.5f + 0.618034f * static_cast<float>(i);
      const auto place = cells_.sample(image, {along, across - std::floor(across)});
      const Ray ray = ray_through({center.x + place.at.x, center.y + place.at.y});
      const auto seen = place.pdf > 0 ? directly_visible(world_, ray) : std::nullopt;
      looks.met += seen && seen->light == light && attenuated_roughly(world_, ray, *seen) > 0;
    }
    return looks;
  }

  /// Whether places spread over the filter are about as bright.
  bool looks_even(Point2 center, int looks) const {
    float least = kInfinity, most = 0;
    const auto place = [&](int i) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(looks); };
    for (int i = 0; i < looks * looks; ++i) {
      const Vec2 offset = world_.filter.sample({place(i % looks), place(i / looks)}).p;
      const Ray ray = ray_through({center.x + offset.x, center.y + offset.y});
      const auto seen = directly_visible(world_, ray);
      const float brightness = seen ? mean(seen->L) * attenuated_roughly(world_, ray, *seen) : 0.0f;
      least = std::min(least, brightness);
      most = std::max(most, brightness);
    }
    return most - least <= kLeastContrast * most;
  }

  const FilmSearch& search_;
  const BuiltWorld& world_;
  FilterCells cells_;
};

}  // namespace

std::optional<ConvexPolygon> image_of(const BuiltWorld& world, std::uint32_t shape, std::uint32_t primitive) {
  // Wider than what rays through the film are rounded by: those that miss for it are made up for by those that hit.
  const double margin = world.camera.film_rounding();
  SmallVector<Point2, 64> corners;
  for (const Vec3d& p : world.geometry.outline(shape, primitive, world.camera.view())) {
    const auto at = world.camera.image_of(p);
    if (!at) return std::nullopt;
    for (const double dx : {-margin, margin}) {
      for (const double dy : {-margin, margin}) corners.push_back({at->x + dx, at->y + dy});
    }
  }
  return ConvexPolygon::hull({corners.data(), corners.size()});
}

bool PixelEmitters::hold(const BuiltWorld& world, LightId light) const {
  return std::any_of(emitters.begin(), emitters.end(), [&](const FilmEmitter& e) { return e.light(world) == light; });
}

const FilmEmitter& PixelEmitters::draw(float& u) const {
  const FilmEmitter* chosen = &emitters.front();
  float left = u;
  while (left >= chosen->share && chosen != &emitters.back()) left -= (chosen++)->share;
  u = std::clamp(left / chosen->share, 0.0f, kOneMinusEpsilon);
  return *chosen;
}

FilmEmitters::FilmEmitters(const FilmSearch& search) {
  if (!is_wanted(search.world, search.settings)) return;
  const Search in(search);
  const std::vector<SeenEmitter> all = in.all();
  if (all.empty() || all.size() > kMostSeen) return;
  const auto height = static_cast<std::size_t>(search.pixels.height());
  std::vector<std::vector<std::uint32_t>> seen(height);
  for (std::uint32_t e = 0; e < all.size(); ++e) {
    const auto [top, bottom] = in.rows_of(all[e].box);
    for (int y = top; y < bottom; ++y) seen[static_cast<std::size_t>(y - search.pixels.y0)].push_back(e);
  }
  std::vector<Row> rows(height);
  search.pool.for_each(height, 1, [&](std::size_t i) {
    search.alive();
    rows[i] = in.row(search.pixels.y0 + static_cast<int>(i), all, seen[i]);
  });
  pixels_ = search.pixels;
  cells_ = in.cells();
  begin_.push_back(0);
  for (const Row& row : rows) {
    emitters_.insert(emitters_.end(), row.emitters.begin(), row.emitters.end());
    positions_.insert(positions_.end(), row.positions.begin(), row.positions.end());
    for (const std::uint32_t count : row.counts) begin_.push_back(begin_.back() + count);
  }
}

PixelEmitters FilmEmitters::of(int x, int y) const {
  if (begin_.empty()) return {};
  const std::size_t pixel = pixels_.index(x, y);
  return {std::span(emitters_).subspan(begin_[pixel], begin_[pixel + 1] - begin_[pixel]), positions_[pixel], &*cells_};
}

}  // namespace tyndall
