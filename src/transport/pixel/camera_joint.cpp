#include "transport/pixel/camera_joint.h"

#include <algorithm>
#include <cmath>

#include "transport/media/scattering.h"
#include "transport/pixel/directly_visible.h"
#include "transport/sample/deep_sample.h"
#include "transport/sample/grouped_light.h"
#include "transport/techniques/joint.h"
#include "transport/techniques/point_aim.h"
#include "volume/coarse.h"

namespace tyndall {
namespace {

bool is_wanted(const BuiltWorld& world, const RenderSettings& settings) {
  return searches_film(settings) && settings.max_depth > 0 && world.has_media() && world.camera.is_pinhole();
}

/// A medium, and a box that encloses it.
struct Place {
  const ParticipatingMedium* medium;
  Bounds3 box;
};
std::vector<Place> places_with_points(const BuiltWorld& world) {
  std::vector<Place> places;
  for (MediumId id = 0; id < world.media.size(); ++id) {
    const Bounds3 box = reach_of(id, world.geometry.groups(), world.camera_media.unbounded());
    if (!overlap(box, world.lights.point_box()).empty()) places.push_back({&world.media[id], box});
  }
  return places;
}

/// Media around a light, and their optical depth.
struct Surroundings {
  ActiveMedia media;
  float depth = 0;  ///< optical depth of these media toward the camera
};
Surroundings around(const std::vector<Place>& places, const Ray& ray, float distance) {
  Surroundings found;
  for (const Place& place : places) {
    if (!place.box.contains(ray.at(distance))) continue;
    found.media.push_back(place.medium);
    const float enters = std::max(distance - exit_distance(place.box, {ray.at(distance), -ray.d}), 0.0f);
    found.depth += coarse_optical_depth({&place.medium, 1}, ray, enters, distance);
  }
  return found;
}

/// `light` as the camera sees it: what media around it scatter to the camera, coarsely, over the footprint of a pixel.
std::optional<FilmPoint> film_point(const BuiltWorld& world, const std::vector<Place>& places, LightId light, Vec2 at) {
  const Vec3 point = *world.lights.point(light), to_point = point - world.camera.center();
  const float distance = length(to_point);
  const Ray ray{world.camera.center(), to_point * (1 / distance)};
  const auto [media, depth] = around(places, ray, distance);
  if (media.empty() || !(depth < kDeepestSeen)) return std::nullopt;
  const float sigma_s = CoarseRay({media.data(), media.size()}, ray).at(distance).sigma_s;
  const auto power = static_cast<float>(world.lights.power(light));
  return FilmPoint{.light = light,
                   .at = at,
                   .brightness = power * sigma_s * std::exp(-depth) / world.camera.depth(point),
                   .g = Scattering::at(media, point).phase.mean_cosine()};
}

}  // namespace

FilmPoints film_points(const FilmSearch& search) {
  const BuiltWorld& world = search.world;
  const FilmPoints::View view{search.pixels, world.scene.filter.radius, world.camera.film_rounding()};
  const auto places = is_wanted(world, search.settings) ? places_with_points(world) : std::vector<Place>();
  if (places.empty()) return {view, {}};
  return {view, find_of_lights<FilmPoint>(search, [&](LightId light, std::vector<FilmPoint>& points) {
            const auto p = world.lights.point(light);
            const auto at = p ? world.camera.film_position(*p) : std::nullopt;
            if (!at || !view.sees(*at)) return;
            if (const auto found = film_point(world, places, light, *at)) points.push_back(*found);
          })};
}

Rgb camera_joint_estimate(const LightContext& context, const PixelPoints& points, Vec2 center, Sampler sampler) {
  const float which = sampler.next_1d();
  const Vec2 around = sampler.next_2d();
  const float along = sampler.next_1d();
  const BuiltWorld& world = context.world;
  const auto drawn = points.draw(which, around);
  const auto filter = world.filter.at({drawn.x.x - center.x, drawn.x.y - center.y});
  if (!(drawn.pdf > 0) || !(filter.pdf > 0)) return {};
  const Ray ray = world.camera.ray(drawn.x, {0.5f, 0.5f});
  const Vec3 to_point = *world.lights.point(drawn.light) - ray.o;
  const PassingPlace place = pass_point(dot(to_point, ray.d), length(cross(to_point, ray.d)), drawn.g, along);
  if (!(place.t > 0 && place.t < kInfinity && place.spread < kInfinity)) return {};
  const float share = mis_weight(drawn.pdf, filter.pdf);
  const Rgb light = in_scattered(context, {world.camera_media, ray, place.t}, drawn.light, sampler) *
                    (filter.weight * filter.pdf / drawn.pdf * place.spread * share);
  if (context.groups) context.groups->estimate(drawn.light, light);
  if (context.deep) context.deep->scattered_at(world.camera.depth(ray.at(place.t)), light);
  return light;
}

float CameraJointWeight::path_mis_weight(const LightContext&, LightId light) const {
  return mis_weight(pdf_, points_.pdf(light, x_));
}

}  // namespace tyndall
