/// The scene in the renderer's own units: about 1 in size, and near the origin.
#pragma once

#include "tyndall/scene.h"

namespace tyndall {

struct UnitScene {
  Scene scene;
  Transform to_user;  ///< from its space to that of the scene as it was given
  double unit = 1;    ///< length there of 1 here; a power of two
};

/// Lengths are divided by the power of two that brings the shapes' extent to (0.5, 1], coefficients of media multiplied by
/// it, intensities and powers divided by its square: the same picture, by arithmetic that rounds nothing. A scene whose
/// shapes lie together far from the origin is moved there as well, transforms being composed in double precision; one that
/// lies around or near the origin, where floats are finest, is left in its place.
UnitScene in_unit_size(Scene scene);

}  // namespace tyndall
