/// Where results go, looked at before the work and not after it.
#pragma once

#include <string>

namespace tyndall::cli {

/// Throws Error (output) when a file could not be written there: no folder, no permission, or `path` is a folder.
void check_writable(const std::string& path, const std::string& option);
/// Makes the folder (and those above it) if it is not there. Throws Error (output) when that or writing in it fails.
void make_folder(const std::string& path);

}  // namespace tyndall::cli
