/// Figure 3 of Conty Estevez and Kulla: a Cornell box whose ceiling is covered with small lights. Boards hang under
/// them on edge, so that each point of the room sees its own part of the lights. The viewer stands above the ceiling's
/// height and sees none of them: their edges would make noise that has nothing to do with how lights are chosen.
#include <cmath>

#include "example/lamps.h"
#include "example/pbrt_text.h"
#include "example/scenes.h"
#include "example/shapes.h"

namespace tyndall {
namespace {

constexpr float kHalfWidth = 1.6f, kHeight = 1.8f, kDepth = 2.4f;  // metres

/// Spread evenly [Roberts 2018, the R2 sequence] and hung at slightly different heights, so that none lies in another's
/// plane: overlapping emitters in one plane would have no defined order.
std::vector<Lamp> ceiling_lamps(std::size_t count, Rng& rng) {
  constexpr double kA1 = 0.7548776662466927, kA2 = 0.5698402909980532;
  constexpr float kMargin = 0.04f;
  const double shift_x = rng.uniform_wide(), shift_z = rng.uniform_wide();
  const auto fraction = [](double v) { return static_cast<float>(v - std::floor(v)); };
  std::vector<Lamp> lamps(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = static_cast<double>(i);
    const float u = fraction(shift_x + n * kA1), v = fraction(shift_z + n * kA2);
    lamps[i].position = {(2 * u - 1) * (kHalfWidth - kMargin), kHeight - 0.001f - 0.02f * rng.uniform(),
                         kMargin + v * (kDepth - 2 * kMargin)};
  }
  share_power(lamps, 1, rng);
  return lamps;
}

void add_walls(PbrtText& text) {
  constexpr float w = kHalfWidth, h = kHeight, d = kDepth;
  text << "# The box, open toward the camera.\nAttributeBegin\n  Material \"diffuse\" \"rgb reflectance\" [0.73 0.71 0.68]\n"
       << quad({-w, 0, 0}, {-w, 0, d}, {w, 0, d}, {w, 0, 0}) << quad({-w, h, 0}, {w, h, 0}, {w, h, d}, {-w, h, d})
       << quad({-w, 0, d}, {-w, h, d}, {w, h, d}, {w, 0, d});
  text << "  Material \"diffuse\" \"rgb reflectance\" [0.63 0.06 0.05]\n"
       << quad({-w, 0, 0}, {-w, h, 0}, {-w, h, d}, {-w, 0, d});
  text << "  Material \"diffuse\" \"rgb reflectance\" [0.12 0.45 0.09]\n" << quad({w, 0, 0}, {w, 0, d}, {w, h, d}, {w, h, 0});
  text << "AttributeEnd\n";
}

void add_boards(PbrtText& text) {
  text << "# Boards on edge under the lights.\nAttributeBegin\n  Material \"diffuse\" \"rgb reflectance\" [0.55 0.42 0.28]\n";
  for (int i = -3; i <= 3; ++i) {
    const float x = 0.42f * static_cast<float>(i);
    text << box({x - 0.012f, 1.42f, 0.25f}, {x + 0.012f, 1.66f, 2.15f});
  }
  text << "AttributeEnd\n";
}

void add_furniture(PbrtText& text) {
  text << "# A tall block, a low one, a ball of metal on it and one of porcelain before them.\nAttributeBegin\n"
       << "  Material \"diffuse\" \"rgb reflectance\" [0.73 0.71 0.68]\n"
       << block({.foot = {-0.62f, 0, 1.62f}, .size = {0.56f, 1.1f, 0.56f}, .turn = 0.3f})
       << block({.foot = {0.55f, 0, 1.05f}, .size = {0.56f, 0.5f, 0.56f}, .turn = -0.3f});
  text << "  AttributeBegin\n    Material \"conductor\" \"spectrum eta\" \"metal-Cu-eta\" \"spectrum k\" \"metal-Cu-k\""
          " \"float roughness\" 0.05\n"
          "    Translate 0.55 0.7 1.05\n    Shape \"sphere\" \"float radius\" 0.2\n  AttributeEnd\n"
          "  AttributeBegin\n    Material \"coateddiffuse\" \"rgb reflectance\" [0.05 0.13 0.3] \"float roughness\" 0.02\n"
          "    Translate -0.2 0.22 0.75\n    Shape \"sphere\" \"float radius\" 0.22\n  AttributeEnd\nAttributeEnd\n";
}

}  // namespace

std::vector<ExampleFile> make_ceiling(const ExampleSettings& s) {
  PbrtText text = scene_head(s, {.eye = {0, 1.95f, -2.75f}, .look = {0, 0.7f, 1}, .fov_degrees = 30.5f});
  add_walls(text);
  add_boards(text);
  add_furniture(text);
  text << "# The lights.\n";
  Rng rng = stream(s.seed, 1);
  std::vector<ExampleFile> files{{scene_name(s), ""}};
  const LampSet set{.name = "ceiling_lights", .palette = {{1, 0.86f, 0.68f}}, .power = 30, .area = 0.5f};
  add_triangle_lamps(ceiling_lamps(s.lights, rng), set, rng, text, files);
  files.front().bytes = text.take();
  return files;
}

}  // namespace tyndall
