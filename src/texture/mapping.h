/// From a surface point to texture coordinates, with pbrt-v4's conventions.
#pragma once

#include <array>

#include "tyndall/scene.h"

namespace tyndall {

/// How far a surface point moves for a step of one pixel to the right (x) and down (y).
struct Footprint {
  Vec3 dpdx, dpdy;  ///< world space, in the tangent plane
  Vec2 duvdx, duvdy;
};

/// Where a texture is looked up: uv and the point in world space.
struct TextureQuery {
  Vec2 uv;
  Vec3 p;
  Vec3 n{};                              ///< unit geometric normal; 0: not known
  const Footprint* footprint = nullptr;  ///< null: a point
};

/// uv: scale * uv + offset. Of the point q in texture space: spherical (theta / pi, phi / 2 pi), cylindrical
/// ((pi + phi') / 2 pi, q.z), planar offset + (q . v1, q . v2). phi is in [0, 2 pi), phi' in [-pi, pi].
Vec2 map_to_texture(const TextureMapping& mapping, const TextureQuery& query);

/// How far those coordinates move for each step of the query's footprint; 0 where it has none.
std::array<Vec2, 2> steps_of_texture(const TextureMapping& mapping, const TextureQuery& query);

}  // namespace tyndall
