/// Polygon files (.ply, .ply.gz): ascii and binary of either byte order.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/math.h"

namespace tyndall {

/// Empty normals or uvs: the file has none.
struct PlyMesh {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> uvs;
  std::size_t broken_normals = 0;        ///< made 0 since they were NaN or infinite; when all are, there are none
  std::vector<std::uint32_t> triangles;  ///< three indices each
  std::vector<std::uint32_t> quads;      ///< four each, in the order of a bilinear patch: (0,0) (1,0) (0,1) (1,1)
};

/// Throws Error (scene): unreadable, truncated, counts beyond the file's size, an index out of range, a position or uv
/// that is not finite, a face with other than three or four corners, no faces.
PlyMesh read_ply(const std::string& path);
PlyMesh read_ply_bytes(std::string_view bytes, const std::string& path);  ///< `path` is for messages

}  // namespace tyndall
