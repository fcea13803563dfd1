#include "transport/vertex/vertex.h"

#include <algorithm>

namespace tyndall {
namespace {

/// Cosines below this make lobes about half vectors endless.
constexpr float kLeastCosine = 0.03f;
/// The outline of a lobe is never trusted to the point of leaving out what it does not show.
constexpr float kLeastDiffuse = 0.01f;
constexpr float kSharpest = 0.98f;

QueryLobe lobe_of(const Highlight& h, Vec3 wo, Vec3 n) {
  QueryLobe lobe;
  lobe.tangent = h.tangent;
  lobe.bitangent = cross(n, h.tangent);
  lobe.cos_o = std::max(dot(wo, n), kLeastCosine);
  lobe.sin_o = dot(wo, h.tangent);
  lobe.eta = h.eta;
  const float cos_t = std::max(std::abs(dot(h.axis, n)), kLeastCosine);
  const float l2 = std::max(length_squared(wo + h.axis * h.eta), 4 * kLeastCosine * kLeastCosine);
  lobe.slope2_t = h.slope2_t;
  lobe.slope2_b = h.slope2_b;
  lobe.spread_b = h.eta * h.eta / l2;
  lobe.spread_t = lobe.spread_b * cos_t * cos_t;
  lobe.scale = 2 * h.share * lobe.cos_o * cos_t / l2;
  return lobe;
}

}  // namespace

Vertex::Vertex(Surface surface, Vec3 wo, const MediaState& media) : kind_(std::move(surface)), wo_(wo), media_(media) {}
Vertex::Vertex(InMedium medium, Vec3 wo, const MediaState& media) : kind_(std::move(medium)), wo_(wo), media_(media) {}

Vec3 Vertex::p() const {
  const auto* surface = std::get_if<Surface>(&kind_);
  return surface ? surface->hit.p : std::get<InMedium>(kind_).p;
}

PointQuery Vertex::light_query() const {
  const auto* surface = std::get_if<Surface>(&kind_);
  if (!surface) {
    const float g = std::get<InMedium>(kind_).phase.mean_cosine();
    PointQuery query{.p = p(), .n = {0, 0, 0}, .transmissive = true};
    query.g = std::clamp(g, -kSharpest, kSharpest);
    query.forward = -wo_;
    return query;
  }
  // Sides are those of the shading normal, as in the BSDF.
  PointQuery query{.p = surface->hit.p, .n = face_forward(surface->hit.ns, wo_), .transmissive = surface->bsdf.transmits()};
  const Highlights highlights = surface->bsdf.highlights(wo_);
  query.diffuse = std::max(highlights.diffuse, kLeastDiffuse);
  for (const Highlight& h : highlights.glossy) query.lobes[query.lobe_count++] = lobe_of(h, wo_, query.n);
  return query;
}

bool Vertex::has_smooth() const {
  const auto* surface = std::get_if<Surface>(&kind_);
  return surface == nullptr || surface->bsdf.has_smooth();
}

Rgb Vertex::eval(Vec3 wi) const {
  const auto* surface = std::get_if<Surface>(&kind_);
  return surface ? surface->bsdf.eval(wo_, wi) : std::get<InMedium>(kind_).phase.eval(wo_, wi);
}

float Vertex::pdf(Vec3 wi, Rgb beta) const {
  const auto* surface = std::get_if<Surface>(&kind_);
  return surface ? surface->bsdf.pdf(wo_, wi) : std::get<InMedium>(kind_).phase.pdf(wo_, wi, beta);
}

std::optional<ScatterSample> Vertex::sample(Rgb beta, float uc, Vec2 u) const {
  if (const auto* surface = std::get_if<Surface>(&kind_)) {
    const auto s = surface->bsdf.sample(wo_, uc, u);
    if (!s) return std::nullopt;
    return ScatterSample{s->wi, s->weight, s->pdf, s->specular, s->eta, s->specular && !s->transmission};
  }
  const auto s = std::get<InMedium>(kind_).phase.sample(wo_, beta, uc, u);
  if (!s) return std::nullopt;
  return ScatterSample{s->wi, s->weight, s->pdf, false, 1};
}

Rgb Vertex::albedo() const {
  const auto* surface = std::get_if<Surface>(&kind_);
  return surface ? surface->bsdf.albedo(wo_) : Rgb(1.0f);
}

Vec3 Vertex::origin(const Geometry& geometry, Vec3 wi) const {
  const auto* surface = std::get_if<Surface>(&kind_);
  return surface ? geometry.offset_origin(surface->hit, wi) : p();
}

MediaState Vertex::media_toward(const Geometry& geometry, Vec3 wi) const {
  const auto* surface = std::get_if<Surface>(&kind_);
  if (!surface || geometry.groups().empty()) return media_;
  const Vec3 ng = surface->hit.ng;
  if ((dot(ng, wo_) > 0) == (dot(ng, wi) > 0)) return media_;
  // The surface's own boundary, and any that coincides with it, lies between the two sides' ray origins.
  const Vec3 from = geometry.offset_origin(surface->hit, wo_);
  MediaState state = media_;
  for (const Crossing& c : geometry.trace_all({from, origin(geometry, wi) - from}, 0, 1)) state.cross(c.group, c.sign);
  return state;
}

}  // namespace tyndall
