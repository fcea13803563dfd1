#include "io/pbrt_materials.h"

#include <string>
#include <utility>

#include "io/pbrt_suggest.h"
#include "io/pbrt_textures.h"

namespace tyndall::pbrt {
namespace {

using MaterialKind = decltype(Material::kind);

struct Range {
  float low, high;
};
constexpr Range kNotNegative{0, kInfinity}, kShare{0, 1};

/// Values out of `range` are taken for its ends; of a constant that is said.
std::optional<TextureId> find_within(State& state, ParamList& params, std::string_view name, Range range) {
  const auto id = find_float_texture(state, params, name);
  const auto* constant = id ? std::get_if<ConstantTexture>(&state.scene.textures[*id].kind) : nullptr;
  if (constant && (constant->value.r < range.low || constant->value.r > range.high))
    params.reports().warn(params.where(name), "\"" + std::string(name) + "\" of " + params.owner() +
                                                  " is beyond what it can be; the nearest value is taken");
  return id;
}

TextureId number_within(State& state, ParamList& params, std::string_view name, Range range, float otherwise) {
  const auto given = find_within(state, params, name, range);
  return given ? *given : constant_texture(state, Rgb(otherwise));
}

/// `prefix` + "roughness", "uroughness", "vroughness"; pbrt's default is smooth.
Roughness read_roughness(State& state, ParamList& params, std::array<std::string_view, 3> names) {
  const auto both = find_within(state, params, names[0], kNotNegative);
  const auto u = find_within(state, params, names[1], kNotNegative);
  const auto v = find_within(state, params, names[2], kNotNegative);
  const TextureId rest = both ? *both : constant_texture(state, Rgb(0.0f));
  return {u.value_or(rest), v.value_or(rest), params.boolean("remaproughness", true)};
}

Roughness read_roughness(State& state, ParamList& params) {
  return read_roughness(state, params, {"roughness", "uroughness", "vroughness"});
}

/// A spectrum for conductor_rgb, unless the parameter is an rgb or a texture.
std::optional<Spectrum> metal_spectrum(State& state, const Param* p, const char* otherwise) {
  if (!p) return named_spectrum(otherwise);
  if (p->type == ParamType::spectrum) return to_spectrum(state, *p);
  return std::nullopt;
}

ConductorOptics read_conductor(State& state, ParamList& params, std::string_view eta_name, std::string_view k_name) {
  ConductorOptics optics;
  optics.reflectance = find_color_texture(state, params, "reflectance", ColorUse::albedo);
  const Param* eta = params.find(eta_name, kColorTextureTypes);
  const Param* k = params.find(k_name, kColorTextureTypes);
  if (optics.reflectance) {
    if (eta || k)
      throw params.error("reflectance", "a conductor takes \"reflectance\" or \"" + std::string(eta_name) + "\" and \"" +
                                            std::string(k_name) + "\", not both; remove one");
    return optics;
  }
  const auto eta_spectrum = metal_spectrum(state, eta, "metal-Cu-eta");
  const auto k_spectrum = metal_spectrum(state, k, "metal-Cu-k");
  if (eta_spectrum && k_spectrum) {
    const ConductorRgb metal = conductor_rgb(*eta_spectrum, *k_spectrum);
    optics.eta = constant_texture(state, metal.eta);
    optics.k = constant_texture(state, metal.k);
    return optics;
  }
  const auto part = [&](std::string_view name, const std::optional<Spectrum>& spectrum) {
    const auto given = find_color_texture(state, params, name, ColorUse::unbounded);
    return given ? *given : constant_texture(state, reflectance_rgb(*spectrum));
  };
  optics.eta = part(eta_name, eta_spectrum);
  optics.k = part(k_name, k_spectrum);
  return optics;
}

Coating read_coating(State& state, ParamList& params, Roughness roughness, std::string_view eta_name) {
  Coating c{};
  c.roughness = roughness;
  c.thickness = number_within(state, params, "thickness", kNotNegative, 0.01f);
  c.eta = find_eta(state, params, eta_name);
  c.g = number_within(state, params, "g", {-1, 1}, 0);
  c.albedo = color_texture(state, params, "albedo", Rgb(0.0f));
  c.max_depth = params.integer("maxdepth", 10);
  c.samples = params.integer("nsamples", 1);
  if (c.max_depth < 1) throw params.error("maxdepth", "maxdepth must be at least 1");
  if (c.samples < 1) throw params.error("nsamples", "nsamples must be at least 1");
  return c;
}

MixMaterial read_mix(State& state, ParamList& params) {
  const std::vector<std::string> names = params.strings("materials");
  if (names.size() != 2) throw params.error("materials", "a mix takes two names in \"string materials\"");
  MaterialId ids[2];
  for (int i = 0; i < 2; ++i) {
    const auto it = state.materials.find(names[i]);
    if (it == state.materials.end())
      throw params.error("materials", "material \"" + printable(names[i]) +
                                          "\" is not defined; define it with MakeNamedMaterial before (" +
                                          suggestion(names[i], names_of(state.materials)) + ")");
    ids[i] = it->second;
  }
  return {ids[0], ids[1], number_within(state, params, "amount", kShare, 0.5f)};
}

DiffuseTransmissionMaterial read_diffuse_transmission(State& state, ParamList& params) {
  return {color_texture(state, params, "reflectance", Rgb(0.25f)), color_texture(state, params, "transmittance", Rgb(0.25f)),
          params.not_negative("scale", 1)};
}

CoatedConductorMaterial read_coated_conductor(State& state, ParamList& params) {
  CoatedConductorMaterial m{};
  m.optics = read_conductor(state, params, "conductor.eta", "conductor.k");
  m.conductor_roughness =
      read_roughness(state, params, {"conductor.roughness", "conductor.uroughness", "conductor.vroughness"});
  const Roughness interface =
      read_roughness(state, params, {"interface.roughness", "interface.uroughness", "interface.vroughness"});
  m.coating = read_coating(state, params, interface, "interface.eta");
  return m;
}

DielectricMaterial read_dielectric(State& state, ParamList& params) {
  const RefractiveIndex index = find_refractive_index(state, params, "eta");
  if (index.rgb)
    params.reports().warn(params.where("eta"),
                          "index of refraction varies with wavelength: red, green and blue are refracted each in one "
                          "direction, where pbrt-v4 has one for each wavelength");
  return {index.eta, read_roughness(state, params), index.rgb};
}

MaterialKind read_material_kind(State& state, ParamList& params, const std::string& type) {
  if (type == "diffuse") return DiffuseMaterial{color_texture(state, params, "reflectance", Rgb(0.5f))};
  if (type == "conductor") return ConductorMaterial{read_conductor(state, params, "eta", "k"), read_roughness(state, params)};
  if (type == "dielectric") return read_dielectric(state, params);
  if (type == "thindielectric") return ThinDielectricMaterial{find_eta(state, params, "eta")};
  if (type == "diffusetransmission") return read_diffuse_transmission(state, params);
  if (type == "coateddiffuse")
    return CoatedDiffuseMaterial{color_texture(state, params, "reflectance", Rgb(0.5f)),
                                 read_coating(state, params, read_roughness(state, params), "eta")};
  if (type == "coatedconductor") return read_coated_conductor(state, params);
  if (type == "mix") return read_mix(state, params);
  if (type == "interface" || type == "none" || type.empty()) return InterfaceMaterial{};
  for (const char* other : {"hair", "measured", "subsurface"})
    if (type == other)
      throw params.error("material \"" + type +
                         "\" is not supported by Tyndall; use coateddiffuse or a dielectric around a medium");
  throw params.error("material \"" + printable(type) + "\" is unknown; " +
                     suggestion(type, {"diffuse", "conductor", "dielectric", "thindielectric", "diffusetransmission",
                                       "coateddiffuse", "coatedconductor", "mix", "interface"}));
}

/// The one texture of a file of normals, which hold numbers however it is encoded.
TextureId normal_map(State& state, ParamList& params) {
  const std::string path = resolve_asset(state, params.where("normalmap"), params.string("normalmap", ""));
  const auto found = state.normal_maps.find(path);
  if (found != state.normal_maps.end()) return found->second;
  if (is_always_srgb_in_pbrt(path))
    params.reports().warn(params.where("normalmap"),
                          "the map's normals are the numbers that it stores; pbrt-v4 takes .jpg, .tga and .bmp for sRGB, which "
                          "bends them");
  ImageTexture image;
  image.path = path;
  image.encoding = "linear";
  image.is_data = true;
  const auto id = static_cast<TextureId>(state.scene.textures.size());
  state.scene.textures.push_back({std::move(image), params.where("normalmap")});
  return state.normal_maps[path] = id;
}

/// What bends the normals of a material of any kind but those that have none themselves.
void read_bending(State& state, ParamList& params, Material& material) {
  if (std::holds_alternative<MixMaterial>(material.kind) || std::holds_alternative<InterfaceMaterial>(material.kind)) {
    params.ignore("displacement", {ParamType::number, ParamType::texture}, "a mix has those of its materials");
    params.ignore("normalmap", {ParamType::string}, "a mix has those of its materials");
    return;
  }
  const auto height = find_float_texture(state, params, "displacement");
  if (height && !std::holds_alternative<ConstantTexture>(state.scene.textures[*height].kind)) material.displacement = height;
  if (!params.find("normalmap", {ParamType::string})) return;
  material.normal_map = normal_map(state, params);
  if (height) params.ignore("displacement", {ParamType::number, ParamType::texture}, "the material has a normal map");
  material.displacement.reset();
}

Material read_checked_material(State& state, ParamList& params, const std::string& type) {
  Material material;
  material.kind = read_material_kind(state, params, type);
  read_bending(state, params, material);
  params.finish();
  material.where = params.where();
  return material;
}

MaterialId add_material(State& state, Material material) {
  state.scene.materials.push_back(std::move(material));
  return static_cast<MaterialId>(state.scene.materials.size() - 1);
}

/// Unnamed plain materials of equal content are one.
MaterialId shared_material(State& state, Material material) {
  if (material.displacement || material.normal_map) return add_material(state, std::move(material));
  if (const auto* diffuse = std::get_if<DiffuseMaterial>(&material.kind)) {
    const TextureId reflectance = diffuse->reflectance;
    const auto it = state.diffuse_materials.find(reflectance);
    if (it != state.diffuse_materials.end()) return it->second;
    return state.diffuse_materials[reflectance] = add_material(state, std::move(material));
  }
  if (std::holds_alternative<InterfaceMaterial>(material.kind)) {
    if (!state.interface_material) state.interface_material = add_material(state, std::move(material));
    return *state.interface_material;
  }
  return add_material(state, std::move(material));
}

}  // namespace

void read_material(State& state, Tokenizer& in, const Location& where) {
  const std::string type(in.expect_string("a kind of material, as \"diffuse\"").text);
  ParamList params = read_param_list(state, in, "material \"" + printable(type) + "\"", where, &AttributeDefaults::material);
  state.graphics.material = shared_material(state, read_checked_material(state, params, type));
}

void read_make_named_material(State& state, Tokenizer& in, const Location& where) {
  const std::string name(in.expect_string("a material name").text);
  ParamList params = read_param_list(state, in, "material \"" + printable(name) + "\"", where, &AttributeDefaults::material);
  if (state.materials.contains(name)) throw Error(where, "material \"" + printable(name) + "\" is defined twice; rename one");
  try {
    const std::string type = params.string("type", "?");
    if (type == "?") throw params.error("material \"" + printable(name) + "\" has no type; add \"string type\"");
    Material material = read_checked_material(state, params, type);
    material.name = name;
    state.materials[name] = add_material(state, std::move(material));
  } catch (const Error&) {
    state.materials.try_emplace(name, 0);  // the default, so that its users are not reported as well
    throw;
  }
}

void read_named_material(State& state, Tokenizer& in, const Location& where) {
  const Token name = in.expect_string("a material name");
  const auto it = state.materials.find(std::string(name.text));
  if (it == state.materials.end())
    throw in.error(name.at, "material \"" + printable(name.text) +
                                "\" is not defined; define it with MakeNamedMaterial before line " +
                                std::to_string(where.line) + " (" + suggestion(name.text, names_of(state.materials)) + ")");
  state.graphics.material = it->second;
}

}  // namespace tyndall::pbrt
