#include "cli/room.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "cli/checkpoint_file.h"
#include "session/memory_plan.h"
#include "session/rendered_pixels.h"
#include "tyndall/cryptomatte.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kHeader = 1 << 16;

std::uint64_t channels_of_mattes(const Scene& scene) {
  const auto& aovs = scene.settings.aovs;
  return 2 * kMatteRanks * static_cast<std::uint64_t>(std::count_if(aovs.begin(), aovs.end(), is_matte_layer));
}

std::uint64_t largest_image(const Scene& scene, const std::string& path) {
  if (fs::path(path).extension() == ".png") return 3 * pixels_of(scene) + kHeader;
  if (fs::path(path).extension() == ".pfm") return 3 * sizeof(float) * pixels_of(scene) + kHeader;
  const auto [sums, channels] = film_numbers(scene);
  const std::uint64_t floats = channels + channels_of_mattes(scene) + (scene.settings.slice ? 3 * sums : 0);
  return sizeof(float) * floats * pixels_of(scene) + kHeader;
}

std::uint64_t largest_checkpoint(const Scene& scene) {
  return (sizeof(double) + sizeof(float)) * (film_numbers(scene).sums + channels_of_mattes(scene)) * pixels_of(scene) + kHeader;
}

/// Free on the disk of `path`, and what stands there now and will be replaced.
std::uint64_t disk_for(const std::string& path) {
  std::error_code problem, absent;
  const fs::path folder = fs::path(path).parent_path();
  const fs::space_info space = fs::space(folder.empty() ? "." : folder, problem);
  const std::uintmax_t there = fs::file_size(path, absent);
  if (problem) return room_for_file(path);
  return space.available + (absent ? 0 : there);
}

void require(const std::string& path, const std::string& what, std::uint64_t bytes, std::uint64_t room) {
  if (room >= bytes) return;
  throw Error(Failure::output, fmt::format("{}: {} may take {:.1f} MB where only {:.1f} MB can be written; free some space, "
                                           "lift the limit on file sizes, or choose another place with -o",
                                           path, what, static_cast<double>(bytes) * 1e-6, static_cast<double>(room) * 1e-6));
}

}  // namespace

std::uint64_t pixels_of(const Scene& scene) {
  const PixelBounds crop = rendered_pixels(scene, scene.settings);
  return static_cast<std::uint64_t>(crop.width()) * static_cast<std::uint64_t>(crop.height());
}

void require_room(const std::string& output, const Scene& scene, bool checkpoints) {
  const std::uint64_t image = largest_image(scene, output);
  require(output, "the image", image, room_for_file(output));
  if (!checkpoints) return;
  const std::string path = CheckpointFile(output).path();
  const std::uint64_t checkpoint = largest_checkpoint(scene);
  require(path, "a checkpoint", checkpoint, room_for_file(path));
  require(path, "a checkpoint and its successor", checkpoint + std::max(checkpoint, image), disk_for(path));
}

}  // namespace tyndall::cli
