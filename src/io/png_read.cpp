#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <memory>
#include <vector>

#include "io/image_decode.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

/// What libpng's callbacks share with the reader.
struct Source {
  std::string_view bytes;
  std::size_t position = 0;
  char reason[200] = {};
};

/// A decoded file: rows of 8 or 16 bit samples in the machine's byte order.
struct Raster {
  png_uint_32 width = 0, height = 0;
  int channels = 0, bits = 0;
  std::vector<png_byte> bytes;
  std::vector<png_bytep> rows;
};

void on_read_error(png_structp png, png_const_charp message) {
  auto* source = static_cast<Source*>(png_get_error_ptr(png));
  std::strncpy(source->reason, message, sizeof source->reason - 1);
  std::longjmp(png_jmpbuf(png), 1);
}

void on_read_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep out, png_size_t count) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (count > source->bytes.size() - source->position) png_error(png, "the file is cut off");
  std::memcpy(out, source->bytes.data() + source->position, count);
  source->position += count;
}

// The two steps below may be left by longjmp: neither owns anything that a destructor would have to release.

bool read_header(png_structp png, png_infop info, Raster& raster) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_info(png, info);
  png_set_expand(png);  // palettes to RGB, 1-4 bits to 8, tRNS to alpha
  if (png_get_bit_depth(png, info) == 16) png_set_swap(png);
  const int passes = png_set_interlace_handling(png);
  static_cast<void>(passes);
  png_read_update_info(png, info);
  raster.width = png_get_image_width(png, info);
  raster.height = png_get_image_height(png, info);
  raster.channels = png_get_channels(png, info);
  raster.bits = png_get_bit_depth(png, info);
  return true;
}

bool read_rows(png_structp png, Raster& raster) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_image(png, raster.rows.data());
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }

std::string png_storage(std::string_view bytes) {
  constexpr std::size_t kBits = 24, kColor = 25;  // in the header's chunk, which is the first
  const auto color = static_cast<unsigned char>(bytes[kColor]);
  const char* what = color == 0   ? "grey"
                     : color == 2 ? "RGB"
                     : color == 3 ? "palette"
                     : color == 4 ? "grey with alpha"
                                  : "RGBA";
  return std::to_string(static_cast<int>(bytes[kBits])) + "-bit " + what + ", taken as sRGB";
}

ImageSize png_size(std::string_view bytes, const std::string& path) {
  constexpr std::size_t kAt = 16;  // after the signature, the length and the name of the first chunk
  if (bytes.size() < kAt + 8 || bytes.substr(12, 4) != "IHDR")
    throw Error(Failure::scene, path + ": cannot be read as PNG: it has no header");
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return static_cast<int>(std::min<std::uint32_t>(value, kMaxImageSide + 1));
  };
  return {number(kAt), number(kAt + 4)};
}

Image decode_png(std::string_view bytes, const Encoding& encoding, const std::string& path) {
  Source source{bytes};
  const auto fail = [&](const std::string& reason) -> void {
    throw Error(Failure::scene, path + ": cannot be read as PNG: " + reason);
  };
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_read_error, on_read_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  struct Release {
    png_structp* png;
    png_infop* info;
    ~Release() { png_destroy_read_struct(png, info, nullptr); }
  } const release{&png, &info};
  if (!info) fail("out of memory");
  png_set_read_fn(png, &source, on_read);
  png_set_user_limits(png, kMaxImageSide, kMaxImageSide);

  Raster raster;
  if (!read_header(png, info, raster)) fail(source.reason);
  // zlib cannot compress by more than 1032: refuse before memory is asked for
  const std::size_t row_bytes = std::size_t{raster.width} * static_cast<std::size_t>(raster.channels * raster.bits / 8);
  if (row_bytes / 8 * raster.height / 1100 > bytes.size())  // 1 bit a sample unfolds to 8
    fail("the file is too short for the size it declares");
  raster.bytes.resize(row_bytes * raster.height);
  raster.rows.resize(raster.height);
  for (std::size_t y = 0; y < raster.height; ++y) raster.rows[y] = raster.bytes.data() + y * row_bytes;
  if (!read_rows(png, raster)) fail(source.reason);

  const int width = static_cast<int>(raster.width), height = static_cast<int>(raster.height);
  if (raster.bits == 8) return image_from_samples(raster.bytes.data(), width, height, raster.channels, encoding);
  std::vector<std::uint16_t> wide(raster.bytes.size() / 2);
  std::memcpy(wide.data(), raster.bytes.data(), raster.bytes.size());
  return image_from_samples(wide.data(), width, height, raster.channels, encoding);
}

}  // namespace tyndall
