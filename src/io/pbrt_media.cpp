#include "io/pbrt_media.h"

#include <cmath>
#include <string>
#include <utility>

#include "io/pbrt_colors.h"
#include "io/pbrt_light_group.h"
#include "io/pbrt_medium_presets.h"
#include "io/pbrt_phase.h"
#include "io/pbrt_suggest.h"

namespace tyndall::pbrt {
namespace {

/// Integral of the CIE 1931 ybar over 360..830 nm in pbrt's steps. pbrt scales its illuminants to it, and divides
/// it out of a light's spectrum, but not out of the emission of an rgbgrid.
constexpr float kCieYIntegral = 106.856895f;

/// `value` as the parameter `name` gives it.
Rgb scaled(ParamList& params, std::string_view name, Rgb value, float scale) {
  if (is_finite(value * scale)) return value * scale;
  throw params.error(name, std::string(name) + " times its scale is more than a number can hold; lower one");
}

MediumOptics read_optics(State& state, ParamList& params, float scale) {
  const auto sigma = [&](std::string_view name) {
    return scaled(params, name, find_color(state, params, name, ColorUse::unbounded).value_or(Rgb(1.0f)), scale);
  };
  return {sigma("sigma_a"), sigma("sigma_s"), read_phase(params)};
}

Bounds3 read_bounds(ParamList& params) {
  const Vec3 p0 = params.point("p0", {0, 0, 0}), p1 = params.point("p1", {1, 1, 1});
  const Bounds3 bounds{tyndall::min(p0, p1), tyndall::max(p0, p1)};
  const Vec3 extent = bounds.extent();
  if (!(extent.x > 0 && extent.y > 0 && extent.z > 0))
    throw params.error("p0", "the box from p0 to p1 is empty; move its corners apart");
  return bounds;
}

struct GridSize {
  int nx, ny, nz;
};

GridSize read_grid_size(ParamList& params) {
  const GridSize n{params.integer("nx", 1), params.integer("ny", 1), params.integer("nz", 1)};
  for (const auto& [name, value] : {std::pair{"nx", n.nx}, {"ny", n.ny}, {"nz", n.nz}})
    if (value < 1) throw params.error(name, std::string(name) + " must be at least 1");
  return n;
}

void check_size(ParamList& params, std::string_view name, std::size_t values, GridSize n) {
  // In double: three 32-bit factors can exceed 64 bits.
  const double expected = double(n.nx) * n.ny * n.nz;
  if (values != 0 && static_cast<double>(values) != expected)
    throw params.error(name, "\"" + std::string(name) + "\" has " + std::to_string(values) + " values; nx*ny*nz is " +
                                 std::to_string(n.nx) + "*" + std::to_string(n.ny) + "*" + std::to_string(n.nz));
}

void check_not_negative(ParamList& params, std::string_view name, const std::vector<float>& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] < 0)
      throw params.error(name, "\"" + std::string(name) + "\" is negative at index " + std::to_string(i) + "; use values >= 0");
}

/// pbrt's temperatureoffset; temperaturecutoff is its older name.
float read_temperature_offset(ParamList& params) {
  return params.number("temperatureoffset", params.number("temperaturecutoff", 0));
}

Medium homogeneous(State& state, ParamList& params) {
  Medium m;
  const float scale = params.not_negative("scale", 1);
  const std::string preset = params.string("preset", "");
  m.optics = read_optics(state, params, scale);
  if (!preset.empty()) {
    const MediumPreset* found = find_medium_preset(preset);
    if (!found)
      throw params.error(
          "preset", "medium preset \"" + printable(preset) + "\" is unknown; " + suggestion(preset, medium_preset_names()));
    for (const char* sigma : {"sigma_a", "sigma_s"})
      if (params.find(sigma, {ParamType::rgb, ParamType::spectrum, ParamType::blackbody}))
        throw params.error(sigma, "a medium takes a preset or its own coefficients, not both; remove one");
    m.optics.sigma_a = scaled(params, "preset", found->sigma_a, scale);
    m.optics.sigma_s = scaled(params, "preset", found->sigma_s, scale);
  }
  const float Le_scale = params.not_negative("Lescale", 1);
  const Rgb Le = find_color(state, params, "Le", ColorUse::light).value_or(Rgb(0.0f));
  m.kind = HomogeneousMedium{scaled(params, "Le", Le, Le_scale)};
  return m;
}

