#include "render/directions.h"

#include <algorithm>

namespace tyndall {
namespace {

/// The first event only: what later ones bring is a smaller share of the picture. In smoke among a thousand lights (depth 10)
/// guiding gives 1.55 of the efficiency without (1.64 if at all surfaces), in a hall with bulbs 0.88 (0.81).
bool guides(const LightContext& context, const Vertex& vertex) {
  const RenderSettings& settings = context.settings;
  if (settings.guiding == GuidingStrategy::off || context.world.glow.empty()) return false;
  // What stands for other programs' methods goes on as they do.
  if (settings.guiding == GuidingStrategy::automatic && settings.media != MediaStrategy::product) return false;
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
  return glow_ ? mixed(wi, scattered) : scattered;
}

/// Densities of coated materials are stand-ins: what is scattered brings its own weight, of which this takes its share.
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
  const float pdf = mixed(s->wi, s->pdf);
  if (!(pdf > 0)) {  // neither would own to it
    s->weight *= 1 / (1 - share);
    return s;
  }
  if (s->pdf == 0) return std::nullopt;
  s->emphasis = pdf / s->pdf;
  s->weight *= s->pdf / pdf;
  s->pdf = pdf;
  return s;
}

std::optional<ScatterSample> Directions::toward_glow(Rgb beta, float u, Vec2 on_cone) const {
  const Vec3 wi = glow_->sample(u, on_cone);
  const Rgb f = vertex_.eval(wi);
  if (is_black(f)) return std::nullopt;
  const float scattered = vertex_.pdf(wi, beta), pdf = mixed(wi, scattered);
  if (!(pdf > 0)) return std::nullopt;
  const float emphasis = scattered > 0 ? pdf / scattered : 1.0f;
  return ScatterSample{.wi = wi, .weight = f * (1 / pdf), .pdf = pdf, .specular = false, .emphasis = emphasis};
}

}  // namespace tyndall
