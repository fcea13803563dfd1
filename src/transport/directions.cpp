#include "transport/directions.h"

#include <algorithm>

namespace tyndall {
namespace {

/// A path does not live on for having been sent where next to nothing is scattered.
float emphasis(float pdf, float scattered) {
  constexpr float kMost = 1000;
  return scattered > 0 ? std::min(pdf / scattered, kMost) : kMost;
}

/// The first event only: what later ones bring is a smaller share of the picture. In smoke among a thousand lights (depth 5)
/// guiding gives 1.55 of the efficiency without (1.64 if at all surfaces), in a hall with bulbs 0.88 (0.81).
bool guides(const LightContext& context, const Vertex& vertex) {
  if (context.settings.guiding == GuidingStrategy::off || context.world.glow.empty()) return false;
  return context.event == 0 && !is_last_event(context) && vertex.on_surface() && vertex.has_smooth();
}

}  // namespace

Directions::Directions(const LightContext& context, const Vertex& vertex) : vertex_(vertex) {
  if (!guides(context, vertex)) return;
  glow_.emplace(context.world.glow, vertex.light_query());
  if (glow_->share() == 0) glow_.reset();
}

float Directions::pdf(Vec3 wi, Rgb beta) const {
  const float scattered = vertex_.pdf(wi, beta);
  return glow_ ? mixed(glow_->pdf(wi), scattered) : scattered;
}

/// Densities of coated materials are stand-ins, but above 0: what is scattered brings its own weight, of which this takes
/// its share.
std::optional<ScatterSample> Directions::sample(Rgb beta, float uc, Vec2 u) const {
  if (!glow_) return vertex_.sample(beta, uc, u);
  const float share = glow_->share();
  if (uc < share) return toward_glow(beta, uc / share, u);
  auto s = vertex_.sample(beta, std::min((uc - share) / (1 - share), kOneMinusEpsilon), u);
  if (!s) return std::nullopt;
  if (s->specular) {
    s->weight *= 1 / (1 - share);
    return s;
  }
  const float pdf = mixed(glow_->pdf(s->wi), s->pdf);
  s->emphasis = emphasis(pdf, s->pdf);
  s->weight *= s->pdf / pdf;
  s->pdf = pdf;
  return s;
}

std::optional<ScatterSample> Directions::toward_glow(Rgb beta, float u, Vec2 on_cone) const {
  const Vec3 wi = glow_->sample(u, on_cone);
  const Rgb f = vertex_.eval(wi);
  if (is_black(f)) return std::nullopt;
  const float guided = glow_->pdf(wi);
  if (!(guided > 0)) return std::nullopt;  // rounded out of its cone, at the rim: there all is left to scattering
  const float scattered = vertex_.pdf(wi, beta), pdf = mixed(guided, scattered);
  // eta stays 1: roulette of what goes through rough glass is off by its square, which is no bias.
  return ScatterSample{.wi = wi, .weight = f / pdf, .pdf = pdf, .specular = false, .emphasis = emphasis(pdf, scattered)};
}

}  // namespace tyndall
