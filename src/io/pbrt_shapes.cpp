#include "io/pbrt_shapes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "io/pbrt_meshes.h"
#include "io/pbrt_suggest.h"
#include "io/pbrt_textures.h"

namespace tyndall::pbrt {
namespace {

float positive(ParamList& params, std::string_view name, float otherwise) {
  const float value = params.number(name, otherwise);
  if (!(value > 0)) throw params.error(name, std::string(name) + " must be above 0");
  return value;
}

float phi_max(ParamList& params) {
  const float phi = params.number("phimax", 360);
  if (!(phi > 0)) throw params.error("phimax", "phimax must be above 0 degrees");
  return std::min(phi, 360.0f);
}

Sphere sphere(ParamList& params) {
  const float r = positive(params, "radius", 1);
  const float z0 = params.number("zmin", -r), z1 = params.number("zmax", r);
  const Sphere s{r, std::clamp(std::min(z0, z1), -r, r), std::clamp(std::max(z0, z1), -r, r), phi_max(params)};
  if (s.z_min == s.z_max)
    throw params.error("zmin", "the sphere is cut away entirely; zmin and zmax must enclose a part of it");
  return s;
}

Disk disk(ParamList& params) {
  const Disk d{params.number("height", 0), positive(params, "radius", 1), params.number("innerradius", 0), phi_max(params)};
  if (d.inner_radius < 0 || d.inner_radius >= d.radius)
    throw params.error("innerradius", "innerradius must be at least 0 and below radius");
  return d;
}

Cylinder cylinder(ParamList& params) {
  const float r = positive(params, "radius", 1);
  const float z0 = params.number("zmin", -1), z1 = params.number("zmax", 1);
  if (z0 == z1) throw params.error("zmin", "the cylinder has no height; zmin and zmax must differ");
  return {r, std::min(z0, z1), std::max(z0, z1), phi_max(params)};
}

using ShapeKind = decltype(Shape::kind);

std::vector<ShapeKind> read_kinds(State& state, ParamList& params, const std::string& type) {
  std::vector<ShapeKind> kinds;
  if (type == "sphere")
    kinds.emplace_back(sphere(params));
  else if (type == "disk")
    kinds.emplace_back(disk(params));
  else if (type == "cylinder")
    kinds.emplace_back(cylinder(params));
  else if (type == "trianglemesh")
    kinds.emplace_back(read_triangle_mesh(params));
  else if (type == "bilinearmesh")
    kinds.emplace_back(read_bilinear_mesh(params));
  else if (type == "plymesh")
    kinds = read_ply_mesh(state, params);
  else if (type == "loopsubdiv")
    kinds.emplace_back(read_loop_subdivision(params));
  else if (type == "curve")
    throw params.error("shape \"" + type + "\" is not supported by Tyndall; convert it to a plymesh");
  else
    throw params.error(
        "shape \"" + printable(type) + "\" is unknown; " +
        suggestion(type, {"trianglemesh", "plymesh", "bilinearmesh", "loopsubdiv", "sphere", "disk", "cylinder"}));
  return kinds;
}

/// The group of the innermost attribute or object block for the media in force; new when the block has none.
std::optional<BoundaryId> boundary_group(State& state) {
  const auto inside = state.graphics.inside, outside = state.graphics.outside;
  if (inside == outside) return std::nullopt;
  const auto block =
      std::find_if(state.blocks.rbegin(), state.blocks.rend(), [](const Block& b) { return b.kind != Block::Kind::import; });
  for (const BlockBoundary& b : block->boundaries)
    if (b.inside == inside && b.outside == outside) return b.id;
  const auto id = static_cast<BoundaryId>(state.scene.boundaries.size());
  state.scene.boundaries.push_back({inside, outside});
  block->boundaries.push_back({inside, outside, id});
  return id;
}

std::optional<AreaLight> emission(State& state, const Location& where) {
  if (!state.graphics.area_light) return std::nullopt;
  if (std::holds_alternative<InterfaceMaterial>(state.scene.materials[state.graphics.material].kind)) {
    state.reports.warn(where, "shapes with material \"interface\" do not emit: their AreaLightSource is ignored");
    return std::nullopt;
  }
  if (state.open_object)
    state.reports.warn(where, "shapes of an object emit, once for each instance; in pbrt-v4 they stay dark");
  return state.graphics.area_light;
}

bool keeps_lengths(const Transform& ctm) {
  const auto is_unit = [&](Vec3 axis) { return std::abs(length(ctm.vector(axis)) - 1) < 1e-4f; };
  return is_unit({1, 0, 0}) && is_unit({0, 1, 0}) && is_unit({0, 0, 1});
}

/// pbrt turns the normal of a mirrored quadric inward, which exchanges its sides (but not where its light is sampled), and
/// knows its area before the transformation only.
void warn_of_transformed_quadric(State& state, const std::vector<ShapeKind>& kinds, const Location& where) {
  const auto& g = state.graphics;
  const bool is_mesh =
      kinds.empty() || std::holds_alternative<TriangleMesh>(kinds[0]) || std::holds_alternative<BilinearMesh>(kinds[0]);
  if (is_mesh) return;
  if (g.area_light && g.area_light->power && !keeps_lengths(g.ctm))
    state.reports.warn(where,
                       "a scaled sphere, disk or cylinder emits \"power\": it emits that much here, in pbrt-v4 that times "
                       "what the scale does to its area; give its size by its radius");
  if (!g.ctm.swaps_handedness()) return;
  if (g.inside != g.outside && !g.reverse_orientation)
    state.reports.warn(where,
                       "a mirrored sphere, disk or cylinder bounds media: pbrt-v4 exchanges its sides, Tyndall keeps the "
                       "inside medium within");
  if (g.area_light && !g.area_light->two_sided)
    state.reports.warn(where,
                       "a mirrored sphere, disk or cylinder emits on one side: pbrt-v4 shows its light on the other side than "
                       "it lights; use \"bool twosided\" true, or do not mirror it");
}

/// A constant of 1 or more is no alpha at all.
std::optional<TextureId> read_alpha(State& state, ParamList& params) {
  const auto alpha = find_float_texture(state, params, "alpha");
  if (!alpha) return std::nullopt;
  const auto* constant = std::get_if<ConstantTexture>(&state.scene.textures[*alpha].kind);
  return constant && constant->value.r >= 1 ? std::nullopt : alpha;
}

/// pbrt takes a share of the rays that meet such an emitter away, and then that share of their emission again.
void warn_of_transparent_emitter(State& state, const std::optional<TextureId>& alpha, const Location& where) {
  if (!alpha || !state.graphics.area_light) return;
  const auto* constant = std::get_if<ConstantTexture>(&state.scene.textures[*alpha].kind);
  if (constant && constant->value.r <= 0) return;
  state.reports.warn(where,
                     "alpha of an emitting shape weighs its emission once, where pbrt-v4 does so twice for rays that meet it "
                     "and once for light sampling: it looks brighter here where it is partly transparent");
}

/// The name that mattes know the object by: as given, else a mesh file's own, but in an object, which has a name.
std::string read_name(State& state, ParamList& params, const std::string& type) {
  if (params.find("name", {ParamType::string})) {
    const std::string name = params.string("name", "");
    if (name.empty()) throw params.error("name", "the name is empty; name the object, or leave it out");
    return name;
  }
  if (type != "plymesh" || state.open_object) return {};
  std::filesystem::path file = params.string("filename", "");
  while (file.extension() == ".gz" || file.extension() == ".ply") file = file.stem();
  return file.filename().string();
}

}  // namespace

void read_shape(State& state, Tokenizer& in, const Location& where) {
  const std::string type(in.expect_string("a kind of shape, as \"sphere\"").text);
  ParamList params = read_param_list(state, in, "shape \"" + printable(type) + "\"", where, &AttributeDefaults::shape);
  std::vector<ShapeKind> kinds = read_kinds(state, params, type);
  const auto alpha = read_alpha(state, params);
  const std::string name = read_name(state, params, type);
  params.finish();
  const Transform& to_world = usable_ctm(state, where);
  warn_of_transformed_quadric(state, kinds, where);
  warn_of_transparent_emitter(state, alpha, where);

  auto& shapes = state.open_object ? state.scene.objects[*state.open_object].shapes : state.scene.shapes;
  for (ShapeKind& kind : kinds) {
    Shape& shape = shapes.emplace_back();
    shape.kind = std::move(kind);
    shape.to_world = to_world;
    shape.reverse_orientation = state.graphics.reverse_orientation;
    shape.material = state.graphics.material;
    shape.emission = emission(state, where);
    shape.boundary = boundary_group(state);
    shape.alpha = alpha;
    shape.where = where;
    shape.name = name;
  }
}

}  // namespace tyndall::pbrt
