/// Whether the values of a scene are such that it can be rendered.
#pragma once

#include "tyndall/scene.h"

namespace tyndall {

/// Readers point at the parameter that is wrong; this is for scenes that were made or changed by hand, and stands where all
/// pass. Throws Error (scene) for numbers that are not finite, angles and sizes that cannot be, negative strengths. What is
/// wrong with indices, meshes, quadrics, indices of refraction and lenses is said where these are built.
void check_values(const Scene& scene);

// Of its parts:
void check_lights(const Scene& scene);  ///< shapes that emit included
void check_media(const Scene& scene);
void check_view(const Scene& scene);   ///< camera, film, filter
void check_looks(const Scene& scene);  ///< textures, materials

}  // namespace tyndall
