/// Renders whose pixels share what their paths find, against renders whose pixels do not.
#pragma once

#include <string>

#include "support/measure.h"
#include "support/scene_text.h"

namespace tyndall::test {

/// The room of these tests, from -z where the camera is: a back wall at z = 2, sides at x = -2 and 2, and what mirrors,
/// refracts and lets light through. A block in it has edges that some pixels of a block see.
std::string sharing_camera(int max_depth, float fov_degrees = 62);
/// A wall of a colour: a bilinear mesh of these four corners.
std::string sharing_wall(const std::string& rgb, const std::string& corners);
std::string sharing_sides();       ///< floor, ceiling and the walls at x = -2 and 2
std::string sharing_end(float z);  ///< a wall across the room
std::string sharing_things();
std::string sharing_unlit_room();  ///< all of these, and a wall behind the camera
std::string sharing_room();        ///< lit by two points and a square
/// By squares alone: next to points in media means converge slowly, and t-tests take that for a bias.
std::string sharing_soft_room();
/// In three colours.
Coefficients sharing_thin_fog();
/// A grid of smoke in the middle.
std::string sharing_smoke(const Coefficients& coefficients);

/// Samples where fewer see too little of rare light: of 16 a block differed by 6.0 standard errors, of 32 by 3.2; and gains,
/// which are known as badly, were below what they are held to.
inline constexpr int kManyToShare = 32;

/// Holds pictures to each other, block by block and in their means, at a level of 1e-3. Pixels that share are not independent:
/// errors come from the spread of whole blocks between 24 renders: fewer see too little of rare light to tell. A bias of 5.6
/// standard errors of a block's difference is found in half of all cases (768 differences). `worth`: how much less variance
/// sharing has at least. With fixed numbers of lights, to which pilot_test.cpp holds measured ones: these take half the time.
void check_sharing(const char* name, const std::string& text, Variant variant, double worth, int spp = nightly() ? 32 : 16);

}  // namespace tyndall::test
