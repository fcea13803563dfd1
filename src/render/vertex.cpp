#include "render/vertex.h"

namespace tyndall {

Vertex::Vertex(Surface surface, Vec3 wo, const MediaState& media) : kind_(std::move(surface)), wo_(wo), media_(media) {}
Vertex::Vertex(InMedium medium, Vec3 wo, const MediaState& media) : kind_(std::move(medium)), wo_(wo), media_(media) {}

Vec3 Vertex::p() const {
  const auto* surface = std::get_if<Surface>(&kind_);
  return surface ? surface->hit.p : std::get<InMedium>(kind_).p;
}

PointQuery Vertex::light_query() const {
  const auto* surface = std::get_if<Surface>(&kind_);
  if (!surface) return {.p = p(), .n = {0, 0, 0}, .transmissive = true};
  // Sides are those of the shading normal, as in the BSDF.
  return {.p = surface->hit.p,
          .n = face_forward(surface->hit.ns, wo_),
          .transmissive = surface->bsdf.transmits()};
}

PointQuery Vertex::light_query_with_lobes() const {
  PointQuery query = light_query();
  if (const auto* surface = std::get_if<Surface>(&kind_)) {
    const Highlights highlights = surface->bsdf.highlights(wo_);
    for (std::size_t i = 0; i < highlights.size(); ++i) query.lobes[i] = {highlights[i].axis, highlights[i].width};
    return query;
  }
  // Henyey-Greenstein falls to a quarter near 1.2 (1 - g) off the forward direction.
  const float g = std::get<InMedium>(kind_).phase.mean_cosine();
  if (std::abs(g) > 0.5f) query.lobes[0] = {g > 0 ? -wo_ : wo_, 1.2f * (1 - std::abs(g))};
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
    return ScatterSample{s->wi, s->weight, s->pdf, s->specular, s->eta};
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
