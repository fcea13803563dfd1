#include "example/shapes.h"

namespace tyndall {

void append(TriangleMesh& mesh, const TriangleMesh& more) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  for (const std::uint32_t i : more.indices) mesh.indices.push_back(first + i);
}

TriangleMesh quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  TriangleMesh mesh;
  mesh.positions = {a, b, c, d};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

TriangleMesh block(const BlockPose& pose) {
  const float c = std::cos(pose.turn), s = std::sin(pose.turn);
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const float x = ((i & 1) ? 0.5f : -0.5f) * pose.size.x + ((i & 2) ? pose.lean : 0);
    const float z = ((i & 4) ? 0.5f : -0.5f) * pose.size.z;
    mesh.positions.push_back(pose.foot + Vec3{c * x + s * z, (i & 2) ? pose.size.y : 0, c * z - s * x});
  }
  mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3};
  return mesh;
}

TriangleMesh box(Vec3 lo, Vec3 hi) { return block({.foot = {(lo.x + hi.x) / 2, lo.y, (lo.z + hi.z) / 2}, .size = hi - lo}); }

}  // namespace tyndall
