/// Light groups: kept beside a picture whose bits do not know of them, each is the picture of its own lights.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "report/relight.h"
#include "support/measure.h"
#include "support/sanitized.h"
#include "support/scene_text.h"
#include "tyndall/io.h"
#include "tyndall/lights.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kRoom{{-1, -1, -1}, {1, 1, 1}};
constexpr Bounds3 kHearth{{-0.5f, -0.9f, -0.4f}, {0.4f, 0.1f, 0.5f}};

/// Factors of the lights, and whether they have groups.
struct Strengths {
  float lamp = 1, panel = 1, signs = 1, sky = 1, fire = 1, glow = 1, none = 1;
  bool grouped = true;
};
using Strength = float Strengths::*;
const std::vector<std::pair<std::string, Strength>> kGroups{{"fire", &Strengths::fire},
                                                            {"glow", &Strengths::glow},
                                                            {"lamp", &Strengths::lamp},
                                                            {"panel", &Strengths::panel},
                                                            {"signs", &Strengths::signs},
                                                            {"sky", &Strengths::sky},
                                                            {std::string(kUngrouped), &Strengths::none}};

/// An object of more triangles than from which instances share their lights, and two places of it.
std::string signs(float L) {
  std::string points, indices;
  for (int i = 0; i < 18; ++i) {
    const double x = 0.05 * i;
    points += number(x) + " 0 0 " + number(x + 0.04) + " 0 0 " + number(x) + " 0.2 0 ";
    for (int k = 0; k < 3; ++k) indices += std::to_string(3 * i + k) + " ";
  }
  return "ObjectBegin \"sign\"\nMaterial \"diffuse\"\nAreaLightSource \"diffuse\" \"rgb L\" [" + number(L) + " " + number(L) +
         " 0] \"bool twosided\" true\nShape \"trianglemesh\" \"point3 P\" [" + points + "] \"integer indices\" [" + indices +
         "]\nObjectEnd\n" + block("Translate -0.9 0.5 0.7\nObjectInstance \"sign\"\n") +
         block("Translate 0.3 -0.7 -0.5\nRotate 40 0 1 0\nScale 0.7 0.7 0.7\nObjectInstance \"sign\"\n");
}

Grid flames() {
  Grid grid{kHearth, 6, 7, 5, {}};
  for (int i = 0; i < 6 * 7 * 5; ++i) grid.density.push_back(0.2f * static_cast<float>(i % 7));
  return grid;
}

/// Fire in a glowing smoke, all kinds of lights around.
std::string scene(const Strengths& s, const View& camera) {
  const auto in = [&](const std::string& group, const std::string& text) {
    if (!s.grouped) return block(text);
    const auto given_to = [&](const std::string& kind) {
      return "Attribute \"" + kind + "\" \"string lightgroup\" \"" + group + "\"\n";
    };
    return block(given_to("light") + given_to("medium") + text);
  };
  const Coefficients fire{.sigma_a = {2, 2.5f, 3}, .sigma_s = {1, 1, 1}, .g = 0.3f, .Le = Rgb{4, 2, 0.5f} * s.fire};
  const Coefficients smoke{.sigma_a = {0.1f, 0.2f, 0.1f}, .sigma_s = {0.7f, 0.6f, 0.8f}, .g = 0.2f, .Le = Rgb(0.4f * s.glow)};
  return view(camera) + in("lamp", point_light({0.7f, 0.6f, 0.2f}, 0.6f * s.lamp) + point_light({1.4f, 1.5f, -1}, s.lamp)) +
         in("panel", emitting_square({-0.5f, 0.4f, 0.9f}, 0.3f, 3 * s.panel)) + in("signs", signs(4 * s.signs)) +
         in("sky", environment(0.2f * s.sky)) + distant_light({0.4f, -1, 0.6f}, 0.4f * s.none) + diffuse_plane(1.4f, 2, 0.6f) +
         in("fire", uniform_grid("fire", fire, flames())) + in("glow", homogeneous("smoke", smoke)) +
         medium_box("fire", "", kHearth) + medium_box("smoke", "", kRoom);
}

