/// An RGB picture ready for look-ups: the texels of image textures, emission images and environment maps.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/image.h"
#include "tyndall/math.h"
#include "tyndall/scene.h"

namespace tyndall {

class KeptFiles;  // tyndall/frames.h

/// Light and reflectance below zero do not exist; heights do.
inline Rgb positive_part(Rgb c) { return {std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f)}; }

struct TexelPlace {
  int x, y;
};

/// Linear RGB texels, row by row from the top. Image coordinates st: (0,0) is the top left corner, (1,1) the bottom
/// right one, texel centres at (x + 0.5) / width. Surface uv has v upward: pass {u, 1 - v}, as pbrt does.
class TexelImage {
 public:
  using Wrap = ImageTexture::Wrap;
  static constexpr std::array<float, 9> kIdentity{1, 0, 0, 0, 1, 0, 0, 0, 1};

  TexelImage() = default;
  /// `texels` holds width * height colours; `alpha` as many values, or none.
  TexelImage(int width, int height, std::vector<Rgb> texels, std::vector<float> alpha = {});

  /// R G B, Y or the only channel of `image`, negative values made 0. Throws Error (scene), which names `path`, when
  /// a value is NaN or infinite or there are no such channels.
  static TexelImage from(const Image& image, const std::string& path);

  /// An emission image or environment map, by read_image. Values are taken to Rec.709 as light is (no white
  /// adaptation): by the file's own chromaticities when it states them, else by the row-major `to_rec709`. Channels
  /// may come out slightly negative when the file's gamut is wider.
  static TexelImage load(const std::string& path, const std::string& encoding = "",
                         const std::array<float, 9>& to_rec709 = kIdentity);
  /// The same for 8-bit sRGB and all others, from `kept` when it is there.
  static std::shared_ptr<const TexelImage> load(KeptFiles* kept, const std::string& path,
                                                const std::array<float, 9>& to_rec709 = kIdentity);

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return texels_.empty(); }
  bool has_alpha() const { return !alpha_.empty(); }  ///< only when some texel is not opaque
  std::size_t memory_bytes() const { return texels_.size() * sizeof(Rgb) + alpha_.size() * sizeof(float); }

  const Rgb& texel(int x, int y) const { return texels_[index(x, y)]; }  ///< 0 <= x < width, 0 <= y < height
  float alpha(int x, int y) const { return alpha_.empty() ? 1.0f : alpha_[index(x, y)]; }

  /// Where the texel lies that continues the image at any x and y; nothing where that is black.
  std::optional<TexelPlace> place(int x, int y, Wrap wrap) const;
  /// Coordinates brought to where one period is at most a texel away, so that texels fit an int; NaN and infinity to 0.
  static Vec2 tamed(Vec2 st, Wrap wrap);

  Rgb nearest(Vec2 st, Wrap wrap) const;  ///< the texel that holds st
  Rgb bilinear(Vec2 st, Wrap wrap) const;
  float bilinear_alpha(Vec2 st, Wrap wrap) const;
  Rgb average() const;  ///< mean of all texels

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_ = 0, height_ = 0;
  std::vector<Rgb> texels_;
  std::vector<float> alpha_;
};

}  // namespace tyndall
