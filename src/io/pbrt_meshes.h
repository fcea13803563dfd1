/// Meshes of the Shape directive, their indices and counts checked.
#pragma once

#include <vector>

#include "io/pbrt_state.h"

namespace tyndall::pbrt {

TriangleMesh read_triangle_mesh(ParamList& params);
BilinearMesh read_bilinear_mesh(ParamList& params);
TriangleMesh read_loop_subdivision(ParamList& params);
/// A ply file holds triangles, quadrilaterals (then bilinear patches) or both.
std::vector<decltype(Shape::kind)> read_ply_mesh(State& state, ParamList& params);

}  // namespace tyndall::pbrt
