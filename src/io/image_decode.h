/// Decoders of the picture formats behind read_image, each from a file's bytes in memory.
#pragma once

#include <string>
#include <string_view>

#include "tyndall/image.h"
#include "tyndall/io.h"

namespace tyndall {

/// How stored integers become linear light.
struct Encoding {
  enum class Kind { linear, srgb, gamma } kind = Kind::srgb;
  float gamma = 2.2f;
  bool of_alpha = false;  ///< too: a texture's, as in pbrt-v4

  float decode(float stored) const;  ///< both in [0,1]
};
/// "" (sRGB, but for alpha), "sRGB", "linear" or "gamma <g>" as in pbrt. Throws Error (scene) that names `path` otherwise.
Encoding parse_encoding(const std::string& text, const std::string& path);

inline constexpr int kMaxImageSide = 1 << 16;

/// Channels Y or R G B, and A when the file has transparency. Throw Error (scene) that names `path`.
Image decode_png(std::string_view bytes, const Encoding& encoding, const std::string& path);
/// .hdr, .jpg, .tga and .bmp, without alpha.
Image decode_stb(std::string_view bytes, const Encoding& encoding, const std::string& path);

/// .pfm: floats, which are linear.
Image decode_pfm(std::string_view bytes, const std::string& path);
bool is_pfm(std::string_view bytes);
bool is_png(std::string_view bytes);
/// "8-bit RGB, taken as sRGB": how the header of a PNG says that its pixels are stored. `bytes` have been decoded before.
std::string png_storage(std::string_view bytes);

/// What their headers declare.
ImageSize png_size(std::string_view bytes, const std::string& path);
ImageSize pfm_size(std::string_view bytes, const std::string& path);
ImageSize stb_size(std::string_view bytes, const std::string& path);

/// `samples` interleaved values in [0,1], `count` a pixel (1: Y, 2: Y A, 3: R G B, 4: R G B A), as planes that
/// went through `encoding` by a table.
template <class Integer>
Image image_from_samples(const Integer* samples, int width, int height, int count, const Encoding& encoding);

extern template Image image_from_samples(const std::uint8_t*, int, int, int, const Encoding&);
extern template Image image_from_samples(const std::uint16_t*, int, int, int, const Encoding&);

}  // namespace tyndall
