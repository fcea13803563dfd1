/// Deep images: laid flat they are the picture, whose light does not know of them, and their light is where it comes from.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/measure.h"
#include "support/sanitized.h"
#include "support/scene_text.h"
#include "tyndall/deep_image.h"
#include "tyndall/io.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};

RenderSettings settings_of(const Scene& scene, const Variant& v) {
  RenderSettings s = scene.settings;
  s.lights = v.lights;
  s.media = v.media;
  s.distance = v.distance;
  s.emission = v.emission;
  s.joint = v.joint;
  s.reuse = v.reuse;
  return s;
}

/// A world, rendered with a deep image and without.
class Shot {
 public:
  Shot(const std::string& text, const Variant& variant)
      : scene_(read_scene_text(text, "test.pbrt").scene), settings_(settings_of(scene_, variant)), world_(build_world()) {}

  Rendering render(int spp, std::optional<int> bins, std::uint64_t seed = 1) const {
    RenderSettings settings = settings_;
    settings.spp = spp;
    settings.seed = seed;
    settings.deep_bins = bins;
    return tyndall::render(world_, settings);
  }

 private:
  World build_world() const {
    return build(scene_, {.lights = {settings_.lights}, .volume_lights = settings_.emission != EmissionStrategy::paths});
  }

  Scene scene_;
  RenderSettings settings_;
  World world_;
};

/// Largest difference of a channel to that of what the deep image makes, over its mean.
double difference(const Rendering& rendering, const char* channel) {
  const auto &a = rendering.image.find(channel)->values, b = flatten(*rendering.deep).find(channel)->values;
  double worst = 0, mean = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, std::abs(double{a[i]} - double{b[i]}) / std::max(1.0, std::abs(double{a[i]})));
    mean += double{a[i]} / static_cast<double>(a.size());
  }
  return worst / std::min(1.0, mean);
}

bool is_tidy(const DeepImage& deep) {
  const DeepPixelSample* sample = deep.samples.data();
  for (const std::uint32_t count : deep.counts) {
    float last = 0;
    for (std::uint32_t i = 0; i < count; ++i, ++sample) {
      if (!(sample->z >= last && sample->z_back >= sample->z && sample->rgba[3] >= 0 && sample->rgba[3] <= 1)) return false;
      last = sample->z_back;
    }
  }
  return true;
}

Grid clumps() {
  Grid grid{kBox, 5, 6, 7, {}};
  for (int i = 0; i < 5 * 6 * 7; ++i) grid.density.push_back(0.3f * static_cast<float>(i % 7));
  return grid;
}

/// Everything that estimates light: fire in smoke in which glass, lamps and a small bright panel stand, before a wall and a
/// sky.
std::string everything(const std::string& filter) {
  View camera{.eye = {0.9f, 0.7f, -2.6f}, .look = {0, -0.1f, 0.2f}, .fov_degrees = 55, .resolution = 24, .max_depth = 4};
  if (!filter.empty()) camera.filter = filter;
  const Coefficients fire{.sigma_a = {2, 2.5f, 3}, .sigma_s = {1, 1, 1}, .g = 0.3f, .Le = {4, 2, 0.5f}};
  const Coefficients haze{.sigma_a = {0.1f, 0.2f, 0.1f}, .sigma_s = {0.7f, 0.6f, 0.8f}, .g = 0.2f, .Le = Rgb(0.2f)};
  return view(camera) + point_light({0.4f, 0.5f, -0.2f}, 0.6f) + point_light({1.4f, 1.5f, -1}, 1) +
         emitting_square({-0.5f, 0.4f, 0.9f}, 0.02f, 300) + environment(0.2f) + distant_light({0.4f, -1, 0.6f}, 0.4f) +
         diffuse_plane(1.4f, 1, 0.6f) +
         block("Translate 0.5 -0.5 -0.3\nMaterial \"dielectric\"\nShape \"sphere\" \"float radius\" 0.2\n") +
         uniform_grid("fire", fire, clumps()) + homogeneous("haze", haze) +
         medium_box("fire", "", {{-0.5f, -0.9f, -0.4f}, {0.4f, 0.1f, 0.5f}}) + medium_box("haze", "", kBox);
}

