/// The grids of a VDB medium, found, checked and made ready.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tyndall/scene.h"
#include "volume/medium.h"
#include "volume/medium_data.h"

namespace tyndall {

struct VdbGrids {
  PlacedGrid density;  ///< one channel, or three of a vec3 grid
  Transform density_to_world;
  std::optional<PlacedGrid> temperature, flame;
};

/// Throws Error (scene). Appends to `notes` which grids were chosen and what was changed in them.
VdbGrids load_vdb_grids(const Medium& medium, const VdbMedium& vdb, const MediumBuildOptions& options,
                        std::vector<std::string>& notes);

}  // namespace tyndall
