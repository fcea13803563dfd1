#include <png.h>
#include <algorithm>

#include <array>
#include <cmath>
#include <csetjmp>
#include <new>
#include <string>
#include <vector>

#include "math/cie.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

png_byte to_byte(float shown) { return static_cast<png_byte>(std::lround(shown * 255)); }

std::vector<png_byte> bytes_shown(const Image& image, const PngSettings& settings) {
  constexpr float kMost = 1e15f;  // of light that matrices and views take without overflow
  const float scale = std::exp2(settings.exposure);
  const auto to_rec709 = rec709_from(image.chromaticities.value_or(Chromaticities()), false);
  std::vector<png_byte> pixels;
  pixels.reserve(3 * static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      Rgb c = image.rgb(x, y) * scale;
      for (int i = 0; i < 3; ++i) c[i] = std::clamp(c[i], -kMost, kMost);
      const Rgb shown = displayed(image.chromaticities ? transformed(to_rec709, c) : c, settings.view);
      for (int i = 0; i < 3; ++i) pixels.push_back(to_byte(shown[i]));
    }
  return pixels;
}

void on_write_error(png_structp png, png_const_charp) { std::longjmp(png_jmpbuf(png), 1); }
void on_write_warning(png_structp, png_const_charp) {}
void on_write(png_structp png, png_bytep bytes, png_size_t count) {
  bool taken = true;
  try {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
  } catch (const std::bad_alloc&) {
    taken = false;  // no exception may cross a library written in C
  }
  if (!taken) png_error(png, "out of memory");
}
void on_flush(png_structp) {}

/// Appends the file to `out`; false when there is no memory for it. May be left by longjmp, so it owns nothing.
bool encode(png_structp png, png_infop info, const Image& image, const png_byte* pixels, std::string& out) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &out, on_write, on_flush);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width()), static_cast<png_uint_32>(image.height()), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  for (int y = 0; y < image.height(); ++y)
    png_write_row(png, pixels + 3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width()));
  png_write_end(png, info);
  return true;
}

}  // namespace

std::string encode_png(const Image& image, const PngSettings& settings) {
  if (image.width() <= 0 || image.height() <= 0) throw Error(Failure::output, "cannot be written: the image has no pixels");
  const std::vector<png_byte> pixels = bytes_shown(image, settings);

  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_write_error, on_write_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  std::string bytes;
  const bool encoded = info && encode(png, info, image, pixels.data(), bytes);
  png_destroy_write_struct(&png, &info);
  if (!encoded) throw Error(Failure::output, "cannot be written: out of memory");
  return bytes;
}

void write_png(const Image& image, const std::string& path, const PngSettings& settings) {
  std::string bytes;
  try {
    bytes = encode_png(image, settings);
  } catch (const Error& e) {
    throw Error(e.failure(), path + ": " + e.what());
  }
  write_file(bytes, path);
}

}  // namespace tyndall
