#include "transport/techniques/span_light.h"

#include <algorithm>
#include <cmath>

#include "transport/budget/light_counts.h"
#include "transport/media/scattering.h"
#include "transport/media/span_distance.h"
#include "transport/media/transmittance_walk.h"
#include "transport/sample/deep_sample.h"
#include "transport/techniques/mis.h"
#include "transport/techniques/next_event.h"
#include "volume/coarse.h"

namespace tyndall {
namespace {

/// Transmittances below this do not count as less in choices: the medium may be thinner than it looks.
constexpr float kLeastTransmittance = 1e-3f;

/// A pair of a light and a distance, evaluated without visibility.
struct Pair {
  float t;
  const SpanPart* part;
  LightId id;
  LightSample light;
  Rgb contribution;  ///< were everything clear: scattering x radiance x MIS weight / density, of all pairs together
  float weight;      ///< in resampling: the contribution's size times the profile's transmittance
};

using Pairs = SmallVector<Pair, 8>;

DistanceSampler distances_to(const LightContext& context, const SpanSearch& search, LightId id) {
  const DistanceStrategy distance = context.settings.distance;
  const bool plain = distance == DistanceStrategy::equiangular || distance == DistanceStrategy::both;
  const auto weights = plain ? std::nullopt : std::optional(DistanceSampler::Weights{search.g});
  return DistanceSampler(search.profile, {search.query.o, search.query.d}, context.world.lights.place(id), weights);
}

/// Samples the pairs of one span.
class PairFinder {
 public:
  PairFinder(const LightContext& context, const Span& span, const SpanSearch& search, Rgb beta)
      : context_(context), span_(span), search_(search), beta_(beta) {}

  void look_along(LightCandidate candidate, Sampler& sampler, Pairs& pairs) const {
    const DistanceSampler distances = distances_to(context_, search_, candidate.light);
    ++context_.counters.places;
    const DistanceSample distance = distances.sample(sampler.next_1d());
    if (const auto pair = look_at(candidate, distance, sampler.next_2d())) pairs.push_back(*pair);
  }

 private:
  std::optional<Pair> look_at(LightCandidate candidate, DistanceSample distance, Vec2 on_light) const {
    const auto [id, n_pmf] = candidate;
    if (!(distance.pdf > 0) || !std::isfinite(distance.t)) return std::nullopt;
    const SpanPart& part = span_.part_at(distance.t);
    if (distance.t < part.t0 || distance.t > part.t1) return std::nullopt;  // between media
    const Vec3 p = span_.ray.at(distance.t);
    const Scattering scattering = Scattering::at(part.media, p);
    if (is_black(scattering.sigma_s)) return std::nullopt;
    const auto light = sample_light(context_, id, p, on_light);
    // What is not a number is kept, so that the film sees and counts it.
    if (!light || is_black(light->L)) return std::nullopt;

    const Vec3 wo = -span_.ray.d;
    const Rgb f = scattering.sigma_s * scattering.phase.eval(wo, light->wi);
    const float density = search_.chance * n_pmf * distance.pdf * light->pdf;
    if (is_black(f) || !(density > 0)) return std::nullopt;
    const float collide = scattering.sigma_t * search_.profile.transmittance(distance.t);
    const float tracked = search_.tracked ? collide * n_pmf * light->pdf : 0.0f;
    const float by_phase = light->delta ? 0.0f : collide * scattering.pdf(wo, light->wi);
    const float share = light->delta ? path_mis_weight(context_, id) : 1.0f;
    const Rgb contribution = f * light->L * (share * mis_weight(density, tracked, by_phase) / density);
    const float weight = mean(beta_ * contribution) * attenuation(part, distance.t, p, *light);
    if (weight == 0) return std::nullopt;
    return Pair{distance.t, &part, id, *light, contribution, weight};
  }

  float attenuation(const SpanPart& part, float t, Vec3 p, const LightSample& light) const {
    const Ray ray{p, light.wi};
    const float end = std::min(light.distance, exit_distance(part.box, ray));
    const float depth = coarse_optical_depth(part.view(), ray, 0, end);
    return std::max(search_.profile.transmittance(t) * std::exp(-depth), kLeastTransmittance);
  }

