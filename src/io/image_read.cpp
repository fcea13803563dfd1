#include <filesystem>

#include "io/exr.h"
#include "io/file_text.h"
#include "io/image_decode.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

void require_regular(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    throw Error(Failure::scene, path + ": is no regular file; name an image");
}

}  // namespace

ImageSize read_image_size(const std::string& path) {
  require_regular(path);
  if (is_exr(path)) {
    const Image header = read_exr_header(path);
    return {header.width(), header.height()};
  }
  const std::string bytes = read_file_text(path);
  if (is_pfm(bytes)) return pfm_size(bytes, path);
  return is_png(bytes) ? png_size(bytes, path) : stb_size(bytes, path);
}

Image read_image(const std::string& path, const std::string& encoding) {
  const Encoding decoded_by = parse_encoding(encoding, path);
  require_regular(path);
  if (is_exr(path)) return read_exr(path).image;
  const std::string bytes = read_file_text(path);
  if (bytes.empty()) throw Error(Failure::scene, path + ": is empty; it may not have been written to its end");
  if (is_png(bytes)) return decode_png(bytes, decoded_by, path);
  if (is_pfm(bytes)) return decode_pfm(bytes, path);
  return decode_stb(bytes, decoded_by, path);
}

}  // namespace tyndall
