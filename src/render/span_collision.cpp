#include <algorithm>

#include "render/fire_light.h"
#include "render/resampling.h"
#include "render/span_light.h"

namespace tyndall {
namespace {

/// A light looked at from a collision without visibility.
struct Candidate {
  LightSample light;
  Rgb contribution;  ///< were it visible: phase x radiance x MIS weight / density, of all candidates together
  float weight;
};

struct Event {
  const Vertex& vertex;
  const SpanEvent& span;
  Rgb beta;
};

std::optional<Candidate> look_at(const LightContext& context, const Event& event, LightCandidate tried, Vec2 u) {
  const auto light = sample_light(context, event.span.search, tried, event.vertex.p(), u);
  if (!light || is_black(light->L)) return std::nullopt;
  const Rgb f = event.vertex.eval(light->wi);
  const float density = tried.tries * light->pdf;
  if (is_black(f) || !(density > 0)) return std::nullopt;
  const SpanDensities others = span_densities(context, event.span, tried.light);
  const float phase = light->delta ? 0.0f : event.vertex.pdf(light->wi, Rgb(1.0f));
  const float collide = event.span.density;
  const float mis = mis_weight(collide * density, others.pair * light->pdf, collide * phase);
  const Rgb contribution = f * light->L * (mis / density);
  const float weight = mean(event.beta * contribution);
  if (weight == 0) return std::nullopt;
  return Candidate{*light, contribution, weight};
}

using Candidates = SmallVector<Candidate, 8>;

Candidates find_candidates(const LightContext& context, const Event& event, Sampler& sampler) {
  Candidates found;
  const auto add = [&](LightCandidate tried) {
    if (const auto c = look_at(context, event, tried, sampler.next_2d())) found.push_back(*c);
  };
  if (context.selector.exhaustive()) {
    for (LightId id = 0; id < context.world.lights.size(); ++id) add({id, 1});
    return found;
  }
  for (const LightCandidate& tried : context.selector.draw(event.span.search.cut, event.span.search.query, sampler.next_wide())) {
    add(tried);
  }
  return found;
}

}  // namespace

Rgb collision_light(const LightContext& context, const Vertex& vertex, const SpanEvent& event, Rgb beta) {
  Sampler sampler = context.sampler.fork();
  const float u = sampler.next_1d();
  const Candidates candidates = find_candidates(context, {vertex, event, beta}, sampler);
  const Survivors survivors = resample(candidates, context.selector.exhaustive() ? 0 : context.settings.shadow_rays, u);
  Rgb sum;
  for (const Survivor& s : survivors) {
    const LightSample& light = candidates[s.index].light;
    const MediaState media = vertex.media_toward(context.world.geometry, light.wi);
    sum += candidates[s.index].contribution * s.scale * arriving(context, media, vertex.p(), light, sampler);
  }
  return sum;
}

}  // namespace tyndall
