#include "surface/bsdf.h"

namespace tyndall {

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
