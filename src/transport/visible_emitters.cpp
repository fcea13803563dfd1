#include "transport/visible_emitters.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/similarity.h"
#include "transport/direct_light.h"
#include "transport/gather_lights.h"
#include "transport/grouped_light.h"
#include "transport/seen_light.h"

namespace tyndall {
namespace {

/// In the picture. More would take seconds to process, and are triangles of larger things rather than bulbs.
constexpr std::size_t kMostSpots = 1'000'000;
/// Places along each side of a filter's support where emitters of about a pixel are looked for.
constexpr int kLooks = 4;
/// A camera this near to an emitter, in its radii, may be inside it.
constexpr float kNearest = 2;

/// Film positions a sample where the outline of a surface is (docs/measurements.md).
constexpr int kPositions = 13;
/// Of a Fibonacci lattice of that many points: spread evenly in the square and along both of its sides.
constexpr int kLatticeStep = 8;

/// Not where the film clamps samples: a mean over several, or the share of an aimed ray, would be clamped less.
bool is_wanted(const BuiltWorld& world, const RenderSettings& settings) {
  if (world.scene.film.max_component < kInfinity) return false;
  const bool asked = settings.joint == JointStrategy::points && settings.lights != LightStrategy::exhaustive;
  return asked && world.lights.stats().emitters > 0 && world.camera.is_pinhole();
}

/// `light` as the camera sees it.
std::optional<FilmEmitters::Spot> spot_of(const BuiltWorld& world, LightId light) {
  const LightPlace place = world.lights.place(light);
  if (!place.center || !(place.radius > 0) || place.opening) return std::nullopt;
  // Of a two-sided emitter a direction may be drawn by points in front and behind, and its density is known of one.
  if (place.two_sided && !place.flat()) return std::nullopt;
  const auto at = world.camera.film_position(*place.center);
  const float distance = length(*place.center - world.camera.center());
  if (!at || !(distance > kNearest * place.radius)) return std::nullopt;
  const float facing = place.flat() ? dot(place.normal, world.camera.center() - *place.center) / distance : 1.0f;
  const float pixels_a_radian = 1 / std::sqrt(world.camera.solid_angle(*at));
  return FilmEmitters::Spot{.light = light,
                            .at = *at,
                            .radius = place.radius / distance * pixels_a_radian,
                            .brightness = static_cast<float>(world.lights.power(light)) / (distance * distance) *
                                          (place.two_sided ? std::abs(facing) : std::max(facing, 0.0f))};
}

/// 1/pixels^2, of hitting `light` at `hit` by aiming at one of `aims`; 0 for those that are not among them.
float aimed_pdf(const BuiltWorld& world, const PixelEmitters& aims, LightId light, const EmitterHit& hit) {
  const FilmEmitter* aimed_at = aims.find(light);
  const auto at = aimed_at ? world.camera.film_position(hit.p) : std::nullopt;
  if (!at) return 0;
  return aimed_at->brightness * world.lights.pdf(light, world.camera.center(), hit) * world.camera.solid_angle(*at);
}

/// Of one pixel's sample.
class EmitterEstimate {
 public:
  EmitterEstimate(const LightContext& context, const EmitterView& view, Vec2 center)
      : context_(context), view_(view), center_(center), positions_(view.edge ? kPositions : 1) {}

  /// By the ray to a point of one of the aims.
  Rgb by_aiming(Sampler& sampler) const {
    const BuiltWorld& world = context_.world;
    const Vec3 eye = world.camera.center();
    const LightId light = view_.aims.draw(sampler.next_1d()).light;
    const auto drawn = world.lights.sample(light, eye, sampler.next_2d(), false);
    if (!drawn || drawn->delta || is_black(drawn->L)) return {};
    const Ray ray{eye, drawn->wi};
    const auto seen = look_along(ray);
    if (!seen || seen->light != light) return {};
    const auto at = world.camera.film_position(seen->hit.p);
    if (!at) return {};
    const auto filter = world.filter.at({at->x - center_.x, at->y - center_.y});
    const float pdf = aimed_pdf(world, view_.aims, light, seen->hit);
    if (!(filter.pdf > 0) || !(pdf > 0)) return {};
    const float share = mis_weight(pdf, static_cast<float>(positions_) * filter.pdf);
    const Rgb light_found = seen->L * attenuated(context_, ray, *seen, sampler) * (filter.weight * filter.pdf / pdf * share);
    if (context_.groups) context_.groups->estimate(light, light_found);
    return light_found;
  }

