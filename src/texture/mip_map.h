/// Image look-ups that average over a footprint [Williams 1983, Heckbert 1989], with pbrt-v4's conventions.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "texture/texel_image.h"

namespace tyndall {

constexpr bool is_mip_mapped(const ImageTexture& texture) {
  return texture.filter == ImageTexture::Filter::trilinear || texture.filter == ImageTexture::Filter::elliptical;
}

/// Images of half the size each, down to one texel; every texel is the mean of those it covers.
std::vector<TexelImage> coarser_levels(const TexelImage& image);

/// An image with its coarser levels, and where to look: image coordinates, and how far they move for each step of a pixel.
struct MipMap {
  const TexelImage& image;
  std::span<const TexelImage> coarser;
};
struct MipLookup {
  Vec2 st;
  std::array<Vec2, 2> steps;
  TexelImage::Wrap wrap;
};

/// Bilinear in the two levels whose texels are about as wide as the footprint.
Rgb trilinear(const MipMap& map, const MipLookup& at);
float trilinear_alpha(const MipMap& map, const MipLookup& at);

/// A Gaussian over the ellipse that the steps span, in the levels whose texels are about as wide as its short axis; ellipses
/// longer than `max_anisotropy` are made wider.
Rgb elliptical(const MipMap& map, const MipLookup& at, float max_anisotropy);

}  // namespace tyndall
