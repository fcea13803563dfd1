/// The intensity profiles of a scene's lights: each file is read once, however many lights name it.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "light/intensity_profile.h"
#include "tyndall/scene.h"

namespace tyndall {

class ProfileLibrary {
 public:
  /// Profiles stay where they are. Throws Error at `where` when a file cannot be read or used.
  const IntensityProfile& of(const GoniometricLight& light, const Location& where, KeptFiles* kept = nullptr);
  const IntensityProfile& of(const ProjectionLight& light, const Location& where, KeptFiles* kept = nullptr);
  std::size_t memory_bytes() const;

 private:
  using Key = std::pair<std::string, float>;  ///< path, and a projection's field of view or 0
  std::map<Key, std::shared_ptr<const IntensityProfile>> profiles_;
};

}  // namespace tyndall
