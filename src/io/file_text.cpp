#include "io/file_text.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

constexpr std::size_t kMaxUnsizedBytes = std::size_t{1} << 30;  // of pipes and devices, which may never end

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

Error unreadable(const std::string& path, const std::string& why) {
  return Error(Location{path}, "cannot be read (" + why + "); check the name and its permissions");
}

}  // namespace

std::string read_file_text(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw unreadable(path, "it is a folder");
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw unreadable(path, std::strerror(errno));

  // The size is a hint only: pipes have none, and a file may grow while it is read.
  std::string bytes;
  std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (ignored) size = 0;
  std::size_t step = size > 0 ? static_cast<std::size_t>(size) + 1 : 1 << 20;
  while (true) {
    const std::size_t used = bytes.size();
    bytes.resize(used + step);
    const std::size_t got = std::fread(bytes.data() + used, 1, step, file.get());
    bytes.resize(used + got);
    if (got < step) break;
    if (bytes.size() > kMaxUnsizedBytes + size) throw unreadable(path, "it has no end");
    step = 1 << 20;
  }
  if (std::ferror(file.get())) throw unreadable(path, std::strerror(errno));
  if (is_gzip(bytes)) return gunzip(bytes, path);
  return bytes;
}

std::string read_file(const std::string& path) { return read_file_text(path); }

}  // namespace tyndall
