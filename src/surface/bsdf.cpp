#include "surface/bsdf.h"

namespace tyndall {
namespace {

constexpr float kMissedByGlass = 0.3f;

/// Shares of the lobes sum to one, whatever is absorbed.
struct HighlightFinder {
  Vec3 wo;  ///< local
  Highlights found{};

  void operator()(const ConductorLobe& lobe) { only(lobe.ggx); }
  void operator()(const DielectricLobe& lobe) {
    if (lobe.is_specular()) return;
    // Near total reflection a rough interface lets light through where no smooth one would: the lobes miss it.
    const float r = reflectance(lobe);
    found.diffuse = kMissedByGlass;
    add_reflection(lobe.ggx, wo, (1 - kMissedByGlass) * r, found);
    add_transmission(lobe.ggx, lobe.eta, wo, (1 - kMissedByGlass) * (1 - r), found);
  }
  void operator()(const CoatedDiffuseLobe& lobe) {
    const float r = reflectance(lobe.top);
    over_diffuse(lobe.top, r, (1 - r) * mean(lobe.bottom.reflectance));
  }
  void operator()(const ClearCoatLobe& lobe) { over_diffuse(lobe.top(), lobe.reflected(wo), mean(lobe.even_albedo(wo))); }
  void operator()(const CoatedConductorLobe& lobe) {
    if (lobe.top.is_specular()) return only(lobe.bottom.ggx);
    const float r = reflectance(lobe.top);
    found.diffuse = 0;
    add_reflection(lobe.top.ggx, wo, r, found);
    add_reflection(lobe.bottom.ggx, wo, 1 - r, found);
  }
  void operator()(const auto&) {}

  void only(const Ggx& ggx) {
    found.diffuse = 0;
    add_reflection(ggx, wo, 1, found);
  }
  void over_diffuse(const DielectricLobe& top, float r, float below) {
    if (top.is_specular() || !(r + below > 0)) return;
    found.diffuse = below / (r + below);
    add_reflection(top.ggx, wo, r / (r + below), found);
  }
  float reflectance(const DielectricLobe& lobe) const {
    return fresnel_dielectric(std::abs(wo.z), wo.z > 0 ? lobe.eta : 1 / lobe.eta);
  }
};

}  // namespace

Highlights Bsdf::highlights(Vec3 wo) const {
  HighlightFinder finder{frame_.to_local(wo)};
  std::visit(finder, lobe_);
  for (Highlight& h : finder.found.glossy) {
    h.axis = normalize(frame_.to_world(h.axis));
    h.tangent = normalize(frame_.to_world(h.tangent));
  }
  return finder.found;
}

Rgb Bsdf::eval(Vec3 wo, Vec3 wi) const {
  const Vec3 o = frame_.to_local(wo), i = frame_.to_local(wi);
  return std::visit([&](const auto& lobe) { return lobe.eval(o, i); }, lobe_);
}

float Bsdf::pdf(Vec3 wo, Vec3 wi) const {
  const Vec3 o = frame_.to_local(wo), i = frame_.to_local(wi);
  return std::visit([&](const auto& lobe) { return lobe.pdf(o, i); }, lobe_);
}

std::optional<BsdfSample> Bsdf::sample(Vec3 wo, float uc, Vec2 u) const {
  const Vec3 o = frame_.to_local(wo);
  auto s = std::visit([&](const auto& lobe) { return lobe.sample(o, uc, u); }, lobe_);
  if (!s || !(s->pdf > 0) || is_black(s->weight)) return std::nullopt;
  s->wi = normalize(frame_.to_world(s->wi));
  return s;
}

std::optional<MirrorPart> Bsdf::mirror_part(Vec3 wo) const {
  const Vec3 o = frame_.to_local(wo);
  const auto mirrored = [o](const auto& lobe) {
    if constexpr (requires { lobe.mirrored(o); }) return lobe.mirrored(o);
    return 0.0f;
  };
  const float f = std::visit(mirrored, lobe_);
  if (f == 0 || f == 1 || !(has_smooth() || transmits())) return std::nullopt;
  return MirrorPart{normalize(frame_.to_world({-o.x, -o.y, o.z})), f};
}

float Bsdf::unbent(Vec3 wo) const {
  if (const auto* pane = std::get_if<ThinDielectricLobe>(&lobe_)) return 1 - pane->mirrored(frame_.to_local(wo));
  return std::holds_alternative<PassThroughLobe>(lobe_) ? 1.0f : 0.0f;
}

bool Bsdf::has_smooth() const {
  return std::visit([](const auto& lobe) { return lobe.has_smooth(); }, lobe_);
}

bool Bsdf::has_exact_pdf() const {
  return !std::holds_alternative<CoatedDiffuseLobe>(lobe_) && !std::holds_alternative<CoatedConductorLobe>(lobe_);
}

bool Bsdf::separable() const {
  if (const auto* coat = std::get_if<ClearCoatLobe>(&lobe_)) return coat->separable();
  return std::holds_alternative<DiffuseLobe>(lobe_) || std::holds_alternative<DiffuseTransmissionLobe>(lobe_);
}

SeparablePart Bsdf::separable_part(Vec3 wo) const {
  const auto* coat = std::get_if<ClearCoatLobe>(&lobe_);
  return coat ? coat->separable_part(frame_.to_local(wo)) : SeparablePart{};
}

bool Bsdf::reflects() const {
  return std::visit([](const auto& lobe) { return lobe.reflects(); }, lobe_);
}

bool Bsdf::transmits() const {
  return std::visit([](const auto& lobe) { return lobe.transmits(); }, lobe_);
}

Rgb Bsdf::albedo(Vec3 wo) const {
  const Vec3 o = frame_.to_local(wo);
  return std::visit([&](const auto& lobe) { return lobe.albedo(o); }, lobe_);
}

}  // namespace tyndall
