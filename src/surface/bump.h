/// Shading normals that textures bend.
#pragma once

#include <functional>

#include "math/frame.h"
#include "surface/geometry.h"
#include "texture/mapping.h"

namespace tyndall {

/// What bending needs to know beside the shading frame; made for the surfaces alone that ask for it.
struct SurfaceDetail {
  SurfaceTangents tangents;
  Footprint footprint;
};

/// Fills the uv part of a footprint from its steps: the least-squares solution on the surface [PBR book 4th ed., 10.1.1].
Footprint footprint_on(const SurfaceTangents& tangents, Vec3 dpdx, Vec3 dpdy);

/// The frame whose normal `texel` holds, components from [0, 1] to [-1, 1] in `shading` [PBR book 4th ed., 10.5.3]. The normal
/// is turned to the side of `ng`, as pbrt does it, so that back sides bend otherwise.
Frame normal_mapped(const Frame& shading, Vec3 ng, Rgb texel);

/// The frame of the surface moved along its normal by `height`, a function of where a texture is looked up in world units
/// [Blinn 1978; PBR book 4th ed., 10.5.2]: forward differences over half a pixel.
Frame bumped(const Frame& shading, const TextureQuery& at, const SurfaceTangents& tangents,
             const std::function<float(const TextureQuery&)>& height);

}  // namespace tyndall
