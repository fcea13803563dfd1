/// pbrt divides every light's spectrum by its photometric Y and then applies "scale", and "power" or "illuminance" in
/// place of the spectrum's own strength. An rgb is a multiple of the colour space's white, whose Y the division
/// makes 1, so `power` with an rgb other than white scales by that rgb too.
#include "io/pbrt_lights.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "io/pbrt_colors.h"
#include "io/pbrt_light_group.h"
#include "io/pbrt_suggest.h"

namespace tyndall::pbrt {
namespace {

/// Photometric strengths ("power", "illuminance") count only when positive, as in pbrt.
std::optional<float> positive(ParamList& params, std::string_view name) {
  const auto value = params.maybe_number(name);
  return value && *value > 0 ? value : std::nullopt;
}

/// The unit direction from "from" to "to" in light space.
Vec3 aim(ParamList& params, Vec3 from, Vec3 to) {
  const Vec3 direction = normalize(to - from);
  if (length_squared(direction) == 0) throw params.error("to", "\"from\" and \"to\" are the same point; move one");
  return direction;
}

PointLight point_light(State& state, ParamList& params) {
  Rgb I = light_color(state, params, "I") * params.not_negative("scale", 1);
  if (const auto power = positive(params, "power")) I *= *power / (4 * kPi);
  return {state.graphics.ctm.point(params.point("from", {0, 0, 0})), I};
}

/// Moves the origin to `from` and +z to the unit vector `z`.
Transform frame_at(Vec3 from, Vec3 z) {
  const Vec3 helper = std::abs(z.x) > std::abs(z.y) ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  const Vec3 x = normalize(cross(helper, z)), y = cross(z, x);
  return Transform(
      Transform::Matrix{{{x.x, y.x, z.x, from.x}, {x.y, y.y, z.y, from.y}, {x.z, y.z, z.z, from.z}, {0, 0, 0, 1}}});
}

SpotLight spot_light(State& state, ParamList& params) {
  SpotLight light;
  light.I = light_color(state, params, "I") * params.not_negative("scale", 1);
  light.cone_angle_degrees = params.number("coneangle", 30);
  const float delta = params.number("conedeltaangle", 5);
  // pbrt takes the cosine of the difference, whatever its sign.
  light.falloff_start_degrees = std::min(std::abs(light.cone_angle_degrees - delta), light.cone_angle_degrees);
  if (!(light.cone_angle_degrees > 0 && light.cone_angle_degrees <= 180))
    throw params.error("coneangle", "coneangle must be above 0 and at most 180 degrees");
  if (delta < 0) throw params.error("conedeltaangle", "conedeltaangle must not be negative");
  if (const auto power = positive(params, "power")) {
    const float end = std::cos(light.cone_angle_degrees * kPi / 180);
    const float start = std::cos(light.falloff_start_degrees * kPi / 180);
    light.I *= *power / (2 * kPi * ((1 - start) + (start - end) / 2));  // the integral of pbrt's smoothstep falloff
  }
  const Vec3 from = params.point("from", {0, 0, 0}), to = params.point("to", {0, 0, 1});
  light.to_world = state.graphics.ctm * frame_at(from, aim(params, from, to));
  return light;
}

std::string light_file(State& state, ParamList& params, const char* what) {
  if (!params.find("filename", {ParamType::string})) throw params.error(params.owner() + " has no \"filename\"; name " + what);
  return resolve_asset(state, params.where("filename"), params.string("filename", ""));
}

GoniometricLight goniometric_light(State& state, ParamList& params) {
  GoniometricLight light;
  light.to_world = state.graphics.ctm;
  light.I = light_color(state, params, "I") * params.not_negative("scale", 1);
  light.path = light_file(state, params, "a square equal-area map or an .ies file");
  light.power = positive(params, "power");
  return light;
}

ProjectionLight projection_light(State& state, ParamList& params) {
  ProjectionLight light;
  light.to_world = state.graphics.ctm;
  light.I = Rgb(params.not_negative("scale", 1));
  light.path = light_file(state, params, "an image to project");
  light.power = positive(params, "power");
  light.fov_degrees = params.number("fov", 90);
  if (!(light.fov_degrees > 0 && light.fov_degrees < 180))
    throw params.error("fov", "fov must be above 0 and below 180 degrees");
  return light;
}

DistantLight distant_light(State& state, ParamList& params) {
  const Rgb E = light_color(state, params, "L") * params.not_negative("scale", 1) * positive(params, "illuminance").value_or(1);
  const Vec3 from = params.point("from", {0, 0, 0}), to = params.point("to", {0, 0, 1});
  return {normalize(state.graphics.ctm.vector(aim(params, from, to))), E};
}

/// In world space, whatever the current transformation.
std::optional<std::array<Vec3, 4>> portal_of(ParamList& params) {
  const std::vector<Vec3> corners = params.triples("portal", ParamType::point3);
  if (corners.empty()) return std::nullopt;
  if (corners.size() != 4)
    throw params.error("portal", "a portal has four corners, not " + std::to_string(corners.size()) +
                                     "; give them in order around the rectangle");
  return std::array<Vec3, 4>{corners[0], corners[1], corners[2], corners[3]};
}

InfiniteLight infinite_light(State& state, ParamList& params) {
  InfiniteLight light;
  light.to_world = state.graphics.ctm;
  light.portal = portal_of(params);
  const float scale = params.not_negative("scale", 1);
  const auto illuminance = positive(params, "illuminance");
  const auto L = find_color(state, params, "L", ColorUse::light);
  if (params.find("filename", {ParamType::string})) {
    if (L) throw params.error("L", "an infinite light takes \"L\" or \"filename\", not both; use \"scale\" with a map");
    light.path = resolve_asset(state, params.where("filename"), params.string("filename", ""));
    light.L = Rgb(scale);
    light.illuminance = illuminance;
    return light;
  }
  const Param* given = params.find("L", {ParamType::rgb, ParamType::spectrum, ParamType::blackbody});
  if (light.portal && (illuminance || (given && given->type != ParamType::rgb)))
    params.reports().warn(
        params.where("portal"),
        "a constant sky behind a portal: \"illuminance\" is that of the whole sky, and spectra have luminance "
        "1; pbrt-v4 has other scales there, and the same for \"rgb L\" alone");
  // A surface under a uniform hemisphere of L receives pi L.
  light.L = light_color(state, params, "L") * scale * (illuminance ? *illuminance / kPi : 1);
  return light;
}

decltype(Light::kind) read_light_kind(State& state, ParamList& params, const std::string& type) {
  if (type == "point") return point_light(state, params);
  if (type == "spot") return spot_light(state, params);
  if (type == "distant") return distant_light(state, params);
  if (type == "infinite") return infinite_light(state, params);
  if (type == "goniometric") return goniometric_light(state, params);
  if (type == "projection") return projection_light(state, params);
  throw params.error("light \"" + printable(type) + "\" is unknown; " +
                     suggestion(type, {"point", "spot", "distant", "infinite", "goniometric", "projection"}));
}

AreaLight read_area_light(State& state, ParamList& params, const std::string& type) {
  if (type != "diffuse")
    throw params.error("area light \"" + printable(type) + "\" is unknown; " + suggestion(type, {"diffuse"}));
  AreaLight light;
  const float scale = params.not_negative("scale", 1);
  const auto L = find_color(state, params, "L", ColorUse::light);
  light.two_sided = params.boolean("twosided", false);
  light.power = positive(params, "power");
  if (params.find("filename", {ParamType::string})) {
    if (L) throw params.error("L", "an area light takes \"L\" or \"filename\", not both; use \"scale\" with an image");
    light.path = resolve_asset(state, params.where("filename"), params.string("filename", ""));
    light.L = Rgb(scale);
  } else {
    light.L = light_color(state, params, "L") * scale;
  }
  return light;
}

}  // namespace

void read_light_source(State& state, Tokenizer& in, const Location& where) {
  const std::string type(in.expect_string("a kind of light, as \"point\"").text);
  ParamList params = read_param_list(state, in, "light \"" + printable(type) + "\"", where, &AttributeDefaults::light);
  usable_ctm(state, where);
  auto kind = read_light_kind(state, params, type);
  std::string group = read_light_group(params);
  params.finish();
  state.scene.lights.push_back({std::move(kind), where, std::move(group)});
}

void read_area_light_source(State& state, Tokenizer& in, const Location& where) {
  const std::string type(in.expect_string("a kind of area light, \"diffuse\"").text);
  ParamList params = read_param_list(state, in, "area light \"" + printable(type) + "\"", where, &AttributeDefaults::light);
  AreaLight light = read_area_light(state, params, type);
  light.group = read_light_group(params);
  params.finish();
  state.graphics.area_light = std::move(light);
}

}  // namespace tyndall::pbrt
