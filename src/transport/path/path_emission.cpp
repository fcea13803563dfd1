/// The light that a path gathers: at its bounces, and where its rays end.
#include <algorithm>
#include <utility>

#include "transport/path/path.h"
#include "transport/pixel/film_emitters.h"
#include "transport/sample/deep_sample.h"
#include "transport/sample/emission_by_group.h"
#include "transport/techniques/shadow_ray.h"

namespace tyndall {
namespace {

/// Look-ups of the emission that the camera sees, for each one of what paths meet later (docs/measurements.md).
constexpr float kSeenDensity = 2;

}  // namespace

/// Of one light.
void Path::add_light(LightId light, Rgb contribution, int bounces) {
  add(contribution, bounces);
  if (context_.groups) sums_by_group(bounces)[context_.groups->groups().of(light)] += contribution;
}

/// Light from emitters that a path of throughput `beta` brings by scattering at the vertex. Whether its mirror was looked into.
bool Path::gather_light(const Directions& directions, Rgb beta) {
  const bool offers = shares_directions() && may_offer_lights(directions.vertex());
  if (offers) {
    offer_lights(directions);
  } else {
    add_estimate(beta, light_at(directions, beta), depth_);
  }
  const bool in_mirror = std::exchange(in_mirror_, in_mirror_ || is_at_find());
  const bool looked = look_into_mirror(directions.vertex(), beta);
  in_mirror_ = in_mirror;
  if (offers) offer_->has_lights = true;
  return looked;
}

/// Without what the span's pairs estimate.
Rgb Path::light_at(const Directions& directions, Rgb beta) {
  const Vertex& vertex = directions.vertex();
  sought_.collision.reset();
  if (vertex.on_surface() || !span_search_) {
    sought_.search = light_search(context_, vertex);
    return is_black(beta) ? Rgb() : direct_light(context_, directions, sought_.search, beta);
  }
  sought_.collision = SpanCollision{*span_search_, collision_t_, collision_density_};
  return span_search_->tracked ? collision_light(context_, vertex, *sought_.collision, beta) : Rgb();
}

/// Emitters that a surface mirrors which does more than that: of many paths few go there, and small emitters are bright.
/// Whether it was looked, by a ray that no path depends on; paths that are mirrored there count those no more.
bool Path::look_into_mirror(const Vertex& vertex, Rgb beta) {
  const BuiltWorld& world = context_.world;
  const auto mirror = world.rays_find_lights() ? vertex.mirror_part() : std::nullopt;
  if (!mirror) return false;
  const Ray ray{vertex.origin(world.geometry, mirror->wi), mirror->wi};
  ++context_.counters.rays;
  const Trace trace = world.geometry.trace(ray, 0, kInfinity);
  MediaState media = vertex.media_toward(world.geometry, ray.d);
  std::optional<Rgb> passed;
  const auto add = [&](LightId id, Rgb L) {
    if (is_black(L)) return;
    if (!passed) passed = beta * mirror->f * transmittance_to_end(context_, ray, trace, media, context_.sampler);
    add_light(id, *passed * L, depth_);
  };
  if (!trace.hit) {
    for (const LightId id : world.lights.infinite()) add(id, world.lights.environment(id, {vertex.p(), ray.d}));
  } else if (const auto id = world.light_of(*trace.hit)) {
    add(*id, world.lights.emitted(*id, emitter_hit(*trace.hit), -ray.d));
  }
  return true;
}

/// MIS weight of a scattered ray that found light `id`, which next-event estimation samples with `light_pdf`.
float Path::scattering_mis_weight(LightId id, float light_pdf) const {
  return light_sampled_ ? sought_.scattering_mis_weight(context_, pdf_, id, light_pdf) : 1.0f;
}

/// What a ray that was scattered from a vertex counts of the emission that it passes.
class Path::ScatteredEmission final : public EmissionGauge {
 public:
  explicit ScatteredEmission(const Path& path) : path_(path) {}

