#include "cli/save.h"

#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <thread>
#include <vector>

#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kAttempts = 3;
constexpr auto kPause = std::chrono::seconds(1);

/// Puts a work, an image or a report, to the path that it is given.
using Write = std::function<void(const std::string& path)>;

/// Why it could not be written; nothing when it was.
std::optional<std::string> failure_of(const Write& write, const std::string& path) {
  try {
    write(path);
    return std::nullopt;
  } catch (const Error& e) {
    return e.what();
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

void discard(const std::string& path) {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

/// Where it could be written instead; nothing when nowhere.
std::optional<std::string> save_elsewhere(const std::string& path, const Write& write) {
  for (const fs::path& folder : other_folders()) {
    const std::string other = (folder / other_name(path)).string();
    if (!failure_of(write, other)) return other;
    discard(other);
  }
  return std::nullopt;
}

/// `what`: "image", for messages.
void save(const std::string& what, const std::string& path, const Write& write, const std::function<void()>& make_room) {
  auto failure = failure_of(write, path);
  for (int attempt = 1; failure && attempt < kAttempts; ++attempt) {
    std::this_thread::sleep_for(kPause);
    failure = failure_of(write, path);
  }
  if (!failure) return;
  const auto other = save_elsewhere(path, write);
  if (!other)
    throw Error(Failure::output,
                fmt::format("{}\nThe {} is lost: it could not be written anywhere else either", *failure, what));
  if (make_room) {
    make_room();
    failure = failure_of(write, path);
    if (!failure) return discard(*other);
  }
  throw Error(Failure::output, fmt::format("{}\nThe {} is not lost: it is in {}", *failure, what, *other));
}

}  // namespace

void save_image(const Image& image, const std::string& path, const ImageFormat& format,
                const std::function<void()>& make_room) {
  save(
      "image", path, [&](const std::string& to) { write_image(image, to, format); }, make_room);
}

void save_deep_image(const DeepImage& image, const std::string& path) {
  save("deep image", path, [&](const std::string& to) { write_deep_exr(image, to); }, {});
}

void save_report(const std::string& folder, const std::function<void(const std::string& folder)>& write) {
  fs::path name = folder;
  if (!name.has_filename()) name = name.parent_path();  // "report/"
  save("report", name.string(), write, {});
}

}  // namespace tyndall::cli