  const LightContext& context_;
  const Span& span_;
  const SpanSearch& search_;
  Rgb beta_;
};

Pairs all_lights(const LightContext& context, const SpanSearch& search, const PairFinder& finder, Sampler& sampler) {
  Pairs pairs;
  for (LightId id = 0; id < context.world.lights.size(); ++id) {
    if (!search.volumes && context.world.volume_lights.holds(id)) continue;
    finder.look_along({id, 1}, sampler, pairs);
  }
  return pairs;
}

Pairs chosen_lights(const SpanSearch& search, const PairFinder& finder, Sampler& sampler) {
  Pairs pairs;
  for (const LightCandidate& candidate : search.among->draw(search.cut, search.query, sampler.next_wide())) {
    finder.look_along(candidate, sampler, pairs);
  }
  return pairs;
}

/// Where pairs are evaluated, and who is told what that is worth.
struct PairsOf {
  const LightContext& context;
  const Span& span;
  Rgb beta;
  LightTrial* trial;
};

Rgb evaluate(const PairsOf& of, const Pairs& pairs, Survivors survivors, Sampler& sampler) {
  const auto& [context, span, beta, trial] = of;
  std::sort(survivors.begin(), survivors.end(),
            [&](const Survivor& a, const Survivor& b) { return pairs[a.index].t < pairs[b.index].t; });
  TransmittanceWalk walk(span_method(context), span, sampler.stream(), context.counters.tracking);
  Rgb sum;
  RayTrial rays(context, trial);
  for (const Survivor& s : survivors) {
    const Pair& pair = pairs[s.index];
    const Rgb T = walk.to(pair.t);
    if (is_black(T)) continue;
    const Vec3 p = span.ray.at(pair.t);
    const Rgb light = pair.contribution * T * s.scale * arriving(context, pair.part->state, p, pair.light, sampler);
    rays.add(beta * light, s.scale);
    if (context.groups) context.groups->estimate(pair.id, light);
    if (context.deep && context.bounce == 0) context.deep->estimate(pair.t, light);
    sum += light;
  }
  rays.note(Spent::span_rays);
  return sum;
}

SegmentQuery query_of(const RenderSettings& settings, const Span& span, const SpanProfile& profile, float g) {
  SegmentQuery query{};
  query.o = span.ray.o;
  query.d = span.ray.d;
  query.t0 = profile.begin();
  query.t1 = profile.end();
  query.importance = settings.media;
  query.reach = std::max(profile.reach(), std::numeric_limits<float>::min());
  if (settings.media == MediaStrategy::product) query.profile = profile.coarse(g);
  return query;
}

/// By default on the camera's segment: in dense media collisions know better than a profile where there is light. Later ones
/// are not worth both (docs/measurements.md).
bool tracks(const LightContext& context) {
  const RenderSettings& settings = context.settings;
  if (settings.distance == DistanceStrategy::automatic) return settings.media == MediaStrategy::product && context.bounce == 0;
  return settings.distance == DistanceStrategy::tracking || settings.distance == DistanceStrategy::both;
}

/// Many for single scattering, with its many pairs; where paths go on most error is of later bounces (docs/measurements.md).
SpanProfile::Bins bins_of_profile(const LightContext& context) {
  return is_single_scattering(context) ? SpanProfile::Bins::many : SpanProfile::Bins::few;
}

}  // namespace

bool seeks_along_spans(const LightContext& context) {
  return context.settings.media != MediaStrategy::vertex && context.world.lights.sought(seeks_volume_lights(context)) > 0;
}

bool pairs_along_spans(const RenderSettings& settings) {
  return settings.media != MediaStrategy::vertex && settings.distance != DistanceStrategy::tracking;
}

std::optional<SpanSearch> span_search(const LightContext& context, const Span& span) {
  const RenderSettings& settings = context.settings;
  if (!seeks_along_spans(context) || span.empty()) return std::nullopt;
  const auto profile = SpanProfile::of(span, bins_of_profile(context));
  if (!profile) return std::nullopt;
  ++context.counters.segments;
  const bool volumes = seeks_volume_lights(context);
  SpanSearch search{.among = &selector(context, volumes),
                    .volumes = volumes,
                    .query = {},
                    .cut = {},
                    .profile = *profile,
                    .g = mean_cosine(span)};
  search.query = query_of(settings, span, *profile, search.g);
  search.tracked = tracks(context);
  if (!search.among->exhaustive()) {
    const SpanCounts counts = counts_along_span(context, *search.among, profile->scattered());
    search.cut = search.among->cut(search.query, cut_settings(context, counts.candidates));
    search.shadow_rays = counts.shadow_rays;
    search.chance = counts.chance;
  }
  return search;
}

Rgb span_light(const LightContext& context, const Span& span, const SpanSearch& search, Rgb beta) {
  Sampler sampler = context.sampler.fork();
  if (search.chance < 1 && sampler.next_1d() >= search.chance) return {};
  const PairFinder finder(context, span, search, beta);
  return tried(context, {Spent::span_candidates, Spent::span_rays}, beta, [&](const LightContext& c, LightTrial* trial) {
    const float u = sampler.next_1d();
    const bool all = search.among->exhaustive();
    const Pairs pairs = all ? all_lights(c, search, finder, sampler) : chosen_lights(search, finder, sampler);
    return evaluate({c, span, beta, trial}, pairs, resample(pairs, search.shadow_rays, u), sampler);
  });
}

float collision_density(const Span& span, const SpanSearch& search, float t) {
  return Scattering::at(span.part_at(t).media, span.ray.at(t)).sigma_t * search.profile.transmittance(t);
}

SpanDensities span_densities(const LightContext& context, const SpanCollision& collision, LightId id) {
  const float n_pmf = collision.search.among->n_pmf(collision.search.cut, collision.search.query, id);
  return {.pair = pairs_along_spans(context.settings)
                      ? n_pmf * collision.search.chance * distances_to(context, collision.search, id).pdf(collision.t)
                      : 0.0f,
          .tracked = collision.search.tracked ? n_pmf * collision.density : 0.0f};
}

Rgb collision_light(const LightContext& context, const Vertex& vertex, const SpanCollision& collision, Rgb beta) {
  Sampler sampler = context.sampler.fork();
  const auto share = [&](const LightSample& light, LightId id, float density) {
    const SpanDensities others = span_densities(context, collision, id);
    const float phase = light.delta ? 0.0f : vertex.pdf(light.wi, Rgb(1.0f));
    const float own = light.delta ? path_mis_weight(context, id) : 1.0f;
    return own * mis_weight(collision.density * density, others.pair * light.pdf, collision.density * phase);
  };
  return NextEvent(context, vertex, collision.search, beta, share).estimate(sampler);
}

}  // namespace tyndall
