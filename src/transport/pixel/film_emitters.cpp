#include "transport/pixel/film_emitters.h"

#include <algorithm>
#include <cmath>

#include "transport/pixel/emitter_image.h"
#include "transport/pixel/emitter_looks.h"
#include "transport/pixel/fibonacci_lattice.h"

namespace tyndall {
namespace {

/// Film positions a sample where something else ends within an emitter's image: the light has an edge there, which a lens
/// smooths (docs/measurements.md).
constexpr std::uint8_t kPositions = FibonacciLattice::kMany, kPositionsBlurred = FibonacciLattice::kFew;
/// EmitterImage::lit() from which on images have edges.
constexpr double kSharp = 0.5;
/// Of emitters that a lens blurs, the brightest that a pixel lists.
constexpr std::size_t kMostOfPixel = 64;
/// Looks at the emitters of a pixel, to know of what hides them.
constexpr std::size_t kLooks = 8;
/// Emitters that fill a pixel: places along each side of the filter's support where they are looked at.
constexpr int kLooksAtOne = 2, kLooksAtMany = 4;
/// Pixels. Where rays are off by more, images would be mostly margin.
constexpr float kLargestRounding = 0.05f;

/// Not where the film limits samples: a mean over several would be limited less.
bool is_wanted(const BuiltWorld& world, const RenderSettings& settings) {
  if (world.scene.film.max_component < kInfinity || !world.camera.has_projection()) return false;
  if (!(world.camera.film_rounding() < kLargestRounding)) return false;
  return searches_film(settings) && is_narrow(world.scene.filter) && world.lights.stats().emitters > 0;
}

/// An emitter of the picture.
struct SeenEmitter {
  std::uint32_t shape, primitive;
  Rectangle box;     ///< of its image
  float brightness;  ///< radiance that it sends
  double lit;        ///< EmitterImage::lit()
};

/// What a pixel's filter sees.
struct InPixel {
  const SeenEmitter* emitter;
  const EmitterImage* image;
  float mass;  ///< of the filter, that its image covers
  bool hull;   ///< the polygon is but a hull of what ends there

  double light() const { return emitter->brightness * static_cast<double>(mass) * emitter->lit; }
};

/// Leaves the brightest.
void keep(std::size_t most, std::vector<InPixel>& found) {
  if (found.size() <= most) return;
  std::stable_sort(found.begin(), found.end(), [](const InPixel& a, const InPixel& b) { return a.light() > b.light(); });
  found.resize(most);
}

/// What the pixels of one row draw, one after the other.
struct Row {
  std::vector<FilmEmitter> emitters;
  std::vector<std::uint32_t> counts;
  std::vector<std::uint8_t> positions;
};

class Search {
 public:
  explicit Search(const FilmSearch& search)
      : search_(search), world_(search.world), cells_(search.world.filter), looks_(search.world, cells_) {}

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
    std::vector<EmitterImage> images;
    images.reserve(seen.size());  // pixels refer to them
    for (const std::uint32_t e : seen) {
      const EmitterImage& image = images.emplace_back(*EmitterImage::of(world_, all[e].shape, all[e].primitive));
      const auto [begin, end] = columns_of(all[e].box);
      for (int x = begin; x < end; ++x) {
        const ConvexPolygon about = image.on_film().moved({-center(x), -center(y)});
        const double mass = about.covers(cells_.support()) ? 1 : cells_.mass(about);
        const bool hull = mass < 1 && is_curved(all[e]) && !cells_.support().holds(about.bounds());
        if (mass > 0)
          found[static_cast<std::size_t>(x - pixels.x0)].push_back({&all[e], &image, static_cast<float>(mass), hull});
      }
    }
    Row row;
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      const std::size_t before = row.emitters.size();
      std::vector<InPixel>& of_pixel = found[static_cast<std::size_t>(x - pixels.x0)];
      if (!world_.camera.is_sharp()) keep(kMostOfPixel, of_pixel);
      row.positions.push_back(choose({center(x), center(y)}, of_pixel, row.emitters));
      row.counts.push_back(static_cast<std::uint32_t>(row.emitters.size() - before));
    }
    return row;
  }

  const FilterCells& cells() const { return cells_; }

