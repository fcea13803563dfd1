/// Figure 1 of Conty Estevez and Kulla: coloured lights over surfaces of several roughnesses. Five arches of lights span
/// a floor of six lanes of metal, from nearly a mirror to nearly dull, with a ball of the same metal on each and fins
/// between them that hide the lights of the neighbours. The lights turn their backs to the viewer (shade_from).
#include <cmath>

#include "example/lamps.h"
#include "example/pbrt_text.h"
#include "example/scenes.h"
#include "example/shapes.h"
#include "math/warp.h"

namespace tyndall {
namespace {

constexpr int kLanes = 6, kArches = 5, kHues = 24;
constexpr float kLaneWidth = 2, kHalfWidth = kLanes * kLaneWidth / 2, kFar = 17;  // metres
constexpr float kAlpha[kLanes] = {0.02f, 0.06f, 0.12f, 0.22f, 0.36f, 0.55f};

float lane_middle(int lane) { return (static_cast<float>(lane) + 0.5f) * kLaneWidth - kHalfWidth; }

std::vector<Lamp> arch_lamps(std::size_t count, Rng& rng) {
  std::vector<Lamp> lamps(count);
  for (Lamp& lamp : lamps) {
    const int arch = static_cast<int>(rng.uniform() * kArches);
    const float u = rng.uniform(), angle = kPi * u;
    const Vec3 on_arch{-(kHalfWidth + 0.4f) * std::cos(angle), 0.25f + 4.6f * std::sin(angle),
                       2.6f + 2.9f * static_cast<float>(arch)};
    const Vec3 scatter{normal_deviate(rng), normal_deviate(rng), normal_deviate(rng)};
    lamp.position = on_arch + scatter * 0.1f;
    lamp.position.y = std::max(lamp.position.y, 0.05f);
    lamp.normal = unit_vector(rng);
    const float hue = 0.8f * u + 0.11f * static_cast<float>(arch) + 0.02f * normal_deviate(rng);
    lamp.color = static_cast<int>((hue - std::floor(hue)) * kHues) % kHues;
  }
  share_power(lamps, 1, rng);
  return lamps;
}

void add_lane(PbrtText& text, int lane) {
  const float x0 = lane_middle(lane) - kLaneWidth / 2, x1 = x0 + kLaneWidth;
  text << "AttributeBegin\n  Material \"conductor\" \"rgb reflectance\" [0.78 0.77 0.75] \"bool remaproughness\" false"
       << " \"float roughness\" " << kAlpha[lane] << "\n"
       << quad({x0, 0, -4}, {x0, 0, kFar}, {x1, 0, kFar}, {x1, 0, -4});
  const Vec3 center{lane_middle(lane), 0.62f, 3.4f + 0.5f * static_cast<float>(lane % 2)};
  text << "  Translate " << center << "\n  Shape \"sphere\" \"float radius\" 0.62\nAttributeEnd\n";
}

void add_fins(PbrtText& text) {
  text << "# Fins between the lanes, and a wall behind.\nAttributeBegin\n  Material \"diffuse\" \"rgb reflectance\" [0.2 0.2 "
          "0.21]\n";
  for (int i = 0; i <= kLanes; ++i) {
    const float x = static_cast<float>(i) * kLaneWidth - kHalfWidth;
    for (int k = 0; k < 3; ++k) {
      const float z = 4.2f + 4 * static_cast<float>(k);
      text << box({x - 0.05f, 0, z}, {x + 0.05f, 1.1f, z + 2.4f});
    }
  }
  text << quad({-30, -0.01f, -8}, {-30, -0.01f, kFar}, {30, -0.01f, kFar}, {30, -0.01f, -8})
       << quad({-30, 0, kFar}, {-30, 14, kFar}, {30, 14, kFar}, {30, 0, kFar}) << "AttributeEnd\n";
}

}  // namespace

std::vector<ExampleFile> make_glossy_lights(const ExampleSettings& s) {
  constexpr View kView{.eye = {0, 2.35f, -6}, .look = {0, 1.75f, 3}, .fov_degrees = 41};
  PbrtText text = scene_head(s, kView);
  text << "# Lanes of metal, each with a ball.\n";
  for (int lane = 0; lane < kLanes; ++lane) add_lane(text, lane);
  add_fins(text);
  text << "# The lights.\n";
  LampSet set{.name = "glossy_lights", .palette = {}, .power = 1800, .area = 24};
  for (int i = 0; i < kHues; ++i) set.palette.push_back(hue_color((static_cast<float>(i) + 0.5f) / kHues));
  Rng rng = stream(s.seed, 1);
  std::vector<ExampleFile> files{{scene_name(s), ""}};
  std::vector<Lamp> lamps = arch_lamps(s.lights, rng);
  shade_from(kView.eye, lamps);
  add_triangle_lamps(lamps, set, rng, text, files);
  files.front().bytes = text.take();
  return files;
}

}  // namespace tyndall
