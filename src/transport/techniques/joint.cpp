#include "transport/techniques/joint.h"

#include "transport/media/scattering.h"
#include "transport/sample/grouped_light.h"
#include "transport/techniques/point_aim.h"
#include "transport/techniques/shadow_ray.h"
#include "volume/coarse.h"

namespace tyndall {
namespace {

/// A second one costs more than it saves.
constexpr CutSettings kOneLight{.candidates = 1, .splitting = 0};
/// Optical depth toward a light, roughly: behind more of it, little of what is drawn arrives (docs/measurements.md).
constexpr float kDeepest = 3;

/// Whether there may be a medium that scatters near the light, and little enough in between for it to be worth two rays. It
/// depends only on the collision and the light, as both sides of MIS ask.
bool in_reach(const JointSearch& search, Vec3 point) {
  const Vec3 to_point = point - search.query.p;
  const float distance = length(to_point);
  if (!search.reach.contains(point) || !(distance > 0)) return false;
  const MediaView media{search.media.data(), search.media.size()};
  return coarse_optical_depth(media, {search.query.p, to_point * (1 / distance)}, 0, distance) < kDeepest;
}

/// By one light that was chosen.
Rgb by_light(const LightContext& context, const Vertex& vertex, const JointSearch& search, LightCandidate candidate,
             Sampler& sampler) {
  const Vec2 around = sampler.next_2d();
  const float along = sampler.next_1d();
  const auto point = context.world.lights.point(candidate.light);
  if (!point || !(candidate.n_pmf > 0) || !in_reach(search, *point)) return {};
  const auto aim = aim_near(vertex.p(), *point, search.query.g, around, along);
  if (!aim) return {};
  const Rgb f = vertex.eval(aim->w);
  if (is_black(f)) return {};
  const float share = mis_weight(candidate.n_pmf * aim->pdf, vertex.pdf(aim->w, Rgb(1.0f)));
  const PathSegment segment{vertex.media(), {vertex.origin(context.world.geometry, aim->w), aim->w}, aim->t};
  return f * in_scattered(context, segment, candidate.light, sampler) * (aim->spread * share / candidate.n_pmf);
}

}  // namespace

Rgb in_scattered(const LightContext& context, const PathSegment& segment, LightId point, Sampler& sampler) {
  const BuiltWorld& world = context.world;
  const Vec3 p = segment.ray.at(segment.t), wo = -segment.ray.d;
  const auto light = world.lights.sample(point, p, {});
  if (!light || is_black(light->L)) return {};
  ++context.counters.shadow_rays;
  const auto crossings = world.geometry.trace_shadow(segment.ray, 0, segment.t);
  if (!crossings) return {};

  SpanWalk to_end(world.media_context(), segment.start, *crossings, segment.t);
  while (to_end.next()) {
  }
  context.counters.parity_errors += to_end.parity_errors();
  const MediaState there = to_end.state();
  const Scattering scattering = Scattering::at(there.active(world.geometry.groups(), world.media), p);
  if (is_black(scattering.sigma_s)) return {};

  Rng rng = sampler.stream();
  SpanWalk walk(world.media_context(), segment.start, *crossings, segment.t);
  const Rgb T = transmittance_along(context, walk, segment.ray, rng);
  if (is_black(T)) return {};
  const Rgb intensity = light->L * light->distance * light->distance;
  return scattering.sigma_s * scattering.phase.eval(wo, light->wi) * intensity * T *
         arriving(context, there, p, *light, sampler);
}

std::optional<JointSearch> joint_search(const LightContext& context, const Vertex& vertex) {
  if (context.settings.joint == JointStrategy::off || vertex.on_surface() || is_last_bounce(context)) return std::nullopt;
  if (context.selector.exhaustive()) return std::nullopt;
  const auto& groups = context.world.geometry.groups();
  const Bounds3 reach = vertex.media().bounds(groups);
  if (overlap(reach, context.world.lights.point_box()).empty()) return std::nullopt;
  JointSearch search{vertex.light_query(), {}, vertex.media().active(groups, context.world.media), reach};
  search.cut = context.selector.cut(search.query, kOneLight);
  return search;
}

Rgb joint_estimate(const LightContext& context, const Vertex& vertex, const JointSearch& search) {
  Sampler sampler = context.sampler.fork();
  Rgb sum;
  for (const LightCandidate& candidate : context.selector.draw(search.cut, search.query, sampler.next_wide())) {
    const Rgb light = by_light(context, vertex, search, candidate, sampler);
    if (context.groups) context.groups->estimate(candidate.light, light);
    sum += light;
  }
  return sum;
}

float CollisionJointWeight::path_mis_weight(const LightContext& context, LightId light) const {
  const auto point = context.world.lights.point(light);
  if (!point) return 1;
  const float aimed = aim_pdf(search_.query.p, *point, w_);
  if (!(aimed > 0) || !in_reach(search_, *point)) return 1;
  return mis_weight(pdf_, context.selector.n_pmf(search_.cut, search_.query, light) * aimed);
}

}  // namespace tyndall
