/// Free flight by the optical depth itself: one number tells where a path collides.
#pragma once

#include "volume/tracking.h"

namespace tyndall {

/// Like free_flight(), and for the same arguments: but `u_first`, uniform in [0, 1), decides alone where the flight ends, as
/// far as it goes through cells of a grid or homogeneous media and these are not too many. What is stratified in `u_first` is
/// stratified in the optical depth, where null collisions would mix the strata. Regular tracking [Novak et al. 2018]:
/// dearer than free_flight() in fine grids, for the flights that matter most.
Flight regular_flight(MediaView media, const Ray& ray, float t0, float t1, Rgb beta, float u_first, Rng& rng,
                      TrackingStats& stats);

}  // namespace tyndall
