#include "light/profile_library.h"

#include <algorithm>
#include <cctype>

#include "tyndall/error.h"
#include "tyndall/frames.h"

namespace tyndall {
namespace {

bool is_photometric(std::string path) {
  std::transform(path.begin(), path.end(), path.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return path.ends_with(".ies");
}

GoniometricMap read_map(const std::string& path) {
  const TexelImage image = TexelImage::load(path);
  if (image.width() == image.height() && image.width() > 0) return GoniometricMap(image);
  throw Error(Failure::scene, "goniometric map \"" + path + "\" is " + std::to_string(image.width()) + " x " +
                                  std::to_string(image.height()) + "; it must be square, in the equal-area mapping");
}

IntensityProfile goniometric(const std::string& path, const Location& where) {
  if (is_photometric(path)) return IntensityProfile(PhotometricTable(read_ies(path)));
  // Errors of images name the file; those of scenes the light.
  try {
    return IntensityProfile(read_map(path));
  } catch (const Error& error) {
    throw Error(where, error.what());
  }
}

IntensityProfile projection(const ProjectionLight& light, const Location& where) {
  try {
    return IntensityProfile(ProjectedImage(TexelImage::load(light.path), light.fov_degrees));
  } catch (const Error& error) {
    throw Error(where, error.what());
  }
}

}  // namespace

const IntensityProfile& ProfileLibrary::of(const GoniometricLight& light, const Location& where, KeptFiles* kept) {
  auto& profile = profiles_[{light.path, 0.0f}];
  if (!profile)
    profile = get_kept<IntensityProfile>(kept, {light.path, "profile"}, [&] { return goniometric(light.path, where); });
  return *profile;
}

const IntensityProfile& ProfileLibrary::of(const ProjectionLight& light, const Location& where, KeptFiles* kept) {
  auto& profile = profiles_[{light.path, light.fov_degrees}];
  const KeptFiles::Use use{light.path, "projection " + std::to_string(light.fov_degrees)};
  if (!profile) profile = get_kept<IntensityProfile>(kept, use, [&] { return projection(light, where); });
  return *profile;
}

std::size_t ProfileLibrary::memory_bytes() const {
  std::size_t bytes = 0;
  for (const auto& [key, profile] : profiles_) bytes += profile->memory_bytes();
  return bytes;
}

}  // namespace tyndall
