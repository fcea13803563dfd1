#include <filesystem>

#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

std::string ending_of(const std::string& path) { return std::filesystem::path(path).extension().string(); }

}  // namespace

bool is_written_image(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".exr" || ending == ".png" || ending == ".pfm";
}

void write_image(const Image& image, const std::string& path, const ImageFormat& format) {
  const std::string ending = ending_of(path);
  if (ending == ".exr") return write_exr(image, path, format.exr);
  if (ending == ".png") return write_png(image, path, format.png);
  if (ending == ".pfm") return write_pfm(image, path);
  throw Error(Failure::usage, path + ": is no image that can be written; give a name that ends in .exr, .png or .pfm");
}

}  // namespace tyndall