const std::vector<std::pair<std::string, Variant>>& variants() {
  static const std::vector<std::pair<std::string, Variant>> all{
      {"shared between pixels", {.reuse = ReuseStrategy::pixels}},
      {"alone", {}},
      {"emission as lights, shared", {.emission = EmissionStrategy::lights, .reuse = ReuseStrategy::pixels}},
      {"at vertices", {.media = MediaStrategy::vertex}},
      {"exhaustive, both distances", {.lights = LightStrategy::exhaustive, .distance = DistanceStrategy::both}},
      {"tracking", {.distance = DistanceStrategy::tracking, .joint = JointStrategy::off}}};
  return all;
}

/// Light and opacity that come from each of `bins`, in channel G, of all pixels' mean: as a flat picture counts them.
struct ByBin {
  std::vector<double> light, opacity;
};
ByBin by_bin(const DeepImage& deep, double near, double far, int bins) {
  ByBin sums{std::vector<double>(static_cast<std::size_t>(bins) + 2), std::vector<double>(static_cast<std::size_t>(bins) + 2)};
  const DeepPixelSample* sample = deep.samples.data();
  for (const std::uint32_t count : deep.counts) {
    double passing = 1 / static_cast<double>(deep.counts.size());
    for (std::uint32_t i = 0; i < count; ++i, ++sample) {
      const double middle = sample->z_back > sample->z ? 0.5 * (double{sample->z} + double{sample->z_back}) : double{sample->z};
      const double at = std::clamp((middle - near) / (far - near) * bins + 1, 0.0, bins + 1.0);
      sums.light[static_cast<std::size_t>(at)] += passing * double{sample->rgba[1]};
      sums.opacity[static_cast<std::size_t>(at)] += passing * double{sample->rgba[3]};
      passing *= 1 - double{sample->rgba[3]};
    }
  }
  return sums;
}

}  // namespace

TEST_CASE("a deep image laid flat is the picture, whose light has the bits of one without it") {
  constexpr int kSpp = kSanitized ? 2 : 6;
  for (const auto& [name, variant] : variants()) {
    CAPTURE(name);
    const Shot shot(everything(""), variant);
    const Rendering with = shot.render(kSpp, 16), without = shot.render(kSpp, std::nullopt);
    CHECK_FALSE(without.deep);
    REQUIRE(with.deep);
    for (const char* channel : {"R", "G", "B"}) {
      CHECK(with.image.find(channel)->values == without.image.find(channel)->values);
      CHECK(difference(with, channel) < 2e-5);
    }
    CHECK(difference(with, "A") < 2e-6);
    CHECK(is_tidy(*with.deep));
    CHECK(with.image.data == with.deep->data);
  }
}

TEST_CASE("the same where samples are clamped, exposed and weighed, for any number of bins") {
  for (const int bins : {1, 7, 256}) {
    CAPTURE(bins);
    const Rendering rendering = Shot(everything("\"triangle\" \"float xradius\" 2 \"float yradius\" 2"), {}).render(4, bins);
    for (const char* channel : {"R", "G", "B", "A"}) CHECK(difference(rendering, channel) < 2e-5);
    CHECK(is_tidy(*rendering.deep));
  }
  Scene scene = read_scene_text(everything(""), "test.pbrt").scene;
  scene.film.max_component = 0.3f;
  scene.film.imaging_ratio = 1.7f;
  RenderSettings settings = scene.settings;
  settings.spp = 5;
  settings.deep_bins = 16;
  const Rendering clamped = render(build(scene), settings);
  for (const char* channel : {"R", "G", "B", "A"}) CHECK(difference(clamped, channel) < 2e-5);
}

