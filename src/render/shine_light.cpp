#include "render/shine_light.h"

#include <algorithm>
#include <cmath>

#include "math/similarity.h"
#include "render/direct_light.h"
#include "render/fire_light.h"

namespace tyndall {
namespace {

constexpr std::size_t kBlock = 4096;  ///< of lights, for one thread
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
  const auto at = world.camera.film_position(*place.center);
  const float distance = length(*place.center - world.camera.center());
  if (!at || !(distance > kNearest * place.radius)) return std::nullopt;
  const float pixels_a_radian = 1 / std::sqrt(world.camera.solid_angle(*at));
  return FilmShine::Spot{.light = light,
                         .at = *at,
                         .radius = place.radius / distance * pixels_a_radian,
                         .brightness = static_cast<float>(world.lights.power(light)) / (distance * distance)};
}

/// 1/pixels^2, of position `at` by aiming with that density, 1/sr.
float film_pdf(const World::Parts& world, float pdf, Vec2 at) { return pdf * world.camera.solid_angle(at); }

}  // namespace

FilmShine film_shine(const World::Parts& world, const RenderSettings& settings, const PixelBounds& pixels, ThreadPool& pool) {
  if (!is_wanted(world, settings)) return {};
  const FilmShine::View view{pixels, world.scene.filter.radius};
  const std::size_t count = world.lights.unshared();
  std::vector<std::vector<FilmShine::Spot>> blocks((count + kBlock - 1) / kBlock);
  pool.for_each(blocks.size(), 1, [&](std::size_t block) {
    for (std::size_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
      const auto spot = spot_of(world, static_cast<LightId>(i));
      if (spot && view.wants(*spot)) blocks[block].push_back(*spot);
    }
  });
  std::vector<FilmShine::Spot> spots;
  for (const auto& block : blocks) spots.insert(spots.end(), block.begin(), block.end());
  return {view, spots};
}

Rgb shine_light(const LightContext& context, const PixelShine& shine, Vec2 center, Sampler sampler) {
  const World::Parts& world = context.world;
  const Vec3 eye = world.camera.center();
  const auto [id, chance] = shine.draw(sampler.next_1d());
  const auto light = world.lights.sample(id, eye, sampler.next_2d(), false);
  if (!light || light->delta || is_black(light->L)) return {};
  const auto at = world.camera.film_position(eye + light->wi * light->distance);
  if (!at) return {};
  const auto filter = world.filter.at({at->x - center.x, at->y - center.y});
  const float pdf = film_pdf(world, chance * light->pdf, *at);
  if (!(filter.pdf > 0) || !(pdf > 0)) return {};
  const float share = mis_weight(pdf, filter.pdf);
  return light->L * arriving(context, world.camera_media, eye, *light, sampler) * (filter.weight * filter.pdf / pdf * share);
}

float ShineRay::own_share(const World::Parts& world, LightId light, const EmitterHit& hit) const {
  const float chance = shine_.chance(light);
  if (!(chance > 0)) return 1;
  const auto at = world.camera.film_position(hit.p);
  return at ? mis_weight(pdf_, film_pdf(world, chance * world.lights.pdf(light, world.camera.center(), hit), *at)) : 1.0f;
}

}  // namespace tyndall
