/// Which media hold the camera.
#pragma once

#include <array>

#include "transport/media/media_state.h"

namespace tyndall {

/// Unit directions spread evenly over the sphere, none along an axis.
std::array<Vec3, 32> directions_all_around();

/// Membership of `center`, found by tracing to infinity in many directions: a group holds the point when its signed
/// crossings say so along nearly all of them. One direction would do for a closed boundary; a vote also judges open
/// ones (a floor that has fog on one side) and is not upset by a ray that meets an edge.
/// `declared` is the Camera's medium: it fills all space unless a group that holds the camera has it inside.
MediaState find_camera_media(std::optional<MediumId> declared, Vec3 center, const Geometry& geometry);

}  // namespace tyndall
