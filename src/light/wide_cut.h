/// Adaptive splitting: the cut through the light tree that a point or a segment draws its candidates from
/// [Conty Estevez and Kulla 2018, sec. 5.4; best first as in Walter et al. 2005].
#pragma once

#include "light/instanced_light_tree.h"
#include "light/light_cut.h"

namespace tyndall {

/// Clusters by their NodeRef. Clusters that cannot contribute are left out. Those with the largest predicted deviation
/// are split first, as long as one has a score below `settings.splitting` and there is room: for as many clusters as
/// candidates, and for 15 at least. Candidates go by importance, as fractions that sum to `settings.candidates`; without a
/// limit every cluster has one.
/// `Tree` is WideLightTree or InstancedLightTree, `Query` PointQuery or Segment.
template <typename Tree, typename Query>
LightCut wide_cut(const Tree& tree, const Query& query, const CutSettings& settings);

}  // namespace tyndall
