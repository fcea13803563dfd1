/// Scenes as text in the pbrt format.
#pragma once

#include <string>
#include <string_view>

#include "example/scenes.h"
#include "tyndall/math.h"
#include "tyndall/scene.h"

namespace tyndall {

/// Text put together from pieces. Numbers are as short as they can be and still read back as the same float.
class PbrtText {
 public:
  PbrtText& operator<<(std::string_view text);
  PbrtText& operator<<(const char* text) { return *this << std::string_view(text); }
  PbrtText& operator<<(float number);
  PbrtText& operator<<(int number);
  PbrtText& operator<<(Vec3 v);                    ///< "x y z"
  PbrtText& operator<<(Rgb c);                     ///< "r g b"
  PbrtText& operator<<(const TriangleMesh& mesh);  ///< a Shape line, positions and indices alone

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

struct View {
  Vec3 eye, look;
  float fov_degrees;  ///< of the shorter axis
};

/// The scene up to WorldBegin: a comment with the command that makes it, Film, Sampler, Integrator and Camera.
/// `camera_medium` is text put before the Camera: a medium that it stands in.
PbrtText scene_head(const ExampleSettings& settings, const View& view, std::string_view camera_medium = "");

std::string scene_name(const ExampleSettings& settings);  ///< "NAME.pbrt"

}  // namespace tyndall
