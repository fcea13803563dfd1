#include "io/file_text.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "tyndall/error.h"

namespace tyndall {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

Error unreadable(const std::string& path, const std::string& why) {
  return Error(Failure::scene, path + ": cannot be read (" + why + "); check the name and its permissions");
}

}  // namespace

std::string read_file_text(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw unreadable(path, "it is a folder");
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw unreadable(path, std::strerror(errno));

  // The size is a hint only: pipes have none, and a file may grow while it is read.
  std::string bytes;
  const auto size = std::filesystem::file_size(path, ignored);
  std::size_t step = ignored ? 1 << 20 : static_cast<std::size_t>(size) + 1;
  while (true) {
    const std::size_t used = bytes.size();
    bytes.resize(used + step);
    const std::size_t got = std::fread(bytes.data() + used, 1, step, file.get());
    bytes.resize(used + got);
    if (got < step) break;
    step = 1 << 20;
  }
  if (std::ferror(file.get())) throw unreadable(path, std::strerror(errno));
  if (is_gzip(bytes)) return gunzip(bytes, path);
  return bytes;
}

}  // namespace tyndall