Medium uniform_grid(State& state, ParamList& params) {
  UniformGridMedium g;
  const GridSize n = read_grid_size(params);
  g.nx = n.nx, g.ny = n.ny, g.nz = n.nz;
  g.bounds = read_bounds(params);
  g.density = params.numbers("density");
  if (g.density.empty()) throw params.error("a uniformgrid medium has no density; add \"float density\" with nx*ny*nz values");
  g.temperature = params.numbers("temperature");
  g.Le_scale = params.numbers("Lescale");
  for (const auto& [name, values] :
       {std::pair{"density", &g.density}, {"temperature", &g.temperature}, {"Lescale", &g.Le_scale}})
    check_size(params, name, values->size(), n);
  check_not_negative(params, "density", g.density);
  check_not_negative(params, "Lescale", g.Le_scale);
  const auto Le = find_color(state, params, "Le", ColorUse::light);
  if (Le && !g.temperature.empty()) throw params.error("Le", "a medium takes \"Le\" or \"temperature\", not both; remove one");
  g.Le = Le.value_or(Rgb(0.0f));
  g.temperature_offset = read_temperature_offset(params);
  g.temperature_scale = params.number("temperaturescale", 1);
  Medium m;
  m.optics = read_optics(state, params, params.not_negative("scale", 1));
  m.kind = std::move(g);
  return m;
}

Medium rgb_grid(State&, ParamList& params) {
  RgbGridMedium g;
  const GridSize n = read_grid_size(params);
  g.nx = n.nx, g.ny = n.ny, g.nz = n.nz;
  g.bounds = read_bounds(params);
  g.sigma_a = find_colors(params, "sigma_a", ColorUse::unbounded);
  g.sigma_s = find_colors(params, "sigma_s", ColorUse::unbounded);
  g.Le = find_colors(params, "Le", ColorUse::light);
  for (const auto& [name, values] : {std::pair{"sigma_a", &g.sigma_a}, {"sigma_s", &g.sigma_s}, {"Le", &g.Le}})
    check_size(params, name, values->size(), n);
  if (g.sigma_a.empty() && g.sigma_s.empty())
    throw params.error("an rgbgrid medium has neither sigma_a nor sigma_s; add one of them");
  if (!g.Le.empty() && g.sigma_a.empty()) throw params.error("Le", "\"Le\" of an rgbgrid needs \"sigma_a\"; add it");
  const float Le_scale = params.not_negative("Lescale", 1) * kCieYIntegral;
  for (Rgb& Le : g.Le) Le = scaled(params, "Le", Le, Le_scale);
  g.scale = params.not_negative("scale", 1);
  Medium m;
  m.optics.phase = read_phase(params);
  m.kind = std::move(g);
  return m;
}

Medium cloud(State& state, ParamList& params) {
  CloudMedium c;
  c.bounds = read_bounds(params);
  c.density = params.not_negative("density", 1);
  c.wispiness = params.number("wispiness", 1);
  c.frequency = params.number("frequency", 5);
  Medium m;
  m.optics = read_optics(state, params, 1);
  m.kind = c;
  return m;
}