View camera(int resolution = 24) {
  return {.eye = {0.9f, 0.7f, -2.6f}, .look = {0, -0.1f, 0.2f}, .fov_degrees = 45, .resolution = resolution, .max_depth = 4};
}

const std::vector<std::pair<std::string, Variant>>& variants() {
  static const std::vector<std::pair<std::string, Variant>> all{
      {"shared between pixels", {.reuse = ReuseStrategy::pixels}},
      {"emission as lights, shared", {.emission = EmissionStrategy::lights, .reuse = ReuseStrategy::pixels}},
      {"exhaustive", {.lights = LightStrategy::exhaustive}},
      {"at vertices, emission as lights", {.media = MediaStrategy::vertex, .emission = EmissionStrategy::lights}},
      {"both distances", {.distance = DistanceStrategy::both, .joint = JointStrategy::off}},
      {"tracking, by power", {.lights = LightStrategy::power, .distance = DistanceStrategy::tracking}}};
  return all;
}

const std::vector<float>& values(const Image& image, const std::string& channel) {
  const Channel* found = image.find(channel);
  REQUIRE_MESSAGE(found, channel);
  return found->values;
}

/// Most that the sum of the groups differs from `prefix` R, G and B by, in units in the last place of the larger of the light
/// and of the groups without their signs.
double largest_difference(const Image& image, const std::string& prefix = "") {
  double most = 0;
  for (const char* suffix : {"R", "G", "B"}) {
    const auto& light = values(image, prefix + suffix);
    for (std::size_t i = 0; i < light.size(); ++i) {
      double sum = 0, size = std::abs(light[i]);
      for (const auto& [group, strength] : kGroups) {
        const float part = values(image, prefix + light_group_channel(group) + suffix)[i];
        sum += part;
        size = std::max(size, std::abs(double{part}));
      }
      if (size == 0) continue;
      const double ulp = std::nextafter(static_cast<float>(size), INFINITY) - static_cast<float>(size);
      most = std::max(most, std::abs(sum - light[i]) / ulp);
    }
  }
  return most;
}

/// Mean of a channel over the picture, and what its left half is of it.
void add_means(const Image& image, const std::string& channel, Moments& whole, Moments& left) {
  const auto& v = values(image, channel);
  double sum = 0, half = 0;
  const auto width = static_cast<std::size_t>(image.width());
  for (std::size_t i = 0; i < v.size(); ++i) {
    sum += v[i];
    if (i % width < width / 2) half += v[i];
  }
  whole.add(sum / static_cast<double>(v.size()));
  left.add(half / static_cast<double>(v.size()));
}

/// One light channel, by several renders.
struct Known {
  Moments whole, left;
};
void check_equal(const Known& a, const Known& b, double precision) {
  const auto check = [&](const Moments& x, const Moments& y) {
    const Estimate u = x.estimate(), v = y.estimate();
    const double error = std::hypot(u.standard_error(), v.standard_error());
    CHECK(u.mean > 0);
    CHECK(error < precision * kCoarser * u.mean);
    CHECK(std::abs(u.mean - v.mean) < 4.5 * error);
  };
  check(a.whole, b.whole);
  check(a.left, b.left);
}

}  // namespace

TEST_CASE("light groups leave the picture as it is, bit for bit, and their sum is R G B within 4 ulp") {
  constexpr int kSpp = kSanitized ? 2 : 5;
  const std::vector<std::string> aovs{"Albedo",          "Variance",     "Emission",       "SurfaceDirect",
                                      "SurfaceIndirect", "VolumeDirect", "VolumeIndirect", "Replicate"};
  for (const auto& [name, variant] : variants()) {
    CAPTURE(name);
    Subject with(scene({}, camera()), variant), without(scene({.grouped = false}, camera()), variant);
    const Image a = with.render(kSpp, 3, aovs), b = without.render(kSpp, 3, aovs);
    for (const Channel& c : b.channels) CHECK_MESSAGE(c.values == values(a, c.name), c.name);
    CHECK(light_groups_in(b).empty());
    CHECK(light_groups_in(a).size() == kGroups.size());
    CHECK(a.channels.size() == b.channels.size() + 9 * kGroups.size());
    CHECK(largest_difference(a) <= 4);
    CHECK(largest_difference(a, "Replicate.") <= 4);
    CHECK(with.faults() == "");
  }
}

