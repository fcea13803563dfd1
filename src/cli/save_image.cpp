#include "cli/save_image.h"

#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>
#include <vector>

#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kAttempts = 3;
constexpr auto kPause = std::chrono::seconds(1);

void write_image(const Image& image, const std::string& path) {
  if (fs::path(path).extension() == ".png") {
    write_png(image, path);
  } else {
    write_exr(image, path);
  }
}

/// Folders to fall back on, the most likely first.
std::vector<fs::path> other_folders() {
  std::error_code ignored;
  std::vector<fs::path> folders{fs::temp_directory_path(ignored)};
  if (const char* home = std::getenv("HOME")) folders.emplace_back(home);
  folders.emplace_back(fs::current_path(ignored));
  return folders;
}

/// "plume.exr" to "plume.unsaved-1234.exr": nothing else has this name.
std::string other_name(const std::string& path) {
  const fs::path name = fs::path(path).filename();
  return fmt::format("{}.unsaved-{}{}", name.stem().string(), ::getpid(), name.extension().string());
}

}  // namespace

void check_room(const std::string& path, std::uint64_t bytes) {
  const std::uint64_t room = room_for_file(path);
  if (room >= bytes) return;
  throw Error(Failure::output, fmt::format("{}: the image may take {:.1f} MB where only {:.1f} MB can be written; free some "
                                           "space, lift the limit on file sizes, or choose another place with -o",
                                           path, static_cast<double>(bytes) * 1e-6, static_cast<double>(room) * 1e-6));
}

void save_image(const Image& image, const std::string& path) {
  std::string failure;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (attempt > 0) std::this_thread::sleep_for(kPause);
    try {
      return write_image(image, path);
    } catch (const Error& e) {
      failure = e.what();
    }
  }
  for (const fs::path& folder : other_folders()) {
    const std::string other = (folder / other_name(path)).string();
    try {
      write_image(image, other);
    } catch (const Error&) {
      continue;
    }
    throw Error(Failure::output, failure + "\nThe image is not lost: it is in " + other);
  }
  throw Error(Failure::output, failure + "\nThe image is lost: it could not be written anywhere else either");
}

}  // namespace tyndall::cli
