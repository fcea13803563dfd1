/// Equal scenes, settings and seeds give equal bits, whatever the number of threads; other seeds give other noise.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "report/block_test.h"
#include "support/measure.h"
#include "support/same_pixels.h"
#include "support/sanitized.h"
#include "support/scene_text.h"
#include "tyndall/io.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};

View camera(int resolution) {
  return {.eye = {1.6f, 1.2f, -3.2f}, .look = {0, -0.1f, 0}, .fov_degrees = 42, .resolution = resolution, .max_depth = 8};
}

std::vector<std::string> scenes(int resolution = 40) {
  Grid grid{kBox, 4, 4, 4, {}};
  for (int i = 0; i < 64; ++i) grid.density.push_back(0.1f * float(i % 11));
  const Coefficients smoke{.sigma_a = {0.2f, 0.1f, 0.4f}, .sigma_s = {2, 1, 0.6f}, .g = 0.5f, .Le = {0.1f, 0, 0}};
  const std::string lights =
      point_light({1.5f, 2, -1.5f}, 6) + emitting_square({-1.2f, 0.8f, 1.4f}, 0.5f, 4) + environment(0.15f);
  const std::string ball = block("Material \"coateddiffuse\"\nShape \"sphere\" \"float radius\" 0.6\n");
  return {view(camera(resolution)) + lights + diffuse_plane(1.8f, 4, 0.6f) + uniform_grid("m", smoke, grid) +
              medium_box("m", "", kBox),
          view(camera(resolution)) + lights + diffuse_plane(1.8f, 4, 0.6f) + ball,
          view(camera(resolution)) + lights + ball + homogeneous("m", smoke) + medium_box("m", "", kBox)};
}

}  // namespace

TEST_CASE("the same bits for 1, 2 and 4 threads, and for every repetition") {
  constexpr int kSpp = kSanitized ? 2 : 9;
  std::vector<std::string> aovs;
  for (const std::string_view name : aov_names()) aovs.emplace_back(name);
  for (const std::string& scene : scenes()) {
    for (const LightStrategy lights : {LightStrategy::tree, LightStrategy::tree_binary, LightStrategy::power,
                                       LightStrategy::lightcuts, LightStrategy::cells}) {
      const Image one =
          Subject(scene, {.lights = lights, .threads = 1, .emission = EmissionStrategy::lights, .reuse = ReuseStrategy::pixels})
              .render(kSpp, 5, aovs);
      for (const int threads : {1, 2, 4}) {
        CAPTURE(threads);
        CHECK(same_bits_and_header(one, Subject(scene, {.lights = lights,
                                                        .threads = threads,
                                                        .emission = EmissionStrategy::lights,
                                                        .reuse = ReuseStrategy::pixels})
                                            .render(kSpp, 5, aovs)));
      }
      CHECK_FALSE(same_bits_and_header(
          one,
          Subject(scene, {.lights = lights, .threads = 1, .emission = EmissionStrategy::lights, .reuse = ReuseStrategy::pixels})
              .render(kSpp, 6, aovs)));
    }
  }
}

TEST_CASE("a crop has the bits of the whole picture") {
  Scene scene = read_scene_text(scenes()[0], "test.pbrt").scene;
  const Image whole = Subject(scene, {.emission = EmissionStrategy::lights, .reuse = ReuseStrategy::pixels}).render(4, 1);
  scene.film.crop = {7, 11, 29, 32};
  const Image crop = Subject(scene, {.emission = EmissionStrategy::lights, .reuse = ReuseStrategy::pixels}).render(4, 1);
  REQUIRE(crop.data == scene.film.crop);
  CHECK(same_pixels(crop, whole));
}

namespace {

/// The same picture of scene(0), whose rays in media are traced as far as their collision only, and of scene(Le), which emits
/// so faintly that nothing is left of it in a float, but in pixels that are black without it: its rays are traced to their end.
template <typename Scene>
void check_same_traced(const Scene& scene) {
  constexpr int kSpp = kSanitized ? 2 : 16;
  const Variant vertex{.media = MediaStrategy::vertex};  // no choice that could go by how far a ray was traced
  Subject ended(scene(0), vertex), traced(scene(1e-30f), vertex);
  const Image a = ended.render(kSpp, 3), b = traced.render(kSpp, 3);
  bool same = true;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const Rgb d = a.rgb(x, y) - b.rgb(x, y);
      same = same && std::max(max_component(d), max_component(d * -1)) < 1e-20f;
    }
  }
  CHECK(same);
  CHECK(ended.faults() + traced.faults() == "");
}

}  // namespace

