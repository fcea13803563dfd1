/// Point lights close to surfaces, whose film positions are drawn for them.
#include <doctest/doctest.h>

#include <cmath>

#include "support/agreement.h"
#include "support/noise.h"
#include "support/scene_text.h"
#include "support/strategies.h"
#include "tyndall/io.h"
#include "tyndall/render.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// Pixels are 0.19 wide at the plane z = 0.
View look_down(int max_depth) {
  return {.eye = {1, 2, -4}, .look = {0, 0, 0}, .fov_degrees = 36, .resolution = 16, .max_depth = max_depth};
}

/// Over the plane z = 0.
std::string lights_at(float height) {
  std::string text;
  for (int i = 0; i < 5; ++i) {
    const float a = 1.3f * static_cast<float>(i);
    text += point_light({0.7f * std::cos(a), 0.6f * std::sin(a), -height * static_cast<float>(1 + i % 2)}, 0.01f);
  }
  return text +
         "LightSource \"spot\" \"point3 from\" [0.1 0.05 -0.05] \"point3 to\" [0.2 0 0.1] \"float coneangle\" 60 "
         "\"float conedeltaangle\" 30 \"rgb I\" [0.03 0.02 0.01]\n";
}

Agreement to(double per_commit) { return {.d = nightly() ? 0.01 : per_commit}; }

}  // namespace

// A quarter of a pixel and half of one above a plane, a wall beside it, a glossy ball through it.
TEST_CASE("film positions drawn below lights make the picture of the filter's, with all filters, in fog and through smoke") {
  const std::string surfaces = diffuse_plane(0, 3, 0.5f) +
                               block("Translate 0.9 0 0\nRotate 90 0 1 0\n" + diffuse_plane(0, 3, 0.6f)) +
                               block(
                                   "Translate -0.5 0.4 0.1\nMaterial \"conductor\" \"float roughness\" 0.3\n"
                                   "Shape \"sphere\" \"float radius\" 0.25\n") +
                               point_light({0.86f, 0.3f, -0.5f}, 0.02f);
  const std::string smoke = uniform_grid("smoke", {.sigma_a = Rgb(0.1f), .sigma_s = {0.5f, 0.4f, 0.3f}, .g = 0.3f},
                                         {{{-1, -1, -1}, {0.5f, 1, 0.5f}}, 2, 1, 1, {1, 0.3f}}) +
                            medium_box("smoke", "", {{-1, -1, -1}, {0.5f, 1, 0.5f}});
  struct Case {
    const char* filter;
    const std::string& media;
    int max_depth;
  };
  const std::string clear;
  for (const auto& [filter, media, max_depth] :
       {Case{"box", smoke, 2}, Case{"gaussian", clear, 1}, Case{"mitchell", clear, 1}}) {
    View seen = look_down(max_depth);
    seen.before_camera = homogeneous("fog", {.sigma_a = Rgb(0.05f), .sigma_s = Rgb(0.02f)});
    if (!media.empty()) seen.medium = "fog";
    seen.filter = '"' + std::string(filter) + '"';
    check_all_agree(filter, view(seen) + surfaces + lights_at(0.05f) + media,
                    {{"off", {.joint = JointStrategy::off}}, {"points", {.joint = JointStrategy::points}}}, to(0.04));
  }
}

TEST_CASE("the same without perspective") {
  View seen{.eye = {1, 2, -4}, .look = {0, 0, 0}, .half_width = 1.5f, .resolution = 16, .max_depth = 1};
  check_all_agree("orthographic", view(seen) + diffuse_plane(0, 3, 0.5f) + lights_at(0.05f),
                  {{"off", {.joint = JointStrategy::off}}, {"points", {.joint = JointStrategy::points}}}, to(0.02));
}

// A fiftieth of a pixel above the plane, and a five-hundredth, where the filter would have a hundred times the noise. Of 16,384
// samples 800 come as near as a fiftieth, so that the filter's noise there is known to a few per cent.
TEST_CASE("lights right above a surface have little of the filter's noise, at any height and scale of the scene") {
  constexpr int kMany = 16'384, kFew = 64;
  const std::string plane = diffuse_plane(0, 3, 0.5f);
  const Noise filtered = noise_of(view(look_down(1)) + plane + lights_at(0.004f), JointStrategy::off, kMany);
  const double noise = filtered.noise * kMany / kFew;
  for (const float height : {0.004f, 0.0004f}) {
    for (const float scale : {1.0f, 1e-4f, 1e4f}) {
      const std::string s = number(scale), larger = "Scale " + s + ' ' + s + ' ' + s + '\n';
      View seen = look_down(1);
      seen.eye = seen.eye * scale;
      const Noise drawn = noise_of(view(seen) + larger + plane + lights_at(height), JointStrategy::points, kFew);
      // The lights' power stays what it is: at another scale the picture is brighter by 1 / scale^2.
      const double same = double{scale} * scale, own = drawn.noise * same * same;
      CHECK(own < 0.1 * noise);
      // What the plane receives of a light hardly depends on its height.
      const double differs = height == 0.004f ? 0 : 0.005 * filtered.mean;
      CHECK(std::abs(drawn.mean * same - filtered.mean) < differs + 4 * std::sqrt(filtered.noise + own));
    }
  }
}

// Seen at a grazing angle, where a light's pixels reach far beyond a crop.
TEST_CASE("a crop has the bits of the whole picture, wherever the lights stand") {
  const View seen{.eye = {0, 0.3f, -4}, .look = {0, 0, 0}, .fov_degrees = 36, .resolution = 48, .max_depth = 2};
  const std::string scene = view(seen) + block("Rotate 90 1 0 0\n" + diffuse_plane(0, 3, 0.5f)) +
                            block("Rotate 90 1 0 0\n" + lights_at(0.02f)) + block("Rotate -90 1 0 0\n" + lights_at(0.01f));
  const World world = build(read_scene_text(scene, "crop.pbrt").scene);
  RenderSettings settings;
  settings.spp = 4;
  settings.budget = BudgetStrategy::fixed;
  const Image whole = render(world, settings).image;
  settings.crop = PixelBounds{9, 26, 14, 40};
  const Image crop = render(world, settings).image;
  std::size_t lit = 0;
  for (const char* channel : {"R", "G", "B"}) {
    for (int y = 26; y < 40; ++y) {
      for (int x = 9; x < 14; ++x) {
        const auto of = [&](const Image& image) {
          const PixelBounds& data = image.data;
          return image.find(channel)->values[data.index(x, y)];
        };
        lit += of(whole) > 0;
        CHECK(of(crop) == of(whole));
      }
    }
  }
  CHECK(lit > 100);
}
