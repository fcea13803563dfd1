#include <bit>
#include <cstdint>
#include <string>

#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

void append(float value, std::string& bytes) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
}

}  // namespace

void write_pfm(const Image& image, const std::string& path) {
  if (image.width() <= 0 || image.height() <= 0)
    throw Error(Failure::output, path + ": cannot be written: the image has no pixels");
  const bool grey = !(image.find("R") && image.find("G") && image.find("B"));
  // A negative scale says that the lowest byte comes first.
  std::string bytes =
      (grey ? "Pf\n" : "PF\n") + std::to_string(image.width()) + " " + std::to_string(image.height()) + "\n-1.0\n";
  for (int y = image.height() - 1; y >= 0; --y) {  // the bottom row first
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.rgb(x, y);
      for (int i = 0; i < (grey ? 1 : 3); ++i) append(c[i], bytes);
    }
  }
  write_file(bytes, path);
}

}  // namespace tyndall
