#include "transport/vertex/directions.h"

#include <algorithm>

#include "volume/coarse.h"

namespace tyndall {
namespace {

/// Bounded, so that roulette does not keep a path because it was guided where next to nothing is scattered.
float guided_pdf_ratio(float pdf, float scattered) {
  constexpr float kMost = 1000;
  return scattered > 0 ? std::min(pdf / scattered, kMost) : kMost;
}

/// At the first vertex that spreads light only: later ones contribute a smaller share of the picture (docs/measurements.md).
/// All where volume emission is found by such rays alone.
bool guides(const LightContext& context, const Vertex& vertex) {
  if (context.settings.guiding == GuidingStrategy::off || context.world.bright_media.empty()) return false;
  const bool here = context.smooth_bounces == 0 || guides_everywhere(context, context.bounce);
  return here && !is_last_bounce(context) && vertex.on_surface() && vertex.has_smooth();
}

/// What goes on from the last bounce finds lights alone, which is what next-event estimation is for.
bool follows_suns(const LightContext& context, const Vertex& vertex) {
  return context.settings.guiding != GuidingStrategy::off && !context.world.suns.empty() && !vertex.on_surface() &&
         !is_last_bounce(context);
}

/// Of a direction e^-4 is left after this many turns of the mean cosine each: behind more, all light is even.
constexpr float kTurns = 4;
/// Of a path, from being guided, beyond which it is guided less and less: it was sent where its light is not, and such weights
/// multiply.
constexpr float kMostWeight = 10;

/// Mean albedo of single scattering.
float albedo_of(const ActiveMedia& media) {
  float sum = 0, count = 0;
  for (const ParticipatingMedium* medium : media) {
    if (!medium->scatters()) continue;
    sum += medium->albedo(), count += 1;
  }
  return count > 0 ? sum / count : 0.0f;
}

/// At a collision, from what is deterministic there; nothing where there is nothing to guide by.
std::optional<Aureole> aureole_at(const LightContext& context, const Vertex& vertex) {
  const BuiltWorld& world = context.world;
  const auto& groups = world.geometry.groups();
  const ActiveMedia media = vertex.media().active(groups, world.media);
  const Bounds3 box = vertex.media().bounds(groups);
  const Vec3 p = vertex.p();
  const float g = vertex.medium()->phase.mean_cosine(), deepest = kTurns / std::max(1 - g, 0.05f);
  const int orders = context.settings.max_depth - context.bounce - 1;
  Aureole aureole({g, albedo_of(media), orders}, world.suns.others_at(p), std::max(context.guided_weight / kMostWeight, 1.0f));
  for (const FarCone& sun : world.suns.brightest()) {
    const Ray ray{p, sun.directions.axis};
    if (world.geometry.occluded(ray, 0, kInfinity)) continue;
    const float depth = nearby_optical_depth({media.data(), media.size()}, ray, exit_distance(box, ray), deepest);
    aureole.add({ray.d, sun.fluence, std::min(length(sun.mean), 1.0f), depth});
  }
  return aureole.shows() ? std::optional(aureole) : std::nullopt;
}

}  // namespace

bool guides_everywhere(const LightContext& context, int bounce) {
  return context.settings.guiding != GuidingStrategy::off && context.world.bright_media.emission_share() > 0 &&
         !seeks_volume_lights(context, bounce);
}

Directions::Directions(const LightContext& context, const Vertex& vertex) : vertex_(vertex) {
  const bool toward_suns = follows_suns(context, vertex), toward_media = guides(context, vertex);
  if (toward_suns || toward_media) ++context.counters.guided;
  if (toward_suns) aureole_ = aureole_at(context, vertex);
  if (!toward_media) return;
  toward_media_.emplace(context.world.bright_media, vertex.light_query(), seeks_volume_lights(context));
  if (toward_media_->share() == 0) toward_media_.reset();
}

float Directions::pdf(Vec3 wi, Rgb beta) const {
  const float scattered = vertex_.pdf(wi, beta);
  if (aureole_) return scattered * aureole_->pdf_ratio(vertex_.medium()->phase, vertex_.wo(), wi, beta);
  return toward_media_ ? mixed(toward_media_->pdf(wi), scattered) : scattered;
}

std::optional<ScatterSample> Directions::sample(Rgb beta, Sampler& sampler) const {
  const float uc = sampler.next_1d();
  const Vec2 u = sampler.next_2d();
  if (aureole_) return toward_aureole(beta, sampler.stream());
  return toward_media_ ? mixed_sample(beta, uc, u) : vertex_.sample(beta, uc, u);
}

/// Densities of coated materials are approximate, but above 0: the weight that sampling gives already has the true one, and is
/// scaled by the scattering's share of the mixture.
std::optional<ScatterSample> Directions::mixed_sample(Rgb beta, float uc, Vec2 u) const {
  const float share = toward_media_->share();
  if (uc < share) return toward_media(beta, uc / share, u);
  auto s = vertex_.sample(beta, std::min((uc - share) / (1 - share), kOneMinusEpsilon), u);
  if (!s) return std::nullopt;
  if (s->specular) {
    s->weight *= 1 / (1 - share);
    return s;
  }
  const float pdf = mixed(toward_media_->pdf(s->wi), s->pdf);
  s->guided_pdf_ratio = guided_pdf_ratio(pdf, s->pdf);
  s->weight *= s->pdf / pdf;
  s->pdf = pdf;
  return s;
}

std::optional<ScatterSample> Directions::toward_media(Rgb beta, float u, Vec2 on_cone) const {
  const Vec3 wi = toward_media_->sample(u, on_cone);
  const Rgb f = vertex_.eval(wi);
  if (is_black(f)) return std::nullopt;
  const float guided = toward_media_->pdf(wi);
  if (!(guided > 0)) return std::nullopt;  // rounded out of its cone, at the rim: there all is left to scattering
  const float scattered = vertex_.pdf(wi, beta), pdf = mixed(guided, scattered);
  // eta stays 1: roulette of what goes through rough glass is off by its square, which is no bias.
  return ScatterSample{
      .wi = wi, .weight = f / pdf, .pdf = pdf, .specular = false, .guided_pdf_ratio = guided_pdf_ratio(pdf, scattered)};
}

/// Radiance over what is scattered is the ratio to the phase function's density, whatever that is.
std::optional<ScatterSample> Directions::toward_aureole(Rgb beta, Rng rng) const {
  const PhaseMix& phase = vertex_.medium()->phase;
  const Vec3 wi = aureole_->sample(phase, vertex_.wo(), beta, rng);
  const float scattered = phase.pdf(vertex_.wo(), wi, beta);
  const float pdf = scattered * aureole_->pdf_ratio(phase, vertex_.wo(), wi, beta);
  if (!(pdf > 0)) return std::nullopt;
  return ScatterSample{.wi = wi,
                       .weight = phase.eval(vertex_.wo(), wi) / pdf,
                       .pdf = pdf,
                       .specular = false,
                       .guided_pdf_ratio = guided_pdf_ratio(pdf, scattered)};
}

}  // namespace tyndall
