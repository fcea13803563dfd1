#include "io/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <system_error>
#include <vector>

#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

std::string system_reason() { return std::strerror(errno); }

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// Of this machine, in letters that file names take. Folders are shared by machines that count processes each for itself.
std::string host_name() {
  constexpr std::size_t kLongest = 40;
  char name[256] = "";
  if (::gethostname(name, sizeof name - 1) != 0) name[0] = '\0';
  std::string host = std::string(name).substr(0, kLongest);
  for (char& c : host) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
  }
  return host;
}

/// "/a/.plume.exr.node7.": what the names of this machine's temporary files for /a/plume.exr begin with; then comes the
/// process, a number, ".part".
fs::path temporary_prefix(const std::string& target) {
  return fs::path(folder_of(target)) / ("." + fs::path(target).filename().string() + "." + host_name() + ".");
}

/// Who made the temporary file `name`, "PREFIX1234.0.part"; nothing for another file.
std::optional<pid_t> maker_of(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix) || !name.ends_with(".part")) return std::nullopt;
  name.remove_prefix(prefix.size());
  name.remove_suffix(std::string_view(".part").size());
  pid_t process = 0;
  int number = 0;
  const char* const end = name.data() + name.size();
  const auto [dot, problem] = std::from_chars(name.data(), end, process);
  if (problem != std::errc() || process <= 0 || dot == end || *dot != '.') return std::nullopt;
  const auto rest = std::from_chars(dot + 1, end, number);
  if (rest.ec != std::errc() || rest.ptr != end) return std::nullopt;
  return process;
}

bool is_gone(pid_t process) { return ::kill(process, 0) != 0 && errno == ESRCH; }

/// The file that `path` names in the end; a broken link, like no file at all, is taken as it is.
std::string followed(const std::string& path) {
  std::error_code ignored;
  const fs::path real = fs::canonical(path, ignored);
  return ignored ? path : real.string();
}

bool sync(const std::string& path, int flags) {
  const int fd = ::open(path.c_str(), flags | O_CLOEXEC);
  if (fd < 0) return false;
  const bool synced = ::fsync(fd) == 0 || errno == EINVAL;  // EINVAL: a file system that has no such thing
  ::close(fd);
  return synced;
}

}  // namespace

std::uint64_t room_for_file(const std::string& path) {
  std::uint64_t room = std::numeric_limits<std::uint64_t>::max();
  rlimit limit{};
  if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) room = limit.rlim_cur;
  struct statvfs disk {};
  if (::statvfs(folder_of(followed(path)).c_str(), &disk) == 0 && disk.f_blocks > 0)
    room = std::min<std::uint64_t>(room, std::uint64_t{disk.f_bavail} * disk.f_frsize);
  return room;
}

AtomicFile::AtomicFile(const std::string& path) : path_(path), target_(followed(path)) {
  std::error_code ignored;
  if (fs::exists(target_, ignored) && !fs::is_regular_file(target_, ignored)) fail("is not a regular file");
  constexpr int attempts = 100;
  int fd = -1;
  for (int i = 0; i < attempts && fd < 0; ++i) {
    temporary_ = temporary_prefix(target_).string() + std::to_string(::getpid()) + "." + std::to_string(i) + ".part";
    fd = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0 && errno != EEXIST) break;
  }
  if (fd < 0) {
    temporary_.clear();
    fail(system_reason());
  }
  stream_ = ::fdopen(fd, "wb");
  if (!stream_) {
    const std::string reason = system_reason();
    ::close(fd);
    ::unlink(temporary_.c_str());
    fail(reason);
  }
}

AtomicFile::~AtomicFile() {
  if (stream_) std::fclose(stream_);
  if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::close() {
  errno = 0;
  const bool written = std::fflush(stream_) == 0 && !std::ferror(stream_);
  const std::string reason = errno ? system_reason() : "an earlier write failed";
  const auto size = ::ftello(stream_);  // writers leave the position at the end
  const bool closed = std::fclose(stream_) == 0;
  stream_ = nullptr;
  if (!written || size < 0) fail(reason);
  if (!closed) fail(system_reason());
  struct stat status {};
  if (::stat(temporary_.c_str(), &status) != 0) fail(system_reason());
  if (status.st_size < size) fail("the file is shorter than what was written");
}

void AtomicFile::require_holds(std::string_view bytes) const {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(temporary_.c_str(), "rb"), std::fclose);
  if (!file) fail("it cannot be opened again: " + system_reason());
  std::vector<char> buffer(std::min<std::size_t>(bytes.size() + 1, std::size_t{1} << 20));
  std::size_t at = 0;
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), file.get())) {
    if (got > bytes.size() - at || std::memcmp(buffer.data(), bytes.data() + at, got) != 0) fail("it reads back differently");
    at += got;
  }
  if (at != bytes.size()) fail("it reads back differently");
}

void AtomicFile::commit() {
  if (!sync(temporary_, O_RDONLY)) fail(system_reason());
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(system_reason());
  committed_ = true;
  if (!sync(folder_of(target_), O_RDONLY | O_DIRECTORY)) fail(system_reason());
}

void AtomicFile::fail(const std::string& reason) const {
  throw Error(Failure::output, path_ + ": cannot be written: " + reason + "; check the folder, its rights and free space");
}

void remove_abandoned_files(const std::string& path) {
  const std::string target = followed(path), prefix = temporary_prefix(target).filename();
  std::error_code problem, ignored;
  for (fs::directory_iterator file(folder_of(target), problem), end; !problem && file != end; file.increment(problem)) {
    const auto maker = maker_of(file->path().filename().string(), prefix);
    if (maker && is_gone(*maker)) fs::remove(file->path(), ignored);
  }
}

}  // namespace tyndall
