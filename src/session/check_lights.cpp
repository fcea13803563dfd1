#include "session/scene_check.h"
#include "session/value_check.h"

namespace tyndall {
namespace {

struct LightCheck {
  const Location& where;

  ValueCheck of(const char* owner) const { return {where, owner}; }

  void operator()(const PointLight& l) const {
    const ValueCheck check = of("the point light");
    check.vector("position", l.position);
    check.emission("I", l.I);
  }
  void operator()(const SpotLight& l) const {
    const ValueCheck check = of("the spot light");
    const float cone = l.cone_angle_degrees, start = l.falloff_start_degrees;
    check.emission("I", l.I);
    check.number("cone_angle_degrees", cone, cone > 0 && cone <= 180, "degrees above 0 and up to 180");
    check.number("falloff_start_degrees", start, start >= 0 && start <= cone, "degrees from 0 to cone_angle_degrees");
  }
  void operator()(const DistantLight& l) const {
    const ValueCheck check = of("the distant light");
    check.direction("direction", l.direction);
    check.emission("E", l.E);
  }
  void operator()(const InfiniteLight& l) const {
    const ValueCheck check = of("the infinite light");
    check.emission("L", l.L);
    check.all_finite("to_rec709", l.to_rec709);
    if (l.illuminance) check.not_negative("illuminance", *l.illuminance);
    if (l.portal)
      for (const Vec3& corner : *l.portal) check.vector("a corner of its portal at", corner);
  }
  void operator()(const GoniometricLight& l) const {
    const ValueCheck check = of("the goniometric light");
    check.emission("I", l.I);
    if (l.power) check.not_negative("power", *l.power);
  }
  void operator()(const ProjectionLight& l) const {
    const ValueCheck check = of("the projection light");
    check.emission("I", l.I);
    check.number("fov_degrees", l.fov_degrees, l.fov_degrees > 0 && l.fov_degrees < 180, "degrees above 0 and below 180");
    if (l.power) check.not_negative("power", *l.power);
  }
};

void check_emission(const Shape& shape) {
  if (!shape.emission) return;
  const ValueCheck check(shape.where, "the area light");
  check.emission("L", shape.emission->L);
  check.all_finite("to_rec709", shape.emission->to_rec709);
  if (shape.emission->power) check.not_negative("power", *shape.emission->power);
}

}  // namespace

void check_lights(const Scene& scene) {
  for (const Light& light : scene.lights) std::visit(LightCheck{light.where}, light.kind);
  for (const Shape& shape : scene.shapes) check_emission(shape);
  for (const Object& object : scene.objects)
    for (const Shape& shape : object.shapes) check_emission(shape);
}

}  // namespace tyndall