  double pixels_of_frame() const {
    return static_cast<double>(world_.scene.film.width) * static_cast<double>(world_.scene.film.height);
  }
  /// Of the frame, whose filters see a part of a box.
  double pixels_of(const Rectangle& box) const {
    const Rectangle& support = cells_.support();
    const Film& film = world_.scene.film;
    const auto [left, right] = range(box.min.x + support.min.x, box.max.x + support.max.x, 0, film.width);
    const auto [top, bottom] = range(box.min.y + support.min.y, box.max.y + support.max.y, 0, film.height);
    return std::max(right - left, 0) * static_cast<double>(std::max(bottom - top, 0));
  }

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
    const auto image = EmitterImage::of(world_, shape, primitive);
    if (!image || image->on_film().empty()) return std::nullopt;
    const Rectangle box = image->on_film().bounds();
    if (pixels_of(box) == 0) return std::nullopt;
    const auto place = world_.lights.place(light);
    if (!place.center) return std::nullopt;
    const auto sample = world_.lights.sample(light, world_.camera.eye_of(*place.center), {0.5f, 0.5f});
    if (!sample || sample->delta || is_black(sample->L)) return std::nullopt;
    return SeenEmitter{shape, primitive, box, mean(sample->L), image->lit()};
  }

  /// Adds what the pixel draws to `chosen`; how many film positions it draws there.
  std::uint8_t choose(Point2 center, const std::vector<InPixel>& found, std::vector<FilmEmitter>& chosen) const {
    double covered = 0;
    for (const InPixel& f : found) covered += static_cast<double>(f.mass) * f.emitter->lit;
    if (found.empty() || (covered >= 1 && looks_.even(center, found.size() == 1 ? kLooksAtOne : kLooksAtMany))) return 0;
    const std::size_t before = chosen.size();
    bool some = false, partly = false, sharp = false;
    double sum = 0, by_filter = 0;
    SmallVector<float, 64> least;
    for (const InPixel& f : found) {
      const EmitterLooks::Met looks = looks_.at(center, *f.image, std::max<std::size_t>(kLooks / found.size(), 1));
      some |= looks.met > 0;
      // Few looks do not tell of a narrow rest, nor of what the lens blurs that none of them met.
      const bool in_part = looks.partly() || (looks.met > 0 ? f.hull : f.emitter->lit < 1);
      partly |= in_part;
      sharp |= in_part && f.emitter->lit > kSharp;
      // Of the lens, what is seen in this pixel, which few looks tell roughly, and on average over all of the image.
      const auto through = static_cast<float>((looks.through + f.emitter->lit) / 2);
      chosen.push_back({f.emitter->shape, f.emitter->primitive, f.emitter->brightness * f.mass * through * looks.weight()});
      sum += chosen.back().share;
      least.push_back(f.emitter->lit < 1 ? f.mass * static_cast<float>(looks.through) : 0.0f);
      by_filter += least.back();
    }
    if (!some || !(sum > 0 && sum < kInfinity)) {
      chosen.resize(before);
      return 0;
    }
    const std::uint8_t positions = sharp ? kPositions : partly ? kPositionsBlurred : 1;
    // Looks tell little of what a lens blurs: half of the draws at most see to it that none of it is met less than by the
    // filter.
    const double defence = std::min(1.0 / positions, by_filter > 0 ? 0.5 / by_filter : 0.0);
    for (std::size_t i = 0; i < found.size(); ++i) {
      float& share = chosen[before + i].share;
      share = static_cast<float>((1 - defence * by_filter) * share / sum + defence * least[i]);
    }
    return positions;
  }

  const FilmSearch& search_;
  const BuiltWorld& world_;
  FilterCells cells_;
  EmitterLooks looks_;
};

/// Leaves as many as may be listed. Hit or missed, an emitter adds the square of its radiance times the area of its image to
/// the variance of all pixels, however they are spread.
void leave_dimmest(std::vector<SeenEmitter>& all, const Search& search) {
  struct Worth {
    double noise, pixels;  ///< noise: for each of the pixels
    std::size_t emitter;
  };
  std::vector<Worth> worth;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Rectangle& box = all[i].box;
    const double area = (box.max.x - box.min.x) * (box.max.y - box.min.y) * all[i].lit, pixels = search.pixels_of(box);
    worth.push_back({double{all[i].brightness} * all[i].brightness * area / pixels, pixels, i});
  }
  std::stable_sort(worth.begin(), worth.end(), [](const Worth& a, const Worth& b) { return a.noise > b.noise; });
  double left = FilmEmitters::kMostBlurred * search.pixels_of_frame();
  std::vector<std::uint8_t> kept(all.size(), 0);
  for (const Worth& w : worth) {
    if (w.pixels > left) continue;
    left -= w.pixels;
    kept[w.emitter] = 1;
  }
  std::vector<SeenEmitter> rest;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (kept[i]) rest.push_back(all[i]);
  }
  all = std::move(rest);
}

}  // namespace

bool DrawnEmission::holds(const BuiltWorld& world, LightId light) const {
  return std::any_of(emitters_.emitters.begin(), emitters_.emitters.end(), [&](const FilmEmitter& e) {
    if (e.light(world) != light) return false;
    const auto image = EmitterImage::of(world, e.shape, e.primitive);
    return image && image->holds({film_.x, film_.y}, {lens_.x, lens_.y});
  });
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
  std::vector<SeenEmitter> all = in.all();
  if (all.empty() || all.size() > kMostSeen) return;
  if (!search.world.camera.is_sharp()) leave_dimmest(all, in);
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
