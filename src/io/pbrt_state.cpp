#include "io/pbrt_state.h"

#include <filesystem>
#include <utility>

#include "io/pbrt_textures.h"

namespace tyndall::pbrt {

State initial_state(std::string folder) {
  State state;
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

std::string resolve_asset(const State& state, const Location& where, const std::string& name) {
  if (name.empty()) throw Error(where, "file name is empty; name a file");
  const std::filesystem::path given(name);
  const std::filesystem::path path = given.is_absolute() ? given : std::filesystem::path(state.folder) / given;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw Error(where, "file \"" + printable(name) + "\" does not exist; looked for " + path.string() +
                           ", relative names start at the folder of the top scene file");
  return path.string();
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
