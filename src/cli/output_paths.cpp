#include "cli/output_paths.h"

#include <unistd.h>

#include <filesystem>

#include "tyndall/error.h"

namespace tyndall::cli {

namespace fs = std::filesystem;

void check_writable(const std::string& path, const std::string& option) {
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    throw Error(Failure::output, path + ": is a folder; give a file name with " + option);
  }
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    throw Error(Failure::output, path + ": is not a regular file; give another name with " + option);
  }
  if (!fs::is_directory(folder, ignored)) {
    throw Error(Failure::output, path + ": folder " + folder.string() + " does not exist; make it first");
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw Error(Failure::output, path + ": folder " + folder.string() + " is not writable; choose another with " + option);
  }
}

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!fs::is_directory(path)) {
    throw Error(Failure::output,
                path + ": cannot be made a folder" + (error ? " (" + error.message() + ")" : "") + "; choose another with -o");
  }
  if (access(path.c_str(), W_OK) != 0) {
    throw Error(Failure::output, path + ": folder is not writable; choose another with -o");
  }
}

}  // namespace tyndall::cli
