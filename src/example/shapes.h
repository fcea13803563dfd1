/// Meshes that the examples are built of. Triangles of closed shapes have their normals outside.
#pragma once

#include "tyndall/math.h"
#include "tyndall/scene.h"

namespace tyndall {

void append(TriangleMesh& mesh, const TriangleMesh& more);

/// Two triangles; the normal is along cross(b - a, d - a).
TriangleMesh quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

TriangleMesh box(Vec3 lo, Vec3 hi);
/// About the vertical axis through the middle of its foot.
struct BlockPose {
  Vec3 foot;  ///< middle of the underside
  Vec3 size;
  float turn = 0;  ///< radians about y
  float lean = 0;  ///< how far the top is pushed along the turned x axis
};
TriangleMesh block(const BlockPose& pose);

}  // namespace tyndall
