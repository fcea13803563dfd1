#include "io/pbrt_textures.h"

#include <utility>

#include "io/pbrt_suggest.h"

namespace tyndall::pbrt {
namespace {

/// Scalars and colours are the same thing but for the types and the table of names.
enum class Content { scalar, color };

TextureId operand(State& state, ParamList& params, Content content, std::string_view name, float otherwise) {
  return content == Content::scalar ? float_texture(state, params, name, otherwise)
                                    : color_texture(state, params, name, Rgb(otherwise));
}

const char* type_of(Content content) { return content == Content::scalar ? "float" : "spectrum"; }

TextureId look_up(State& state, const Param& p, Content content) {
  const bool scalar = content == Content::scalar;
  const auto& table = scalar ? state.float_textures : state.spectrum_textures;
  const auto& other = scalar ? state.spectrum_textures : state.float_textures;
  const std::string kind = type_of(content), other_kind = type_of(scalar ? Content::color : Content::scalar);
  if (p.strings.size() != 1) throw Error(p.where, "parameter \"" + p.name + "\" names more than one texture; give one");
  const std::string& name = p.strings[0];
  if (const auto it = table.find(name); it != table.end()) {
    if (const auto place = state.named_texture_places.find(kind + name); place != state.named_texture_places.end())
      state.named_textures[place->second].used = true;
    return it->second;
  }
  if (other.contains(name))
    throw Error(p.where, "texture \"" + printable(name) + "\" is a " + other_kind + " texture, and \"" + p.name +
                             "\" takes a " + kind + " texture; declare it as \"" + kind + "\"");
  throw Error(p.where, kind + " texture \"" + printable(name) + "\" is not defined; define it with Texture before line " +
                           std::to_string(p.where.line) + " (" + suggestion(name, names_of(table)) + ")");
}

TextureMapping read_mapping(State& state, ParamList& params) {
  using Kind = TextureMapping::Kind;
  TextureMapping m;
  const std::string kind = params.choice("mapping", "uv", {"uv", "spherical", "cylindrical", "planar"});
  m.kind = kind == "uv"            ? Kind::uv
           : kind == "spherical"   ? Kind::spherical
           : kind == "cylindrical" ? Kind::cylindrical
                                   : Kind::planar;
  m.scale = {params.number("uscale", 1), params.number("vscale", 1)};
  m.offset = {params.number("udelta", 0), params.number("vdelta", 0)};
  m.v1 = params.vector("v1", {1, 0, 0});
  m.v2 = params.vector("v2", {0, 1, 0});
  if (m.kind != Kind::uv || !state.graphics.singular) m.to_texture = usable_ctm(state, params.where()).inverse();
  return m;
}

ConstantTexture read_constant(State& state, ParamList& params, Content content) {
  if (content == Content::scalar) return {Rgb(params.number("value", 1))};
  return {find_color(state, params, "value", ColorUse::unbounded).value_or(Rgb(1.0f))};
}

ScaleTexture read_scale(State& state, ParamList& params, Content content) {
  return {operand(state, params, content, "tex", 1), float_texture(state, params, "scale", 1)};
}

MixTexture read_mix(State& state, ParamList& params, Content content) {
  return {operand(state, params, content, "tex1", 0), operand(state, params, content, "tex2", 1),
          float_texture(state, params, "amount", 0.5f)};
}

/// pbrt takes these for sRGB always.
void warn_of_encoding(ParamList& params, const ImageTexture& t) {
  if (t.encoding.empty() || t.encoding == "sRGB" || !is_always_srgb_in_pbrt(t.path)) return;
  params.reports().warn(params.where("encoding"),
                        "the image is decoded as its encoding says; pbrt-v4 takes .jpg, .tga and .bmp for sRGB all the same");
}

ImageTexture read_image_map(State& state, ParamList& params, Content) {
  ImageTexture t;
  t.mapping = read_mapping(state, params);
  t.path = resolve_asset(state, params.where("filename"), params.string("filename", ""));
  t.scale = params.number("scale", 1);
  t.invert = params.boolean("invert", false);
  const std::string wrap = params.choice("wrap", "repeat", {"repeat", "black", "clamp", "octahedralsphere"});
  t.wrap = wrap == "repeat"  ? ImageTexture::Wrap::repeat
           : wrap == "black" ? ImageTexture::Wrap::black
           : wrap == "clamp" ? ImageTexture::Wrap::clamp
                             : ImageTexture::Wrap::octahedral;
  const std::string filter = params.choice("filter", "bilinear", {"point", "bilinear", "trilinear", "ewa", "EWA"});
  using Filter = ImageTexture::Filter;
  t.filter = filter == "point"       ? Filter::point
             : filter == "bilinear"  ? Filter::bilinear
             : filter == "trilinear" ? Filter::trilinear
                                     : Filter::elliptical;
  t.max_anisotropy = params.number("maxanisotropy", 8);
  if (!(t.max_anisotropy >= 1 && t.max_anisotropy <= 100))
    throw params.error("maxanisotropy", "maxanisotropy must be from 1 to 100");
  t.encoding = params.string("encoding", "");
  if (!t.encoding.empty() && t.encoding != "sRGB" && t.encoding != "linear" && !t.encoding.starts_with("gamma "))
    throw params.error("encoding", "encoding \"" + printable(t.encoding) + "\" is unknown; use sRGB, linear or \"gamma 2.2\"");
  warn_of_encoding(params, t);
  return t;
}

CheckerboardTexture read_checkerboard(State& state, ParamList& params, Content content) {
  CheckerboardTexture t{};
  t.dimension = params.integer("dimension", 2);
  if (t.dimension != 2 && t.dimension != 3) throw params.error("dimension", "a checkerboard has dimension 2 or 3");
  t.mapping = read_mapping(state, params);
  if (t.dimension == 3) usable_ctm(state, params.where());
  t.first = operand(state, params, content, "tex1", 1);
  t.second = operand(state, params, content, "tex2", 0);
  return t;
}

/// pbrt hands the two over in the wrong order, and scenes are made to look right there: "inside" is what lies around the dots.
DotsTexture read_dots(State& state, ParamList& params, Content content) {
  DotsTexture t{};
  t.mapping = read_mapping(state, params);
  t.outside = operand(state, params, content, "inside", 1);
  t.inside = operand(state, params, content, "outside", 0);
  return t;
}

BilerpTexture read_bilerp(State& state, ParamList& params, Content content) {
  BilerpTexture t;
  t.mapping = read_mapping(state, params);
  const auto corner = [&](std::string_view name, float otherwise) {
    if (content == Content::scalar) return Rgb(params.number(name, otherwise));
    return find_color(state, params, name, ColorUse::unbounded).value_or(Rgb(otherwise));
  };
  t.v00 = corner("v00", 0);
  t.v01 = corner("v01", 1);
  t.v10 = corner("v10", 0);
  t.v11 = corner("v11", 1);
  return t;
}

DirectionMixTexture read_direction_mix(State& state, ParamList& params, Content content) {
  const Vec3 direction = usable_ctm(state, params.where()).vector(params.vector("dir", {0, 1, 0}));
  if (!(length(direction) > 0)) throw params.error("dir", "dir is 0 0 0; give a direction");
  return {operand(state, params, content, "tex1", 0), operand(state, params, content, "tex2", 1), normalize(direction)};
}

NoiseTexture read_noise(State& state, ParamList& params, NoiseTexture::Kind kind) {
  constexpr int kMaxOctaves = 64;  // the last is 10^19 times finer than the first
  NoiseTexture t;
  t.kind = kind;
  t.to_texture = usable_ctm(state, params.where()).inverse();
  if (kind != NoiseTexture::Kind::windy) {
    t.octaves = params.integer("octaves", 8);
    t.roughness = params.number("roughness", 0.5f);
    if (t.octaves < 0 || t.octaves > kMaxOctaves)
      throw params.error("octaves", "octaves must be from 0 to " + std::to_string(kMaxOctaves));
  }
  if (kind == NoiseTexture::Kind::marble) {
    t.scale = params.number("scale", 1);
    t.variation = params.number("variation", 0.2f);
  }
  return t;
}

/// pbrt has each of these as a float texture, or as a spectrum texture, and not as the other.
std::optional<NoiseTexture::Kind> noise_kind(ParamList& params, const std::string& kind, Content content) {
  using Kind = NoiseTexture::Kind;
  const auto found = kind == "fbm"        ? std::optional(Kind::fbm)
                     : kind == "wrinkled" ? std::optional(Kind::wrinkled)
                     : kind == "windy"    ? std::optional(Kind::windy)
                     : kind == "marble"   ? std::optional(Kind::marble)
                                          : std::nullopt;
  if (!found) return std::nullopt;
  const Content only = found == Kind::marble ? Content::color : Content::scalar;
  if (content != only)
    throw params.error("texture \"" + kind + "\" is a " + type_of(only) + " texture; declare it as \"" + type_of(only) +
                       "\", and mix two colours by it where colours are wanted");
  return found;
}

TextureId make_texture(State& state, ParamList& params, const std::string& kind, Content content) {
  const auto add = [&](auto texture) {
    params.finish();
    state.scene.textures.push_back({std::move(texture), params.where()});
    return static_cast<TextureId>(state.scene.textures.size() - 1);
  };
  if (kind == "constant") {
    const ConstantTexture constant = read_constant(state, params, content);
    params.finish();
    return constant_texture(state, constant.value);
  }
  if (kind == "scale") return add(read_scale(state, params, content));
  if (kind == "mix") return add(read_mix(state, params, content));
  if (kind == "imagemap") return add(read_image_map(state, params, content));
  if (kind == "checkerboard") return add(read_checkerboard(state, params, content));
  if (kind == "dots") return add(read_dots(state, params, content));
  if (kind == "bilerp") return add(read_bilerp(state, params, content));
  if (kind == "directionmix") return add(read_direction_mix(state, params, content));
  if (const auto noise = noise_kind(params, kind, content)) return add(read_noise(state, params, *noise));
  if (kind == "ptex") throw params.error("texture \"ptex\" is not supported by Tyndall; bake it into an imagemap");
  throw params.error("texture \"" + printable(kind) + "\" is unknown; " +
                     suggestion(kind, {"constant", "scale", "mix", "imagemap", "checkerboard", "dots", "bilerp", "directionmix",
                                       "fbm", "wrinkled", "windy", "marble"}));
}

}  // namespace

TextureId constant_texture(State& state, Rgb value) {
  auto& textures = state.scene.textures;
  const auto [it, added] = state.constants.try_emplace({value.r, value.g, value.b}, static_cast<TextureId>(textures.size()));
  if (added) textures.push_back({ConstantTexture{value}, {}});
  return it->second;
}

std::optional<TextureId> find_float_texture(State& state, ParamList& params, std::string_view name) {
  const Param* p = params.find(name, {ParamType::number, ParamType::texture});
  if (!p) return std::nullopt;
  if (p->type == ParamType::texture) return look_up(state, *p, Content::scalar);
  if (p->numbers.size() != 1) throw Error(p->where, "parameter \"" + p->name + "\" has more than one value; give one");
  return constant_texture(state, Rgb(p->numbers[0]));
}

TextureId float_texture(State& state, ParamList& params, std::string_view name, float otherwise) {
  const auto id = find_float_texture(state, params, name);
  return id ? *id : constant_texture(state, Rgb(otherwise));
}

std::optional<TextureId> find_color_texture(State& state, ParamList& params, std::string_view name, ColorUse use) {
  const Param* p = params.find(name, kColorTextureTypes);
  if (!p) return std::nullopt;
  if (p->type == ParamType::texture) return look_up(state, *p, Content::color);
  return constant_texture(state, to_color(state, *p, use));
}

TextureId color_texture(State& state, ParamList& params, std::string_view name, Rgb otherwise) {
  const auto id = find_color_texture(state, params, name, ColorUse::albedo);
  return id ? *id : constant_texture(state, otherwise);
}

void read_texture(State& state, Tokenizer& in, const Location& where) {
  const std::string name(in.expect_string("a texture name").text);
  const Token type = in.expect_string("a texture type, \"float\" or \"spectrum\"");
  const std::string kind(in.expect_string("a kind of texture, as \"imagemap\"").text);
  ParamList params = read_param_list(state, in, "texture \"" + printable(kind) + "\"", where, &AttributeDefaults::texture);
  if (type.text != "float" && type.text != "spectrum")
    throw in.error(type.at, "texture type \"" + printable(type.text) + "\" is unknown; use \"float\" or \"spectrum\"");
  const Content content = type.text == "float" ? Content::scalar : Content::color;
  auto& table = content == Content::scalar ? state.float_textures : state.spectrum_textures;
  if (table.contains(name)) throw Error(where, "texture \"" + printable(name) + "\" is defined twice; rename one");
  try {
    const TextureId id = make_texture(state, params, kind, content);
    table[name] = id;
    state.named_texture_places[type_of(content) + name] = state.named_textures.size();
    state.named_textures.push_back({name, type_of(content), where});
  } catch (const Error&) {
    table.try_emplace(name, constant_texture(state, Rgb(0.5f)));  // so that its users are not reported as well
    throw;
  }
}

void warn_of_idle_textures(State& state) {
  constexpr std::size_t kShown = 5;
  std::string names;
  std::size_t count = 0;
  Location first;
  for (const NamedTexture& t : state.named_textures) {
    if (t.used) continue;
    if (count++ == 0) first = t.where;
    if (count <= kShown) names += (names.empty() ? "\"" : ", \"") + printable(t.name) + "\"";
  }
  if (count == 0) return;
  const std::string subject = count == 1 ? "a texture feeds" : std::to_string(count) + " textures feed";
  state.reports.warn(first, subject + " nothing: " + names + (count > kShown ? " ..." : "") +
                                "; name them in a material, a shape or another texture, or remove them");
}

}  // namespace tyndall::pbrt
