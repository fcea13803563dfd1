#include "session/scene_check.h"
#include "session/value_check.h"

namespace tyndall {
namespace {

struct PhaseCheck {
  const ValueCheck& check;

  void operator()(const HenyeyGreenstein& p) const { check.number("g", p.g, p.g >= -1 && p.g <= 1, "a number from -1 to 1"); }
  void operator()(const Rayleigh&) const {}
  void operator()(const Draine& p) const {
    check.number("g", p.g(), p.g() > -1 && p.g() < 1, "a number between -1 and 1");
    check.not_negative("alpha", p.alpha());
  }
  void operator()(const Mie& p) const {
    const float diameter = p.parameters()[0];
    check.number("diameter", diameter, diameter > 0 && diameter <= Mie::kLargest, "micrometers above 0 and up to 50");
  }
};

/// Values of voxels are looked at when grids are made of them.
struct MediumCheck {
  const ValueCheck& check;

  void operator()(const HomogeneousMedium& m) const { check.emission("Le", m.Le); }
  void operator()(const UniformGridMedium& m) const {
    box(m.bounds);
    check.emission("Le", m.Le);
    check.not_negative("Le_factor", m.Le_factor);
    check.finite("temperature_scale", m.temperature_scale);
    check.finite("temperature_offset", m.temperature_offset);
  }
  void operator()(const RgbGridMedium& m) const {
    box(m.bounds);
    check.not_negative("scale", m.scale);
  }
  void operator()(const CloudMedium& m) const {
    box(m.bounds);
    check.not_negative("density", m.density);
    check.finite("wispiness", m.wispiness);
    check.finite("frequency", m.frequency);
  }
  void operator()(const VdbMedium& m) const {
    check.emission("Le", m.Le);
    check.not_negative("Le_scale", m.Le_scale);
    check.finite("temperature_scale", m.temperature_scale);
    check.finite("temperature_offset", m.temperature_offset);
  }

 private:
  void box(const Bounds3& bounds) const {
    check.vector("bounds.min", bounds.min);
    check.vector("bounds.max", bounds.max);
    const Vec3 e = bounds.extent();
    check.require(e.x > 0 && e.y > 0 && e.z > 0, "has bounds without a volume; give min below max on every axis");
  }
};

}  // namespace

void check_media(const Scene& scene) {
  for (const Medium& medium : scene.media) {
    const ValueCheck check(medium.where, "medium \"" + medium.name + "\"");
    check.color("sigma_a", medium.optics.sigma_a);
    check.color("sigma_s", medium.optics.sigma_s);
    std::visit(PhaseCheck{check}, medium.optics.phase);
    std::visit(MediumCheck{check}, medium.kind);
  }
}

}  // namespace tyndall
