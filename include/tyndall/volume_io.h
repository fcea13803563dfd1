/// What a volume file holds.
#pragma once

#include <string>

#include "tyndall/io.h"

namespace tyndall {

/// Every grid of a .vdb or .nvdb file: name, type, class, voxel size, transform, bounds in world and index space,
/// active voxels and tiles, background, smallest and largest value, memory, metadata. Recognised by content, not by
/// name. Throws Error (scene) when the file cannot be read.
Description describe_volume(const std::string& path);

}  // namespace tyndall
