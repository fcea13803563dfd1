#include "io/exr.h"
#include "io/file_text.h"
#include "io/image_decode.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
Image read_image(const std::string& path, const std::string& encoding) {
  const Encoding decoded_by = parse_encoding(encoding, path);
  if (is_exr(path)) return read_exr(path).image;
  const std::string bytes = read_file_text(path);
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return decode_png(bytes, decoded_by, path);
  return decode_stb(bytes, decoded_by, path);
}

}  // namespace tyndall