  /// By film positions that the filter draws.
  Rgb by_positions(Sampler& sampler) const {
    const Vec2 shift = lattice_shift(sampler.next_2d());
    Rgb sum;
    for (int i = 0; i < positions_; ++i) sum += through(context_.world.filter.sample(lattice_point(i, shift)), sampler);
    return sum * (1 / static_cast<float>(positions_));
  }

 private:
  static float wrapped(float u) { return std::min(u - std::floor(u), kOneMinusEpsilon); }
  /// Within one cell of the lattice, between its two shortest vectors: so the lattices of all samples together are as even as
  /// the points that shift them. A single position is its own lattice.
  Vec2 lattice_shift(Vec2 u) const {
    if (positions_ == 1) return u;
    return {(2 * u.x + 3 * u.y) / kPositions, (3 * u.x - 2 * u.y) / kPositions};
  }
  Vec2 lattice_point(int i, Vec2 shift) const {
    const float spacing = 1 / static_cast<float>(positions_);
    const int row = i * kLatticeStep % positions_;
    return {wrapped(shift.x + static_cast<float>(i) * spacing), wrapped(shift.y + static_cast<float>(row) * spacing)};
  }

  Rgb through(const FilterSampler::Offset& offset, Sampler& sampler) const {
    const BuiltWorld& world = context_.world;
    const Ray ray = world.camera.ray({center_.x + offset.p.x, center_.y + offset.p.y}, {0.5f, 0.5f});
    const auto seen = look_along(ray);
    if (!seen) return {};
    const float aimed = aimed_pdf(world, view_.aims, seen->light, seen->hit);
    const Rgb light = seen->L * attenuated(context_, ray, *seen, sampler) *
                      (offset.weight * mis_weight(static_cast<float>(positions_) * offset.pdf, aimed));
    if (context_.groups) context_.groups->estimate(seen->light, light * (1 / static_cast<float>(positions_)));
    return light;
  }

  std::optional<SeenLight> look_along(const Ray& ray) const {
    ++context_.counters.rays;
    return seen_light(context_.world, ray);
  }

  const LightContext& context_;
  const EmitterView& view_;
  Vec2 center_;
  int positions_;
};

Vec2 center_of(int x, int y) { return {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}; }

/// Of directly visible emission.
float brightness_at(const BuiltWorld& world, Vec2 film) {
  const Ray ray = world.camera.ray(film, {0.5f, 0.5f});
  const auto seen = seen_light(world, ray);
  return seen ? mean(seen->L) * attenuated_roughly(world, ray, *seen) : 0.0f;
}

/// Of `looks` x `looks` places spread over the filter of the pixel at `center`.
Contrast contrast_of(const BuiltWorld& world, Vec2 center, int looks) {
  Contrast contrast;
  const auto place = [&](int i) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(looks); };
  for (int i = 0; i < looks * looks; ++i) {
    const Vec2 offset = world.filter.sample({place(i % looks), place(i / looks)}).p;
    const float brightness = brightness_at(world, {center.x + offset.x, center.y + offset.y});
    contrast.add({brightness, brightness});
  }
  return contrast;
}

/// Whether the pixel at `center` sees outlines of emitters at which it does not aim. Where a few looks meet nothing, large ones
/// are there all the same, for they were seen; a crowd may be behind something, so that it is looked for again.
bool sees_outline(const BuiltWorld& world, Vec2 center, FilmEmitters::Unaimed unaimed) {
  if (unaimed == FilmEmitters::Unaimed::none) return false;
  const Contrast contrast = contrast_of(world, center, kLooks);
  if (contrast.most > 0) return contrast.is_edge();
  return unaimed == FilmEmitters::Unaimed::large || contrast_of(world, center, 2 * kLooks).most > 0;
}

/// Whether the camera sees one of a few of its points.
bool is_seen(const BuiltWorld& world, LightId light) {
  const Vec3 eye = world.camera.center();
  for (const Vec2 u : {Vec2{0.25f, 0.25f}, Vec2{0.75f, 0.25f}, Vec2{0.25f, 0.75f}, Vec2{0.75f, 0.75f}}) {
    const auto drawn = world.lights.sample(light, eye, u, false);
    if (!drawn || drawn->delta) continue;
    const Ray ray{eye, drawn->wi};
    const auto seen = seen_light(world, ray);
    if (seen && seen->light == light && attenuated_roughly(world, ray, *seen) > 0) return true;
  }
  return false;
}

}  // namespace