TEST_CASE("rays that end at their collision make the picture that rays traced to their end make") {
  check_same_traced([](float Le) {
    const Coefficients thin{.sigma_a = {0.2f, 0, 0.1f}, .sigma_s = {2, 1, 0.6f}, .g = 0.5f, .Le = Rgb(Le)};
    const Coefficients dense{.sigma_a = {0.1f, 0, 1}, .sigma_s = {20, 12, 30}, .g = -0.3f, .Le = Rgb(Le)};
    return view(camera(40)) + environment(0.3f) + distant_light({1, 2, -1}, 3) + diffuse_plane(1.8f, 4, 0.6f) +
           block("Material \"dielectric\"\nShape \"sphere\" \"float radius\" 0.4\n") + homogeneous("thin", thin) +
           homogeneous("dense", dense) + medium_box("thin", "", kBox) +
           medium_box("dense", "thin", {{-0.9f, -0.9f, -0.9f}, {0.3f, 0.5f, 0.9f}}) +
           medium_box("dense", "", {{0.2f, -1.4f, -0.5f}, {1.4f, 0.4f, 0.5f}});
  });
}

// Of many bricks, some of which are split where a ray passes far through them: by as much whether a surface ends it or not.
TEST_CASE("rays in a grid end at their collision as if they had been traced past the surfaces in it") {
  check_same_traced([](float Le) {
    Grid grid{kBox, 40, 40, 40, {}};
    for (std::uint32_t i = 0; i < 64'000; ++i) grid.density.push_back((i * 2654435761u >> 20) % 499 == 0 ? 4.0f : 1.0f);
    const Coefficients smoke{.sigma_a = {0.1f, 0, 0.05f}, .sigma_s = {3, 2.5f, 2}, .g = 0.5f, .Le = Rgb(Le)};
    return view(camera(40)) + environment(0.3f) + distant_light({1, 2, -1}, 3) +
           block("Material \"diffuse\"\nTranslate 0.1 0.2 0.1\nShape \"sphere\" \"float radius\" 0.4\n") +
           uniform_grid("smoke", smoke, grid) + medium_box("smoke", "", kBox);
  });
}

// All the statistics of these tests rest on it: pixels, and renders with different seeds, are independent.
TEST_CASE("the spread between renders is what the spread between pixels says") {
  const std::string scene = view({.eye = {0.1f, 0.2f, -2}, .look = {0.1f, 0.2f, 0}, .max_depth = 3}) + environment(1) +
                            homogeneous("m", {.sigma_a = Rgb(0.3f), .sigma_s = Rgb(0.7f)}) + medium_box("m", "", kBox);
  Subject subject(scene);
  Moments means, pixels;
  constexpr int kRenders = fewer(200);
  for (int i = 0; i < kRenders; ++i) {
    const Image image = subject.render(4, 1000 + i);
    Moments mean;
    for (const float v : image.find("R")->values) {
      mean.add(v);
      pixels.add(v);
    }
    means.add(mean.estimate().mean);
  }
  // Both estimate the variance of the mean of everything; the first with 199 degrees of freedom.
  const double ratio = means.estimate().variance / pixels.estimate().variance;
  CHECK(std::abs(ratio - 1) < 4 * std::sqrt(2.0 / (kRenders - 1)));
}

TEST_CASE("the Variance AOV is the variance of a pixel's mean") {
  for (const std::string& scene : scenes(24)) {
    Subject subject(scene);
    MeanImageBuilder spread;
    Moments claimed;
    constexpr int kRenders = kSanitized ? 6 : 24, kSpp = 16;
    for (int i = 0; i < kRenders; ++i) {
      const Image image = subject.render(kSpp, 100 + i, {"Variance"});
      spread.add(image);
      claimed.add(image_mean(mean_image(image, 1), 1).variance);
    }
    const Estimate truth = image_mean(spread.result(), 1), claim = claimed.estimate();
    const double between = truth.variance * kRenders;  // of one render's image mean
    const double error = between * std::sqrt(2 / truth.dof) + claim.standard_error();
    CHECK(std::abs(claim.mean - between) < 4 * error);
  }
}
