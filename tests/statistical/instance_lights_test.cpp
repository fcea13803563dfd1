/// Emissive objects that stand many times: one picture, whether their lights are shared or not.
#include <doctest/doctest.h>

#include "support/agreement.h"
#include "support/scene_text.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// 18 triangles in a wave, and a ball. That is two-sided: as in pbrt, a mirrored ball turns inside out, but not one in a
/// mirrored instance.
std::string emitter(const std::string& light) {
  std::string points, indices;
  for (int i = 0; i < 16; ++i) {
    const float x = 2.0f * (i % 4) / 3 - 1, y = 2.0f * (i / 4) / 3 - 1;
    points += number(x) + " " + number(y) + " " + number(0.4f * std::sin(3 * x + y)) + " ";
    if (i % 4 == 3 || i / 4 == 3) continue;
    for (const int k : {0, 1, 5, 0, 5, 4}) indices += std::to_string(i + k) + " ";
  }
  return "AreaLightSource \"diffuse\" " + light + "\nShape \"trianglemesh\" \"point3 P\" [" + points +
         "] \"integer indices\" [" + indices + "]\nAreaLightSource \"diffuse\" \"bool twosided\" true " + light +
         "\nTranslate 0 0.3 1\nShape \"sphere\" \"float radius\" 0.3\n";
}

/// Emitters turned, mirrored and of different sizes in a room with smoke.
std::string scene(bool instances, const std::string& light) {
  std::string text =
      view({.eye = {1.6f, 1.2f, -3.2f}, .look = {0, -0.1f, 0}, .fov_degrees = 42, .resolution = 24, .max_depth = 3}) +
      diffuse_plane(1.8f, 4, 0.6f) + point_light({1, 1.5f, -1}, 0.3f) +
      block(
          "Material \"conductor\" \"bool remaproughness\" false \"float roughness\" 0.2\n"
          "Translate 0.2 -0.9 -0.9\nShape \"sphere\" \"float radius\" 0.35\n");
  if (instances) text += "ObjectBegin \"emitter\"\n" + emitter(light) + "ObjectEnd\n";
  for (int i = 0; i < 7; ++i) {
    const float a = 0.9f * i, size = 0.06f + 0.03f * i;
    const std::string place = "Translate " + number(1.4f * std::cos(a)) + " " + number(-1.1f + 0.35f * i) + " " +
                              number(1.2f * std::sin(a)) + "\nRotate " + number(50.0f * i) + " 1 2 3\nScale " +
                              number(i % 2 ? -size : size) + " " + number(size) + " " + number(size) + "\n";
    text += block(place + (instances ? "ObjectInstance \"emitter\"\n" : emitter(light)));
  }
  const Bounds3 box{{-1, -1, -1}, {1, 1, 1}};
  return text + homogeneous("m", {.sigma_a = Rgb(0.1f), .sigma_s = {0.7f, 0.5f, 0.3f}, .g = 0.5f}) + medium_box("m", "", box);
}

}  // namespace

TEST_CASE("emitters as instances and each by itself") {
  const std::string bright = "\"rgb L\" [6 5 3]";
  check_all_agree("instances",
                  {{"shared", scene(true, bright)},
                   {"shared, split", scene(true, bright), {.candidates = 8, .splitting = 1}},
                   {"alone", scene(false, bright)}},
                  {.d = 2 * required_precision()});
}

TEST_CASE("emitters of given power as instances and each by itself") {
  const std::string watts = "\"rgb L\" [1 0.9 0.6] \"float power\" 0.5";
  check_all_agree("instances of given power", {{"shared", scene(true, watts)}, {"alone", scene(false, watts)}},
                  {.d = 2 * required_precision()});
}
