/// Light found by the ray from the first bounce, shared by the paths of neighbouring pixels [Bekaert et al. 2002].
///
/// Neighbours see much the same, yet each path looks in one direction. What its ray from the first vertex meets, a surface, a
/// collision in a medium or an environment, is received by the pixels of the other paths too, whose paths might have met it as
/// well: on the surfaces that they see (vertex_shares.h) or anywhere along their rays through media
/// (segment_shares.h). A connection costs a shadow ray whatever it brings: finds that are worth little play roulette.
#pragma once

#include <optional>
#include <span>

#include "transport/path/path.h"
#include "transport/sharing/find_link.h"

namespace tyndall {

/// Hands out what the offers of `paths` are worth to each of them: at most kMostSharing, whose offers are complete where they
/// stand at a vertex, which has taken the work `finding`. `collisions_shared`: whether those beyond collisions in grids are;
/// nothing: by how far apart they are.
void share_suffixes(const Between& between, std::span<Path* const> paths, const Counters& finding,
                    std::optional<bool> collisions_shared);

}  // namespace tyndall
