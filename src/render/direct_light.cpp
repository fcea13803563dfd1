#include "render/direct_light.h"

#include <algorithm>
#include <cmath>

#include "math/small_vector.h"
#include "render/fire_light.h"
#include "render/resampling.h"

namespace tyndall {
namespace {

/// Shadow rays end this fraction short of the light, so that they do not meet the emitter itself.
constexpr float kShadowEnd = 1 - 1e-4f;

/// A light looked at without visibility.
struct Candidate {
  LightSample light;
  Rgb contribution;  ///< were it visible: scattering x radiance x MIS weight / density, of all candidates together
  float weight;      ///< in resampling: the contribution's size
};

/// A vertex whose light is sought.
struct Seeker {
  const LightContext& context;
  const Vertex& vertex;
  const LightSearch& search;
  Rgb beta;
};

std::optional<Candidate> look_at(const Seeker& seeker, LightCandidate tried, Vec2 u) {
  const auto& [context, vertex, search, beta] = seeker;
  const auto light = sample_light(context, search, tried, vertex.p(), u);
  // What is not a number goes on, so that the film sees it and counts it.
  if (!light || is_black(light->L)) return std::nullopt;
  const float density = tried.tries * light->pdf;
  if (density <= 0) return std::nullopt;
  const Rgb f = vertex.eval(light->wi);
  if (is_black(f)) return std::nullopt;
  // The density of the candidates stands for the technique: it is known for every direction, unlike the resampled one.
  const float mis = light->delta ? 1.0f : mis_weight(density, vertex.pdf(light->wi, beta));
  const Rgb contribution = f * light->L * (mis / density);
  const float weight = mean(beta * contribution);
  if (weight == 0) return std::nullopt;
  return Candidate{*light, contribution, weight};
}

/// The candidate's contribution dimmed by what is in between.
Rgb trace(const Seeker& seeker, const Candidate& c, Sampler& sampler) {
  const auto& [context, vertex, search, beta] = seeker;
  const World::Parts& world = context.world;
  const Vec3 origin = vertex.origin(world.geometry, c.light.wi);
  return c.contribution * arriving(context, vertex.media_toward(world.geometry, c.light.wi), origin, c.light, sampler);
}

Rgb trace_all(const Seeker& seeker, Sampler& sampler) {
  Rgb sum;
  for (LightId id = 0; id < seeker.context.world.lights.size(); ++id) {
    if (const auto c = look_at(seeker, {id, 1}, sampler.next_2d())) sum += trace(seeker, *c, sampler);
  }
  return sum;
}

using Candidates = SmallVector<Candidate, 8>;

}  // namespace

Rgb visibility(const LightContext& context, const MediaState& media, Vec3 origin, Vec3 wi, float distance, Sampler& sampler) {
  const World::Parts& world = context.world;
  const float t_end = distance * kShadowEnd;
  ++context.counters.shadow_rays;
  const Ray ray{origin, wi};
  const auto crossings = world.geometry.trace_shadow(ray, 0, t_end);
  if (!crossings) return {};
  Rgb T{1.0f};
  if (!world.has_media()) return T;

  Rng rng = sampler.stream();
  SpanWalk walk(world.media_context(), media, *crossings, t_end);
  while (const auto interval = walk.next()) {
    const MediaView view(interval->media.data(), interval->media.size());
    T *= transmittance(context.settings.transmittance, view, ray, interval->t0, interval->t1, rng, context.counters.tracking);
    if (is_black(T)) break;
  }
  context.counters.parity_errors += walk.parity_errors();
  return T;
}

LightSearch light_search(const LightContext& context, const Vertex& vertex) {
  const RenderSettings& settings = context.settings;
  LightSearch search{vertex.light_query(), {}};
  if (context.world.lights.empty() || !vertex.has_smooth() || context.selector.exhaustive()) return search;
  search.cut = context.selector.cut(search.query, {.candidates = settings.candidates, .splitting = settings.splitting});
  return search;
}

Rgb direct_light(const LightContext& context, const Vertex& vertex, const LightSearch& search, Rgb beta) {
  Sampler sampler = context.sampler.fork();
  if (context.world.lights.empty() || !vertex.has_smooth()) return {};
  const Seeker seeker{context, vertex, search, beta};
  if (context.selector.exhaustive()) return trace_all(seeker, sampler);

  const float u = sampler.next_1d();
  Candidates candidates;
  for (const LightCandidate& tried : context.selector.draw(search.cut, search.query, sampler.next_wide())) {
    if (const auto c = look_at(seeker, tried, sampler.next_2d())) candidates.push_back(*c);
  }
  Rgb sum;
  for (const Survivor& s : resample(candidates, context.settings.shadow_rays, u)) {
    sum += trace(seeker, candidates[s.index], sampler) * s.scale;
  }
  return sum;
}

}  // namespace tyndall