FilmEmitters film_emitters(const FilmSearch& search) {
  const BuiltWorld& world = search.world;
  if (!is_wanted(world, search.settings) || !similarity_scale(world.camera.to_world().matrix())) return {};
  const FilmEmitters::View view{search.pixels, world.scene.filter.radius};
  const std::size_t count = world.lights.first_volume();  // before them are all that instances do not share
  const auto look = [&](LightId light) {
    const auto spot = spot_of(world, light);
    const bool wanted = spot && view.wants(*spot) && (view.aims_at(*spot) || is_seen(world, light));
    return wanted ? spot : std::nullopt;
  };
  const auto spots = gather_lights(count, search.pool, look);
  return spots.size() > kMostSpots ? FilmEmitters() : FilmEmitters(view, spots);
}

FilmEdges film_edges(const FilmSearch& search, const FilmEmitters& emitters) {
  const BuiltWorld& world = search.world;
  const FilmEdges::View view{search.pixels, world.scene.filter.radius};
  if (!is_wanted(world, search.settings) ||
      !(std::max(view.filter_radius.x, view.filter_radius.y) <= FilmEmitters::kWidestFilter))
    return {};
  const PixelBounds all = view.around();
  std::vector<float> brightness(all.size());
  search.pool.for_each(static_cast<std::size_t>(all.height()), 1, [&](std::size_t row) {
    search.alive();
    const int y = all.y0 + static_cast<int>(row);
    for (int x = all.x0; x < all.x1; ++x) brightness[all.index(x, y)] = brightness_at(world, center_of(x, y));
  });
  FilmEdges edges(view, brightness);
  std::vector<char> unaimed(view.pixels.size());
  search.pool.for_each(static_cast<std::size_t>(view.pixels.height()), 1, [&](std::size_t row) {
    search.alive();
    const int y = view.pixels.y0 + static_cast<int>(row);
    for (int x = view.pixels.x0; x < view.pixels.x1; ++x)
      unaimed[view.pixels.index(x, y)] = !edges.at(x, y) && sees_outline(world, center_of(x, y), emitters.unaimed(x, y));
  });
  edges.add(view, unaimed);
  return edges;
}

Rgb visible_emitters(const LightContext& context, const EmitterView& view, Vec2 center, Sampler sampler) {
  const EmitterEstimate estimate(context, view, center);
  Sampler aiming = sampler.fork(), looking = sampler.fork();
  Rgb sum;
  if (!view.aims.empty()) sum += estimate.by_aiming(aiming);
  if (view.edge) sum += estimate.by_positions(looking);
  return sum;
}

float EmitterRay::path_mis_weight(const BuiltWorld& world, LightId light, const EmitterHit& hit) const {
  return view_.edge ? 0.0f : mis_weight(pdf_, aimed_pdf(world, view_.aims, light, hit));
}

}  // namespace tyndall
