#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <new>
#include <string>
#include <vector>

#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

png_byte to_srgb8(float linear) {
  if (!(linear > 0)) return 0;  // NaN too
  const float c = std::min(linear, 1.0f);
  const float encoded = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;  // IEC 61966-2-1
  return static_cast<png_byte>(std::lround(encoded * 255));
}

std::vector<png_byte> tone_mapped(const Image& image, float exposure) {
  const float scale = std::exp2(exposure);
  std::vector<png_byte> pixels;
  pixels.reserve(3 * static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.rgb(x, y) * scale;
      for (int i = 0; i < 3; ++i) pixels.push_back(to_srgb8(c[i]));
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

std::string encode_png(const Image& image, float exposure) {
  if (image.width() <= 0 || image.height() <= 0) throw Error(Failure::output, "cannot be written: the image has no pixels");
  const std::vector<png_byte> pixels = tone_mapped(image, exposure);

  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_write_error, on_write_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  std::string bytes;
  const bool encoded = info && encode(png, info, image, pixels.data(), bytes);
  png_destroy_write_struct(&png, &info);
  if (!encoded) throw Error(Failure::output, "cannot be written: out of memory");
  return bytes;
}

void write_png(const Image& image, const std::string& path, float exposure) {
  std::string bytes;
  try {
    bytes = encode_png(image, exposure);
  } catch (const Error& e) {
    throw Error(e.failure(), path + ": " + e.what());
  }
  write_file(bytes, path);
}

}  // namespace tyndall
