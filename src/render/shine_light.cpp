#include "render/shine_light.h"

#include <algorithm>
#include <cmath>

#include "math/similarity.h"
#include "render/direct_light.h"
#include "render/gather_lights.h"
#include "render/span_walk.h"

namespace tyndall {
namespace {

/// In the picture. More would take seconds to look through, and are triangles of larger things rather than bulbs.
constexpr std::size_t kMostSpots = 1'000'000;
/// A camera this near to a lamp, in its radii, may be inside it.
constexpr float kNearest = 2;

bool is_wanted(const World::Parts& world, const RenderSettings& settings) {
  const bool seen_by_pinhole = world.camera.is_pinhole() && similarity_scale(world.camera.to_world().matrix());
  const bool asked = settings.joint == JointStrategy::points && settings.lights != LightStrategy::exhaustive;
  return asked && world.lights.stats().emitters > 0 && seen_by_pinhole;
}

/// `light` as the camera sees it.
std::optional<FilmShine::Spot> spot_of(const World::Parts& world, LightId light) {
  const LightPlace place = world.lights.place(light);
  if (!place.center || !(place.radius > 0)) return std::nullopt;
  // Of what shines on both sides a direction may be drawn by points in front and behind, and its density is known of one.
  if (place.two_sided && !place.flat()) return std::nullopt;
  const auto at = world.camera.film_position(*place.center);
  const float distance = length(*place.center - world.camera.center());
  if (!at || !(distance > kNearest * place.radius)) return std::nullopt;
  const float facing = place.flat() ? dot(place.normal, world.camera.center() - *place.center) / distance : 1.0f;
  const float pixels_a_radian = 1 / std::sqrt(world.camera.solid_angle(*at));
  return FilmShine::Spot{.light = light,
                         .at = *at,
                         .radius = place.radius / distance * pixels_a_radian,
                         .brightness = static_cast<float>(world.lights.power(light)) / (distance * distance) *
                                       (place.two_sided ? std::abs(facing) : std::max(facing, 0.0f))};
}

/// 1/pixels^2, of position `at` by aiming with that density, 1/sr.
float film_pdf(const World::Parts& world, float pdf, Vec2 at) { return pdf * world.camera.solid_angle(at); }

Rgb transmittance_to(const LightContext& context, const Ray& ray, const Trace& trace, Sampler& sampler) {
  const World::Parts& world = context.world;
  if (!world.has_media()) return Rgb(1.0f);
  Rng rng = sampler.stream();
  SpanWalk walk(world.media_context(), world.camera_media, trace.crossings, trace.t_end);
  const Rgb T = transmittance_along(context, walk, ray, rng);
  context.counters.parity_errors += walk.parity_errors();
  return T;
}

}  // namespace

FilmShine film_shine(const World::Parts& world, const RenderSettings& settings, const PixelBounds& pixels, ThreadPool& pool) {
  if (!is_wanted(world, settings)) return {};
  const FilmShine::View view{pixels, world.scene.filter.radius};
  const std::size_t count = world.lights.first_volume();  // before them are all that instances do not share
  const auto look = [&](LightId light) {
    const auto spot = spot_of(world, light);
    return spot && view.wants(*spot) ? spot : std::nullopt;
  };
  const auto spots = gather_lights(count, pool, look);
  return spots.size() > kMostSpots ? FilmShine() : FilmShine(view, spots);
}

Rgb shine_light(const LightContext& context, const PixelShine& shine, Vec2 center, Sampler sampler) {
  const World::Parts& world = context.world;
  const Vec3 eye = world.camera.center();
  const auto& [id, chance] = shine.draw(sampler.next_1d());
  const auto drawn = world.lights.sample(id, eye, sampler.next_2d(), false);
  if (!drawn || drawn->delta || is_black(drawn->L)) return {};
  // Traced as the filter's own ray is, and no shadow ray, which ends before the light: what is as close to it as the glass
  // of a bulb far off hides it.
  const Ray ray{eye, drawn->wi};
  ++context.counters.shadow_rays;
  const Trace trace = world.geometry.trace(ray, 0, kInfinity);
  if (!trace.hit || world.light_of(*trace.hit) != id) return {};
  const EmitterHit hit{.p = trace.hit->p, .ng = trace.hit->ng, .uv = trace.hit->uv, .distance = trace.hit->t};
  const auto at = world.camera.film_position(hit.p);
  if (!at) return {};
  const auto filter = world.filter.at({at->x - center.x, at->y - center.y});
  const float pdf = film_pdf(world, chance * world.lights.pdf(id, eye, hit), *at);
  if (!(filter.pdf > 0) || !(pdf > 0)) return {};
  const float share = mis_weight(pdf, filter.pdf);
  return world.lights.emitted(id, hit, -ray.d) * transmittance_to(context, ray, trace, sampler) *
         (filter.weight * filter.pdf / pdf * share);
}

float ShineRay::own_share(const World::Parts& world, LightId light, const EmitterHit& hit) const {
  const ShiningLight* aimed_at = shine_.find(light);
  if (!aimed_at) return 1;
  const auto at = world.camera.film_position(hit.p);
  if (!at) return 1;
  const float aimed = aimed_at->brightness * world.lights.pdf(light, world.camera.center(), hit);
  return mis_weight(pdf_, film_pdf(world, aimed, *at));
}

}  // namespace tyndall
