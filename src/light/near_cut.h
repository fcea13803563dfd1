/// A cut that finds near lights: what the mean of a cluster's lights cannot tell.
#pragma once

#include "light/instanced_light_tree.h"
#include "light/light_cut.h"

namespace tyndall {

/// Clusters by their NodeRef, in the tree's order. Whatever may hold a light that brings as much as one candidate stands for,
/// the importance of all over `candidates`, is split down to that light; see nearest_light(). What is far is left whole: there
/// importances do as well as splits. Candidates go by importance, as fractions that sum to `candidates`, > 0.
/// `Tree` is WideLightTree or InstancedLightTree.
template <typename Tree>
LightCut near_cut(const Tree& tree, const PointQuery& query, float candidates);

}  // namespace tyndall