  Rgb counted(MediaView media, Vec3 p, Rgb emission) const override {
    const auto emits = [](const ParticipatingMedium* medium) { return medium->emissive(); };
    const auto first = std::find_if(media.begin(), media.end(), emits);
    if (std::find_if(first + 1, media.end(), emits) == media.end()) return emission * mis_weight_of(**first, p);
    Rgb sum;
    for (const ParticipatingMedium* medium : media) {
      if (!medium->emissive()) continue;
      const Coefficients c = medium->at(p);
      sum += c.sigma_a * c.Le * mis_weight_of(*medium, p);
    }
    return sum;
  }

 private:
  float mis_weight_of(const ParticipatingMedium& medium, Vec3 p) const {
    const auto held = path_.context_.world.volume_lights.at(medium, p, path_.from_);
    return held ? path_.scattering_mis_weight(held->light, held->pdf) : 1.0f;
  }

  const Path& path_;
};

/// What a find's ray brings it of emission and environments comes from one direction, as later light does, and is shared like
/// that. What next-event estimation weighs against is the path's own where that is.
int Path::bounces_of_light(bool weighed) const {
  const int bounces = depth_ - panes_;
  return completes_one_direction() && !weighed ? bounces + 1 : bounces;
}

/// All of it that reaches the span's origin: how far the path goes does not matter.
void Path::add_volume_emission(const Span& span) {
  const auto emits = [](const SpanPart& part) { return any_emissive(part.view()); };
  const auto last = std::find_if(span.parts.rbegin(), span.parts.rend(), emits).base();
  if (last == span.parts.begin()) return;
  Rng rng = stream_for_emission();
  const ScatteredEmission gauge(*this);
  const bool weighs = light_sampled_ && panes_ == 0 && sought_.volumes();  // no one seeks those through panes
  DeepSample* const deep = depth_ == 0 ? context_.deep : nullptr;
  const EmissionLook look{weighs ? &gauge : nullptr, depth_ == 0 ? kSeenDensity : 1.0f, deep};
  const int bounces = bounces_of_light(weighs);
  Rgb T = beta_;
  for (auto part = span.parts.begin(); part != last && !is_black(T); ++part) {
    TrackingStats& stats = context_.counters.tracking;
    if (emits(*part)) {
      const Rng before = rng;
      if (deep) deep->begin_emission(*part, T);
      const auto passed = emission_and_transmittance(part->view(), ray_, part->t0, part->t1, look, rng, stats);
      add(T * passed.emitted, bounces);
      if (context_.groups)
        add_by_medium({*part, ray_, look, before}, passed.emitted, T, context_.groups->groups(), sums_by_group(bounces));
      T *= passed.transmittance;
    } else {
      T *= transmittance(span_method(context_), part->view(), ray_, part->t0, part->t1, rng, stats);
    }
  }
}

void Path::add_environment() {
  if (end_counted_) return;
  if (light_sampled_ && is_environment_offered()) return offer_environment();
  const Lights& lights = context_.world.lights;
  const Ray ray{depth_ == 0 ? ray_.o : from_, ray_.d};  // from where lights were sampled, as portals depend on it
  for (const LightId id : lights.infinite()) {
    const Rgb L = lights.environment(id, ray);
    if (is_black(L)) continue;
    const float pdf = light_sampled_ ? lights.environment_pdf(id, ray) : 0.0f;
    add_light(id, seen_.value_or(beta_) * L * scattering_mis_weight(id, pdf), bounces_of_light(pdf > 0));
  }
}

void Path::add_surface_emission(const SurfaceHit& hit) {
  const auto id = context_.world.light_of(hit);
  if (!id || end_counted_) return;
  if (depth_ == 0 && context_.drawn_emission && context_.drawn_emission->holds(context_.world, *id)) return;
  const Lights& lights = context_.world.lights;
  EmitterHit emitter = emitter_hit(hit);
  if (panes_ > 0) emitter.distance = length(hit.p - from_);
  const Rgb L = lights.emitted(*id, emitter, -ray_.d);
  if (is_black(L)) return;
  const float pdf = light_sampled_ ? lights.pdf(*id, from_, emitter) : 0.0f;
  add_light(*id, seen_.value_or(beta_) * L * scattering_mis_weight(*id, pdf), depth_ - panes_);
}

}  // namespace tyndall