TEST_CASE("light groups sum to R G B under filters that are negative, and where samples are clamped") {
  View odd = camera(16);
  odd.filter = "\"mitchell\"";
  Scene clamped = read_scene_text(scene({}, odd), "test.pbrt").scene;
  Subject filtered(clamped, {.reuse = ReuseStrategy::pixels});
  CHECK(largest_difference(filtered.render(3, 1)) <= 4);
  clamped.film.max_component = 0.3f;
  clamped.film.imaging_ratio = 1.7f;
  CHECK(largest_difference(Subject(clamped, {.reuse = ReuseStrategy::pixels}).render(3, 1)) <= 4);
}

TEST_CASE("each light group is the picture of its lights alone") {
  const int renders = nightly() ? 64 : fewer(14), spp = 16;
  const double precision = nightly() ? 0.01 : 0.03;
  for (std::size_t v = 0; v < (nightly() ? 4u : 2u); ++v) {
    const auto& [name, variant] = variants()[v];
    std::vector<Known> groups(3 * kGroups.size());
    Subject all(scene({}, camera(16)), variant);
    for (int i = 0; i < renders; ++i) {
      const Image image = all.render(spp, 100 + i);
      for (std::size_t k = 0; k < groups.size(); ++k) {
        const std::string channel = light_group_channel(kGroups[k / 3].first) + "RGB"[k % 3];
        add_means(image, channel, groups[k].whole, groups[k].left);
      }
    }
    for (std::size_t g = 0; g < kGroups.size(); ++g) {
      CAPTURE(name);
      CAPTURE(kGroups[g].first);
      Strengths dark{0, 0, 0, 0, 0, 0, 0, false};
      dark.*kGroups[g].second = 1;
      Subject alone(scene(dark, camera(16)), variant);
      std::array<Known, 3> channels;
      for (int i = 0; i < renders; ++i) {
        const Image image = alone.render(spp, 500 + i);
        for (std::size_t k = 0; k < 3; ++k) add_means(image, std::string(1, "RGB"[k]), channels[k].whole, channels[k].left);
      }
      const bool yellow = kGroups[g].first == "signs";  // has no blue
      for (std::size_t k = 0; k < (yellow ? 2u : 3u); ++k) check_equal(groups[3 * g + k], channels[k], precision);
    }
  }
}

TEST_CASE("a relit picture is that of lights of other strengths") {
  const int renders = nightly() ? 64 : fewer(14), spp = 16;
  const std::vector<GroupFactor> factors{{"lamp", Rgb(2)}, {"sky", Rgb(0.5f)}, {"fire", Rgb(0)}, {"panel", Rgb(3)}};
  const Strengths scaled{.lamp = 2, .panel = 3, .sky = 0.5f, .fire = 0, .grouped = false};
  const Variant variant{.reuse = ReuseStrategy::pixels};
  Subject mixed(scene({}, camera(16)), variant), rendered(scene(scaled, camera(16)), variant);
  std::array<Known, 3> a, b;
  for (int i = 0; i < renders; ++i) {
    const Image x = relight(mixed.render(spp, 900 + i), factors).image, y = rendered.render(spp, 1200 + i);
    CHECK(largest_difference(x) <= 4);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string channel(1, "RGB"[k]);
      add_means(x, channel, a[k].whole, a[k].left);
      add_means(y, channel, b[k].whole, b[k].left);
    }
  }
  for (std::size_t k = 0; k < 3; ++k) check_equal(a[k], b[k], nightly() ? 0.01 : 0.03);
}
