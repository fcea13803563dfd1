/// A small scene for tests of what goes on around the rendering.
#pragma once

#include <string>

#include "tyndall/io.h"
#include "tyndall/render.h"

namespace tyndall::test {

/// A lit sphere, in a frame of so many pixels.
inline std::string sphere_scene(int width, int height) {
  return "Film \"rgb\" \"integer xresolution\" " + std::to_string(width) + " \"integer yresolution\" " +
         std::to_string(height) + R"(
Camera "perspective" "float fov" 50
WorldBegin
LightSource "point" "rgb I" [ 1 2 3 ] "point3 from" [ 1 1 2 ]
Translate 0 0 4
Shape "sphere" "float radius" 1.5
)";
}

inline World world_of(const std::string& text, const BuildSettings& settings) {
  return build(read_scene_text(text, "test.pbrt").scene, settings);
}

}  // namespace tyndall::test
