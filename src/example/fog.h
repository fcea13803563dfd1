/// A box of fog that the camera stands in.
#pragma once

#include "example/pbrt_text.h"
#include "example/shapes.h"

namespace tyndall {

struct Fog {
  Bounds3 bounds;
  Rgb sigma_s, sigma_a;  ///< 1/m, at density 1
  float g = 0;
  float density = 1;
};

/// For scene_head's `camera_medium`: the medium "fog", and the Camera in it.
inline std::string fog_medium(const Fog& fog) {
  PbrtText text;
  text << "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [" << fog.sigma_s << "] \"rgb sigma_a\" ["
       << fog.sigma_a << "] \"float g\" " << fog.g << " \"float scale\" " << fog.density << "\n"
       << "MediumInterface \"\" \"fog\"\n";
  return text.take();
}

/// The box around the fog.
inline void add_fog(const Fog& fog, PbrtText& text) {
  text << "# The fog's box.\nAttributeBegin\n  MediumInterface \"fog\" \"\"\n  Material \"interface\"\n"
       << box(fog.bounds.min, fog.bounds.max) << "AttributeEnd\nMediumInterface \"\" \"\"\n";
}

}  // namespace tyndall
