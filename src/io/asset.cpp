#include "io/asset.h"

#include <algorithm>
#include <filesystem>

#include "io/pbrt_token.h"
#include "tyndall/frames.h"

namespace tyndall {

std::string require_asset(const FrameName& asset, std::optional<int> frame) {
  const bool has_place = names_frame(asset.name);
  const std::string name = frame ? with_frame(asset.name, *frame) : asset.name;
  const std::filesystem::path path =
      asset.folder.empty() ? std::filesystem::path(name) : std::filesystem::path(asset.folder) / name;
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) return path.string();
  std::string advice = ", relative names start at the folder of the top scene file";
  if (has_place && !frame) advice = "; the place for a frame's number is filled by --frames";
  if (has_place && frame) advice = " for frame " + std::to_string(*frame);
  throw Error(asset.where, "file \"" + pbrt::printable(name) + "\" does not exist; looked for " + path.string() + advice);
}

void require_frame(const SceneFile& file, const std::string& path, int frame) {
  const auto holds_scene = [](const FrameName& asset) { return asset.holds_scene; };
  for (const FrameName& asset : file.frame_names) require_asset(asset, frame);
  if (std::any_of(file.frame_names.begin(), file.frame_names.end(), holds_scene)) read_scene(path, {.frame = frame});
}

}  // namespace tyndall
