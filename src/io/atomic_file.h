/// Writing a file so that its name holds either the old content or the complete new one, whatever fails.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace tyndall {

/// A new file beside `path` under a temporary name. commit() moves it into place; without it the temporary file is
/// removed and whatever stood at `path` stays. Every failure throws Error (output) that names `path` and the reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::FILE* stream() { return stream_; }
  const std::string& temporary_path() const { return temporary_; }

  /// Flushes and closes, checks that everything was accepted and that the file's size is what was written.
  void close();
  /// After close: opened again, the file holds `bytes`.
  void require_holds(std::string_view bytes) const;
  /// After close: to the disk, then to its name, then the folder's entry to the disk.
  void commit();
  [[noreturn]] void fail(const std::string& reason) const;  ///< throws the Error

 private:
  std::string path_, target_, temporary_;  ///< target_: path_ with a symbolic link followed
  std::FILE* stream_ = nullptr;
  bool committed_ = false;
};

/// Removes the temporary files of AtomicFile for `path` whose processes, on this machine, were killed before they could.
/// Failures are ignored.
void remove_abandoned_files(const std::string& path);

}  // namespace tyndall
