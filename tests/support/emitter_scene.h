/// Emitters of every shape before a camera.
#pragma once

#include <string>

namespace tyndall::test {

inline const std::string kPerspective = "Camera \"perspective\" \"float fov\" 34";
inline const std::string kOrthographic = "Camera \"orthographic\" \"float screenwindow\" [-1.2 1.2 -0.9 0.9]";

inline std::string emitter(const std::string& where, const std::string& shape) {
  return "AttributeBegin\n" + where + "\nAreaLightSource \"diffuse\" \"rgb L\" [3 2 1] \"bool twosided\" true\n" + shape +
         "AttributeEnd\n";
}

/// In the middle of a small picture with a box filter, by a camera at distance 3.
inline std::string before_camera(const std::string& camera, const std::string& things) {
  return "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 18\nPixelFilter \"box\"\n"
         "LookAt 0 0 -3  0 0 0  0 1 0\n" +
         camera + "\nWorldBegin\n" + things;
}

/// One of each shape, whole and cut, some beyond the frame, one behind the camera.
inline std::string emitters() {
  return emitter("Translate -0.6 0.3 0", "Shape \"sphere\" \"float radius\" 0.2\n") +
         emitter("Translate 0.5 0.4 0 Scale 1 0.5 1", "Shape \"sphere\" \"float radius\" 0.3 \"float zmax\" 0.1\n") +
         emitter("Translate 0.1 -0.6 0 Rotate 40 1 1 0", "Shape \"disk\" \"float radius\" 0.3\n") +
         emitter("Translate 0.9 -0.4 0 Rotate 70 1 0.3 0", "Shape \"cylinder\" \"float radius\" 0.1\n") +
         emitter("Translate -0.9 -0.5 0", "Shape \"bilinearmesh\" \"point3 P\" [0 0 0  0.4 0 0.1  0 0.3 0.2  0.35 0.4 0]\n") +
         emitter("Translate -0.3 -0.1 0",
                 "Shape \"trianglemesh\" \"point3 P\" [0 0 0  0.3 0 0.1  0 0.2 0  0.4 0.3 0] "
                 "\"integer indices\" [0 2 1 1 2 3]\n") +
         emitter("Translate 0 0 -9", "Shape \"sphere\" \"float radius\" 0.2\n");
}

/// By a camera at distance 3.
inline std::string emitter_scene(const std::string& camera) {
  return "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 18\nPixelFilter \"gaussian\"\n"
         "LookAt 0.1 0.2 -3  0 0 0  0 1 0\n" +
         camera + "\nWorldBegin\n" + emitters();
}

}  // namespace tyndall::test