// Light from the side, straight through a slab that the camera looks along: what is scattered on the way to depth s is
// sigma_s E exp(-sigma_t) (1 - exp(-sigma_t s)) / (4 pi sigma_t), and exp(-sigma_t s) gets through.
TEST_CASE("light and opacity of smoke come from the depth where they arise") {
  constexpr int kBins = 4;
  const double sigma_s = 0.8, sigma_t = 1.1, E = 5;
  const Coefficients smoke{.sigma_a = Rgb(0.3f), .sigma_s = Rgb(0.8f)};
  const std::string scene = view({.eye = {0, 0, -4}, .look = {}, .resolution = 8, .max_depth = 1}) +
                            distant_light({0, -1, 0}, static_cast<float>(E)) + homogeneous("m", smoke) +
                            medium_box("m", "", kBox);
  const std::vector<Variant> variants{{},
                                      {.media = MediaStrategy::vertex},
                                      {.media = MediaStrategy::integral},  // by pairs alone
                                      {.distance = DistanceStrategy::equiangular},
                                      {.distance = DistanceStrategy::tracking}};
  for (const Variant& variant : variants) {
    const Rendering rendering = Shot(scene, variant).render(fewer(4000), kBins);
    const ByBin found = by_bin(*rendering.deep, 3, 5, kBins);
    const auto passed = [&](double s) { return (1 - std::exp(-sigma_t * s)); };
    for (int k = 0; k < kBins; ++k) {
      CAPTURE(k);
      const double share = passed((k + 1) * 2.0 / kBins) - passed(k * 2.0 / kBins);
      const double light = sigma_s * E * std::exp(-sigma_t) / (4 * M_PI * sigma_t) * share;
      CHECK(found.light[static_cast<std::size_t>(k) + 1] == doctest::Approx(light).epsilon(0.02 * kCoarser));
      CHECK(found.opacity[static_cast<std::size_t>(k) + 1] == doctest::Approx(share).epsilon(1e-4));
    }
    CHECK(found.light.front() + found.light.back() == 0);
  }
}

TEST_CASE("emission comes from the depth where it is emitted, of even media and of grids") {
  constexpr int kBins = 4;
  const double sigma = 1.3, Le = 2;
  const Coefficients glow{.sigma_a = Rgb(1.3f), .Le = Rgb(2)};
  const std::string camera = view({.eye = {0, 0, -4}, .look = {}, .resolution = 8, .max_depth = 2});
  Grid even{{{-2, -2, -2}, {2, 2, 2}}, 4, 4, 4, std::vector<float>(64, 1)};
  for (const std::string& medium : {homogeneous("m", glow), uniform_grid("m", glow, even)}) {
    const Rendering rendering = Shot(camera + medium + medium_box("m", "", kBox), {}).render(fewer(2000), kBins);
    const ByBin found = by_bin(*rendering.deep, 3, 5, kBins);
    for (int k = 0; k < kBins; ++k) {
      CAPTURE(k);
      const double s = k * 2.0 / kBins, end = (k + 1) * 2.0 / kBins;
      const double share = std::exp(-sigma * s) - std::exp(-sigma * end);
      CHECK(found.light[static_cast<std::size_t>(k) + 1] == doctest::Approx(Le * share).epsilon(0.02 * kCoarser));
      CHECK(found.opacity[static_cast<std::size_t>(k) + 1] == doctest::Approx(share).epsilon(0.01 * kCoarser));
    }
  }
}

TEST_CASE("what pixels share comes from the depths where it does without sharing") {
  constexpr int kBins = 4;
  const int renders = fewer(24);
  const Coefficients smoke{.sigma_a = Rgb(0.05f), .sigma_s = Rgb(0.9f), .g = 0.2f};
  const std::string scene = view({.eye = {0, 0, -4}, .look = {}, .fov_degrees = 1, .resolution = 16, .max_depth = 5}) +
                            point_light({0, 1.1f, -0.9f}, 4) + diffuse_plane(0.9f, 5, 0.8f) + homogeneous("m", smoke) +
                            medium_box("m", "", kBox);
  const Shot shared(scene, {.reuse = ReuseStrategy::pixels}), alone(scene, {});
  std::array<std::vector<Moments>, 2> light;
  for (std::size_t which = 0; which < 2; ++which) {
    light[which].resize(kBins + 2);
    for (int i = 0; i < renders; ++i) {
      const Rendering r = (which ? alone : shared).render(32, kBins, 100 * which + static_cast<std::size_t>(i));
      const ByBin found = by_bin(*r.deep, 3, 4.9, kBins);
      for (std::size_t k = 0; k < found.light.size(); ++k) light[which][k].add(found.light[k]);
    }
  }
  for (std::size_t k = 1; k < kBins + 1; ++k) {
    CAPTURE(k);
    const Estimate a = light[0][k].estimate(), b = light[1][k].estimate();
    const double error = std::hypot(a.standard_error(), b.standard_error());
    CHECK(a.mean > 0);
    CHECK(error < 0.03 * kCoarser * a.mean);
    CHECK(std::abs(a.mean - b.mean) < 4.5 * error);
  }
}
