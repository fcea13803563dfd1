/// Cameras that stand on a boundary of media.
#pragma once

#include "surface/geometry.h"
#include "tyndall/scene.h"

namespace tyndall {

/// `camera`, moved by some roundings of its coordinates where its rays begin on a boundary: a ray may or may not meet what it
/// begins on, so no membership would do for all of them. It stands then where it looks, or on the other side if the medium
/// that it declares is there only.
Camera off_boundaries(Camera camera, const Film& film, const Geometry& geometry);

}  // namespace tyndall
