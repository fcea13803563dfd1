#include "light/profile_library.h"

#include <algorithm>
#include <cctype>

#include "tyndall/error.h"

namespace tyndall {
namespace {

/// Errors of images name the file; those of scenes the light.
TexelImage load_image(const std::string& path, const Location& where) {
  try {
    return TexelImage::load(path);
  } catch (const Error& error) {
    throw Error(where, error.what());
  }
}

bool is_photometric(std::string path) {
  std::transform(path.begin(), path.end(), path.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return path.ends_with(".ies");
}

IntensityProfile goniometric(const std::string& path, const Location& where) {
  if (is_photometric(path)) return IntensityProfile(PhotometricTable(read_ies(path)));
  const TexelImage image = load_image(path, where);
  if (image.width() != image.height() || image.width() == 0)
    throw Error(where, "goniometric map \"" + path + "\" is " + std::to_string(image.width()) + " x " +
                           std::to_string(image.height()) + "; it must be square, in the equal-area mapping");
  return IntensityProfile(GoniometricMap(image));
}

}  // namespace

const IntensityProfile& ProfileLibrary::of(const GoniometricLight& light, const Location& where) {
  std::unique_ptr<const IntensityProfile>& profile = profiles_[{light.path, 0.0f}];
  if (!profile) profile = std::make_unique<const IntensityProfile>(goniometric(light.path, where));
  return *profile;
}

const IntensityProfile& ProfileLibrary::of(const ProjectionLight& light, const Location& where) {
  std::unique_ptr<const IntensityProfile>& profile = profiles_[{light.path, light.fov_degrees}];
  if (!profile)
    profile = std::make_unique<const IntensityProfile>(ProjectedImage(load_image(light.path, where), light.fov_degrees));
  return *profile;
}

std::size_t ProfileLibrary::memory_bytes() const {
  std::size_t bytes = 0;
  for (const auto& [key, profile] : profiles_) bytes += profile->memory_bytes();
  return bytes;
}

}  // namespace tyndall
