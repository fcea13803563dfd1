#include "transport/pixel/camera_peaks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/frame.h"
#include "transport/sample/deep_sample.h"
#include "transport/sample/grouped_light.h"
#include "transport/techniques/shadow_ray.h"
#include "transport/vertex/surface_vertex.h"

namespace tyndall {
namespace {

/// Heights in steps of a pixel, the longer of the two, from which on the filter's samples tell the light with little noise.
constexpr float kHighest = 0.7f;
/// How many times as long as wide what a pixel sees of a surface may be: what is seen at a more grazing angle is not sought.
constexpr float kLongest = 8;
/// Pixels beyond the picture from where a light may reach into it.
constexpr float kBeyond = 16;
/// Cosine between normals from which on planes below one light are the same.
constexpr float kSamePlane = 0.999f;

bool is_wanted(const BuiltWorld& world, const RenderSettings& settings) {
  return searches_film(settings) && settings.max_depth > 0 && world.camera.is_sharp() && is_narrow(world.scene.filter);
}

/// A light's foot on a plane.
struct Foot {
  Vec3 p, n;  ///< n: unit, toward the light
  float height;
};

/// Seeks what lights stand close to.
class PeakFinder {
 public:
  explicit PeakFinder(const BuiltWorld& world) : world_(world) {}

  void find(LightId light, std::vector<Peak>& peaks) const {
    const auto p = world_.lights.point(light);
    const auto at = p && world_.lights.power(light) > 0 ? world_.camera.film_position(*p) : std::nullopt;
    if (!at || !is_near_picture(*at)) return;
    const float farthest = reach(*p);
    if (!(farthest < kInfinity)) return;  // it is where the camera is
    SmallVector<Foot, 6> feet;
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      for (const Vec3 w : {axis, -axis}) {
        if (!world_.geometry.occluded({*p, w}, 0, farthest)) continue;
        if (const auto foot = foot_along({*p, w}, farthest); foot && is_new(*foot, feet)) feet.push_back(*foot);
      }
    }
    for (const Foot& foot : feet) {
      if (const auto peak = seen(foot, light)) peaks.push_back(*peak);
    }
  }

 private:
  /// In the whole frame, so that a crop has the same.
  bool is_near_picture(Vec2 at) const {
    const Film& film = world_.scene.film;
    return std::min(at.x, at.y) > -kBeyond && at.x < static_cast<float>(film.width) + kBeyond &&
           at.y < static_cast<float>(film.height) + kBeyond;
  }

  static float longer(const std::array<Vec3, 2>& steps) { return std::max(length(steps[0]), length(steps[1])); }

  /// How far away a surface is to be found: of six rays along the axes one meets a plane of height h within sqrt(3) h.
  float reach(Vec3 p) const {
    return std::sqrt(3.0f) * kHighest * kLongest * longer(world_.camera.pixel_steps(p, normalize(world_.camera.eye_of(p) - p)));
  }

  std::optional<Foot> foot_along(const Ray& ray, float farthest) const {
    const Trace trace = world_.geometry.trace(ray, 0, farthest);
    if (!trace.hit) return std::nullopt;
    const Vec3 n = face_forward(trace.hit->ng, -ray.d);
    const float height = dot(ray.o - trace.hit->p, n);
    if (!(height > trace.hit->position_error)) return std::nullopt;
    return Foot{ray.o - n * height, n, height};
  }

  static bool is_new(const Foot& foot, const SmallVector<Foot, 6>& feet) {
    return std::none_of(feet.begin(), feet.end(), [&](const Foot& other) { return dot(foot.n, other.n) > kSamePlane; });
  }

  std::optional<Peak> seen(const Foot& foot, LightId light) const {
    const Vec3 eye = world_.camera.eye_of(foot.p);
    const auto steps = world_.camera.pixel_steps(foot.p, foot.n);
    const auto at = world_.camera.film_position(foot.p);
    if (!at || !(dot(foot.n, eye - foot.p) > 0) || !(foot.height < kHighest * longer(steps))) return std::nullopt;
    if (world_.geometry.occluded({eye, foot.p - eye}, 0, kShadowEnd)) return std::nullopt;
    const Frame plane = Frame::around(foot.n);
    const auto on_plane = [&](Vec3 v) { return Vec2{dot(v, plane.x), dot(v, plane.y)}; };
    // Below what film positions resolve the peak is as wide as that.
    const float finest = world_.camera.film_rounding() * longer(steps);
    const Peak peak{.light = light,
                    .at = *at,
                    .right = on_plane(steps[0]),
                    .down = on_plane(steps[1]),
                    .height = std::max(foot.height, finest),
                    .brightness = static_cast<float>(world_.lights.power(light))};
    return peak.pdf(peak.at) > 0 && peak.pdf(peak.at) < kInfinity ? std::optional(peak) : std::nullopt;
  }

  const BuiltWorld& world_;
};

/// Where a ray of the camera ends, and what of the light there comes through.
struct Seen {
  Vertex vertex;
  Rgb transmittance;
};
std::optional<Seen> see(const LightContext& context, const Ray& ray, Sampler& sampler) {
  const BuiltWorld& world = context.world;
  ++context.counters.rays;
  const Trace trace = world.geometry.trace(ray, 0, kInfinity);
  const float which = sampler.next_1d();
  if (!trace.hit) return std::nullopt;
  MediaState media = world.media_at_start(ray.o);
  Rgb T = transmittance_to_end(context, ray, trace, media, sampler);
  if (is_black(T)) return std::nullopt;
  std::optional<int> channel;
  if (world.materials.is_dispersive(world.material_of(*trace.hit))) T *= only(channel.emplace(channel_by(which)));
  return Seen{surface_vertex(world, *trace.hit, -ray.d, media, channel), T};
}

}  // namespace

FilmPeaks film_peaks(const FilmSearch& search) {
  if (!is_wanted(search.world, search.settings)) return {};
  const PeakFinder finder(search.world);
  const auto find = [&](LightId light, std::vector<Peak>& peaks) { finder.find(light, peaks); };
  return {search.pixels, search.world.scene.filter.radius, find_of_lights<Peak>(search, find)};
}

Rgb peak_estimate(const LightContext& context, const PixelPeaks& peaks, Vec2 center, Sampler sampler) {
  const float which = sampler.next_1d();
  const Vec2 around = sampler.next_2d();
  const BuiltWorld& world = context.world;
  const auto drawn = peaks.draw(which, around);
  const auto filter = world.filter.at({drawn.x.x - center.x, drawn.x.y - center.y});
  if (!(drawn.pdf > 0) || !(filter.pdf > 0)) return {};
  const auto seen = see(context, world.camera.ray(drawn.x, {0.5f, 0.5f}), sampler);
  if (!seen || !seen->vertex.has_smooth()) return {};
  const Vertex& vertex = seen->vertex;
  const auto light = world.lights.sample(drawn.light, vertex.p(), {});
  if (!light || is_black(light->L)) return {};
  const Rgb scattered = vertex.eval(light->wi) * light->L * seen->transmittance;
  if (is_black(scattered)) return {};
  const MediaState media = vertex.media_toward(world.geometry, light->wi);
  const Rgb arrives = arriving(context, media, vertex.origin(world.geometry, light->wi), *light, sampler);
  const float share = mis_weight(drawn.pdf, filter.pdf);
  const Rgb found = scattered * arrives * (filter.weight * filter.pdf / drawn.pdf * share);
  if (context.groups) context.groups->estimate(drawn.light, found);
  if (context.deep) context.deep->from_surface(world.camera.depth(vertex.p()), found);
  return found;
}

}  // namespace tyndall
