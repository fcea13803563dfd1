/// What a reading of a scene file knows at each moment: the scene so far, the names in it, the graphics state.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "io/color.h"
#include "io/pbrt_params.h"
#include "io/pbrt_reports.h"
#include "tyndall/io.h"
#include "tyndall/scene.h"

namespace tyndall::pbrt {

/// Parameters that the Attribute directive gave to every later entity of a kind.
struct AttributeDefaults {
  std::vector<Param> shape, light, material, medium, texture;
};

/// What AttributeBegin saves and AttributeEnd restores.
struct GraphicsState {
  Transform ctm;                       ///< ask usable_ctm() for it where something is made
  std::optional<Location> singular{};  ///< where the matrix lost its inverse; `ctm` then means nothing
  bool start_active = true;  ///< false after `ActiveTransform EndTime`: transforms then move only the end of the shutter
  bool reverse_orientation = false;
  MaterialId material = 0;
  std::optional<AreaLight> area_light;
  std::optional<MediumId> inside, outside;
  const ColorSpace* color_space = nullptr;
  std::shared_ptr<const AttributeDefaults> defaults;  ///< shared between states, replaced when Attribute adds to it
};

struct CoordinateSystem {
  Transform to_world;
  std::optional<Location> singular{};
};

struct NamedTexture {
  std::string name;
  const char* type;  ///< "float" or "spectrum"
  Location where;
  bool used = false;
};

/// Media on the two sides, and the boundary group that shapes of this block with these media form.
struct BlockBoundary {
  std::optional<MediumId> inside, outside;
  BoundaryId id;
};

struct Block {
  enum class Kind { world, attribute, object, import } kind = Kind::world;
  Location opened;
  GraphicsState saved;
  std::vector<BlockBoundary> boundaries;
};

/// Blocks and included files may be nested this deep; more is an endless recursion or a broken exporter.
inline constexpr std::size_t kMaxDepth = 64;

template <typename Id>
using Names = std::unordered_map<std::string, Id>;

struct State {
  Scene scene;
  Reports reports;
  std::string folder;  ///< of the top file; relative names start here
  SceneReading how;
  std::vector<FrameName> frame_names;

  bool in_world = false;
  bool render_in_world_space = false;  ///< Option "rendercoordsys" "world"
  bool world_assumed = false;          ///< WorldBegin was missed and that was said; more of the same need not be
  GraphicsState graphics;
  std::vector<Block> blocks;
  std::optional<ObjectId> open_object;

  Names<MediumId> media;
  Names<MaterialId> materials;
  Names<TextureId> float_textures, spectrum_textures;
  Names<ObjectId> objects;
  Names<CoordinateSystem> coordinate_systems;
  std::vector<NamedTexture> named_textures;
  Names<std::size_t> named_texture_places;  ///< by type and name

  // Equal constants share one texture, equal plain materials one material; a scene of a million lights needs it.
  std::map<std::array<float, 3>, TextureId> constants;
  std::map<TextureId, MaterialId> diffuse_materials;
  std::optional<MaterialId> interface_material;
  Names<TextureId> normal_maps;  ///< by path
  Names<Rgb> spectrum_colors;    ///< of named spectra and black bodies, by use

  // Wait for WorldBegin: the film needs the camera's shutter, the camera the film's size, the settings the Film's frame.
  double exposure_time = 1;
  float iso = 100;
  float film_diagonal = 0.035f;                ///< metres
  std::optional<Location> crop_where;          ///< of the settings
  std::optional<Location> surface_integrator;  ///< one that passes over media in pbrt
  bool spp_from_sampler = false, spp_from_integrator = false, seed_from_integrator = false;
};

/// A state at the start of a file: pbrt's defaults, one default material.
State initial_state(std::string folder, const SceneReading& how);

/// The current transformation matrix for something made at `where`. pbrt lets a scene pass through singular matrices as
/// long as nothing is made under one; that is an Error.
const Transform& usable_ctm(const State& state, const Location& where);

/// `name`, with the frame's number where it has a place for it, against the top file's folder unless absolute; Error at `where`
/// when no such file exists. `holds_scene`: what is in it is a part of the scene's text.
std::string resolve_asset(State& state, const Location& where, const std::string& name, bool holds_scene = false);

/// Whether pbrt-v4 takes an image of that name for sRGB whatever its encoding: .jpg, .tga, .bmp.
bool is_always_srgb_in_pbrt(const std::string& path);

/// The parameter list that follows in the tokenizer, with the Attribute defaults of its kind.
ParamList read_param_list(State& state, Tokenizer& in, std::string owner, Location where,
                          std::vector<Param> AttributeDefaults::*defaults);
ParamList read_param_list(State& state, Tokenizer& in, std::string owner, Location where);

/// All names of a table, sorted; for suggestions.
template <typename Id>
std::vector<std::string> names_of(const Names<Id>& table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.push_back(entry.first);
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace tyndall::pbrt
