#include "surface/bsdf.h"

namespace tyndall {
namespace {

struct HighlightFinder {
  Vec3 wo;  ///< local
  Highlights found{};

  void operator()(const ConductorLobe& lobe) { add_reflection(lobe.ggx, wo, found); }
  void operator()(const DielectricLobe& lobe) {
    if (lobe.is_specular()) return;
    add_reflection(lobe.ggx, wo, found);
    add_transmission(lobe.ggx, lobe.eta, wo, found);
  }
  void operator()(const CoatedDiffuseLobe& lobe) { (*this)(lobe.top.ggx); }
  void operator()(const CoatedConductorLobe& lobe) {
    (*this)(lobe.top.ggx);
    if (found.empty()) add_reflection(lobe.bottom.ggx, wo, found);
  }
  void operator()(const Ggx& ggx) { add_reflection(ggx, wo, found); }
  void operator()(const auto&) {}
};

}  // namespace

Highlights Bsdf::highlights(Vec3 wo) const {
  HighlightFinder finder{frame_.to_local(wo)};
  std::visit(finder, lobe_);
  for (Highlight& h : finder.found) h.axis = normalize(frame_.to_world(h.axis));
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

bool Bsdf::has_smooth() const {
  return std::visit([](const auto& lobe) { return lobe.has_smooth(); }, lobe_);
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
