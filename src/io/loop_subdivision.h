/// Smooth surfaces from coarse triangle meshes.
#pragma once

#include "tyndall/scene.h"

namespace tyndall {

/// The control mesh refined `levels` times by Loop's scheme [Loop 1987] with the boundary rules of [Hoppe et al. 1994], then
/// every vertex moved to the limit surface, with normals there: pbrt's "loopsubdiv", whose normals point to the side from
/// which the faces' corners go around clockwise. Throws Error (scene) for faces that are no manifold or wind in different
/// directions, and when the refined mesh would be too large.
TriangleMesh subdivide_loop(const std::vector<Vec3>& positions, const std::vector<std::uint32_t>& indices, int levels);

}  // namespace tyndall