Medium vdb(State& state, ParamList& params) {
  VdbMedium v;
  v.path = resolve_asset(state, params.where("filename"), params.string("filename", ""));
  v.density_grid_given = params.find("gridname", {ParamType::string}) != nullptr;
  v.density_grid = params.string("gridname", "density");
  v.temperature_grid_given = params.find("temperaturename", {ParamType::string}) != nullptr;
  v.temperature_grid = params.string("temperaturename", "temperature");
  v.flame_grid = params.string("flamename", "");
  v.temperature_offset = read_temperature_offset(params);
  v.temperature_scale = params.number("temperaturescale", 1);
  v.Le_scale = params.not_negative("Lescale", 1);
  const auto Le = find_color(state, params, "Le", ColorUse::light);
  v.Le = Le.value_or(Rgb(1.0f));
  v.emission_given = Le || v.temperature_grid_given || params.find("Lescale", {ParamType::number}) ||
                     params.find("temperaturescale", {ParamType::number});
  Medium m;
  m.optics = read_optics(state, params, params.not_negative("scale", 1));
  m.kind = std::move(v);
  return m;
}

Medium read_medium(State& state, ParamList& params) {
  const std::string type = params.string("type", "");
  const std::vector<std::string> known{"homogeneous", "uniformgrid", "rgbgrid", "cloud", "nanovdb", "openvdb"};
  if (type.empty()) throw params.error("medium has no type; add \"string type\", " + suggestion("", known));
  if (type == "homogeneous") return homogeneous(state, params);
  if (type == "uniformgrid") return uniform_grid(state, params);
  if (type == "rgbgrid") return rgb_grid(state, params);
  if (type == "cloud") return cloud(state, params);
  if (type == "nanovdb" || type == "openvdb") return vdb(state, params);
  throw params.error("type", "medium type \"" + printable(type) + "\" is unknown; " + suggestion(type, known));
}

std::optional<MediumId> medium_named(const State& state, const Tokenizer& in, const Token& name) {
  if (name.text.empty()) return std::nullopt;
  const auto it = state.media.find(std::string(name.text));
  if (it != state.media.end()) return it->second;
  throw in.error(name.at, "medium \"" + printable(name.text) +
                              "\" is not defined; define it with MakeNamedMedium before line " + std::to_string(name.at.line) +
                              " (" + suggestion(name.text, names_of(state.media)) + ")");
}

}  // namespace

void read_make_named_medium(State& state, Tokenizer& in, const Location& where) {
  const std::string name(in.expect_string("a medium name").text);
  ParamList params = read_param_list(state, in, "medium \"" + printable(name) + "\"", where, &AttributeDefaults::medium);
  if (name.empty()) throw Error(where, "a medium needs a name; \"\" stands for no medium");
  if (state.media.contains(name)) throw Error(where, "medium \"" + printable(name) + "\" is defined twice; rename one");
  const auto add = [&](Medium medium) {
    medium.name = name;
    medium.where = where;
    const bool placed = !std::holds_alternative<HomogeneousMedium>(medium.kind);
    medium.to_world = placed ? usable_ctm(state, where) : state.graphics.ctm;
    state.media[name] = static_cast<MediumId>(state.scene.media.size());
    state.scene.media.push_back(std::move(medium));
  };
  try {
    Medium medium = read_medium(state, params);
    medium.group = read_light_group(params);
    params.finish();
    if (!std::holds_alternative<HomogeneousMedium>(medium.kind) && !state.coordinate_systems.contains("camera") &&
        !state.in_world && !state.render_in_world_space)
      state.reports.warn(where,
                         "a medium made before Camera stands in the world; pbrt-v4 moves it along with the camera's position "
                         "unless Option \"rendercoordsys\" is \"world\"");
    add(std::move(medium));
  } catch (const Error&) {
    add({});  // so that its users are not reported as well
    throw;
  }
}

void read_medium_interface(State& state, Tokenizer& in, const Location&) {
  const Token inside = in.expect_string("the name of the inside medium");
  const Token outside = in.peek().is(Token::Kind::string) ? in.next() : inside;
  const auto inside_id = medium_named(state, in, inside), outside_id = medium_named(state, in, outside);
  state.graphics.inside = inside_id;
  state.graphics.outside = outside_id;
}

}  // namespace tyndall::pbrt
