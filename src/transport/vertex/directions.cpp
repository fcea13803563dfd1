#include "transport/vertex/directions.h"

#include <algorithm>

namespace tyndall {
namespace {

/// Bounded, so that roulette does not keep a path because it was guided where next to nothing is scattered.
float guided_pdf_ratio(float pdf, float scattered) {
  constexpr float kMost = 1000;
  return scattered > 0 ? std::min(pdf / scattered, kMost) : kMost;
}

/// The first bounce only: later ones contribute a smaller share of the picture (docs/measurements.md). All where volume
/// emission is found by such rays alone.
bool guides(const LightContext& context, const Vertex& vertex) {
  if (context.settings.guiding == GuidingStrategy::off || context.world.bright_media.empty()) return false;
  const bool all = context.world.bright_media.emission_share() > 0 && !seeks_volume_lights(context);
  return (context.bounce == 0 || all) && !is_last_bounce(context) && vertex.on_surface() && vertex.has_smooth();
}

/// What goes on from the last bounce finds lights alone, which is what next-event estimation is for.
bool follows_suns(const LightContext& context, const Vertex& vertex) {
  return context.settings.guiding != GuidingStrategy::off && !context.world.aureoles.empty() && !vertex.on_surface() &&
         !is_last_bounce(context);
}

}  // namespace

Directions::Directions(const LightContext& context, const Vertex& vertex) : vertex_(vertex) {
  if (follows_suns(context, vertex)) aureole_ = context.world.aureoles.at(context, vertex);
  if (!guides(context, vertex)) return;
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
