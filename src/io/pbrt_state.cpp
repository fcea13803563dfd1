#include "io/pbrt_state.h"

#include <cctype>
#include <filesystem>
#include <utility>

#include "io/asset.h"
#include "io/pbrt_textures.h"
#include "tyndall/frames.h"

namespace tyndall::pbrt {

State initial_state(std::string folder, const SceneReading& how) {
  State state;
  state.how = how;
  state.folder = std::move(folder);
  state.graphics.color_space = find_color_space("srgb");
  state.graphics.defaults = std::make_shared<const AttributeDefaults>();
  state.blocks.emplace_back();
  state.scene.settings.spp = 16;  // pbrt's default samplers
  const TextureId grey = constant_texture(state, Rgb(0.5f));
  state.scene.materials.push_back({DiffuseMaterial{grey}, "", {}});
  state.diffuse_materials[grey] = 0;
  return state;
}

const Transform& usable_ctm(const State& state, const Location& where) {
  if (const auto& singular = state.graphics.singular)
    throw Error(where, "the transformation is singular since line " + std::to_string(singular->line) +
                           " and nothing can be made under it; no scale factor may be 0, no axes may lie in a plane");
  return state.graphics.ctm;
}

bool is_always_srgb_in_pbrt(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".jpg" || ending == ".jpeg" || ending == ".tga" || ending == ".bmp";
}

std::string resolve_asset(State& state, const Location& where, const std::string& name, bool holds_scene) {
  if (name.empty()) throw Error(where, "file name is empty; name a file");
  const FrameName asset{where, std::filesystem::path(name).is_absolute() ? "" : state.folder, name, holds_scene};
  const bool by_frame = state.how.frame && names_frame(name);
  if (by_frame) state.frame_names.push_back(asset);
  return require_asset(asset, state.how.frame);
}

ParamList read_param_list(State& state, Tokenizer& in, std::string owner, Location where,
                          std::vector<Param> AttributeDefaults::*defaults) {
  return ParamList(std::move(owner), std::move(where), read_params(in, state.graphics.color_space),
                   &(state.graphics.defaults.get()->*defaults), state.reports);
}

ParamList read_param_list(State& state, Tokenizer& in, std::string owner, Location where) {
  return ParamList(std::move(owner), std::move(where), read_params(in, state.graphics.color_space), nullptr, state.reports);
}

}  // namespace tyndall::pbrt
