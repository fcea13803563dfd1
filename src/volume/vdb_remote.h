/// A VolumeFile that another process has open.
#pragma once

#include "volume/vdb_file.h"
#include "volume/vdb_process.h"

namespace tyndall {

/// Opens `path` by `open` in a child process, whose memory and time are limited by the file's size and by
/// `most_memory` (bytes), and lives as long as the result. Its values are received and checked here. Throws Error
/// (scene), also for what makes the child crash or exceed its limits; so do the functions of the result.
std::unique_ptr<VolumeFile> open_remotely(const std::string& path, std::size_t most_memory,
                                          std::unique_ptr<VolumeFile> (*open)(const std::string& path));

/// The receiving half: a file that speaks through `channel`. Nothing that comes from there is trusted; what is received takes
/// at most `most_memory` bytes.
std::unique_ptr<VolumeFile> receive_volume(const std::string& path, std::unique_ptr<ProcessChannel> channel,
                                           std::size_t most_memory);

}  // namespace tyndall
