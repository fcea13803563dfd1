/// One picture of a medium among lights, by every strategy for lights, distances and transmittances: a set of combinations
/// that holds every pair of strategies.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/agreement.h"
#include "support/covering.h"
#include "support/noise.h"
#include "support/scene_text.h"
#include "support/strategies.h"
#include "tyndall/io.h"
#include "tyndall/render.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};

std::string look(int max_depth) {
  return view({.eye = {1.4f, 0.9f, -3.4f}, .look = {0, -0.1f, 0}, .fov_degrees = 38, .resolution = 32, .max_depth = max_depth});
}

/// A light without extent; or a ball, of about the same power.
enum class SmallLight { point, ball };
std::string small_light(SmallLight kind, Vec3 p, float I) {
  if (kind == SmallLight::point) return point_light(p, I);
  constexpr float kRadius = 0.15f;
  const std::string L = number(I / (kPi * kRadius * kRadius));
  return block("Translate " + number(p.x) + " " + number(p.y) + " " + number(p.z) +
               "\nAreaLightSource \"diffuse\" \"rgb L\" [" + L + " " + L + " " + L + "]\nShape \"sphere\" \"float radius\" " +
               number(kRadius) + "\n");
}

/// Small lights around the box, area lights in it and around it, a sun and a sky. Where a point light stands in a medium no
/// strategy that chooses lights at collisions has a finite variance, for these can be as near to it as you like: balls are for
/// a fog without bounds, and point lights in media are below, among techniques that sample places near them.
std::string lights(SmallLight kind = SmallLight::point) {
  std::string text = environment(0.2f) + distant_light({1, -1, 2}, 0.3f);
  for (int i = 0; i < 8; ++i) {
    const float a = 0.8f * i, r = 1.9f + 0.05f * i;
    text += small_light(kind, {r * std::cos(a), -0.9f + 0.25f * i, r * std::sin(a)}, 0.05f * (1 + i % 3));
  }
  for (int i = 0; i < 3; ++i) text += emitting_square({-0.7f + 0.6f * i, 0.3f * i - 0.4f, 0.5f}, 0.12f, 1.0f + i);
  text += emitting_square({0, 1.4f, 1.6f}, 0.5f, 1.5f);
  return text +
         block(
             "Translate 0.5 -0.5 -0.6\nAreaLightSource \"diffuse\" \"rgb L\" [2 1 0.5]\nShape \"sphere\" \"float radius\" "
             "0.2\n");
}

Grid holes() {
  Grid grid{kBox, 7, 6, 8, {}};
  for (int i = 0; i < 7 * 6 * 8; ++i) {
    const int x = i % 7, y = i / 7 % 6, z = i / 42;
    const float r2 = float((x - 3) * (x - 3) + (y - 2) * (y - 2) + (z - 4) * (z - 4));
    grid.density.push_back((x * 5 + y * 3 + z * 7) % 5 == 0 ? 0.0f : std::max(0.05f, 1 - r2 / 16));
  }
  return grid;
}

/// With its hundreds of shadow rays a path, lightcuts is left to the night.
std::vector<LightStrategy> compared_lights() {
  auto lights = every_lights();
  if (!nightly()) std::erase(lights, LightStrategy::lightcuts);
  return lights;
}

struct Factors {
  std::vector<MediaStrategy> media = every_media();
  std::vector<DistanceStrategy> distance = every_distance();
  std::vector<float> splitting{0, 0.6f};
  std::vector<std::pair<std::optional<int>, int>> candidates{{std::nullopt, 1}, {1, 1}, {5, 2}, {0, 0}};  ///< and shadow rays
  std::vector<LightStrategy> lights = compared_lights();
  std::vector<TransmittanceStrategy> transmittance = every_transmittance();
  std::vector<GuidingStrategy> guiding = every_guiding();
  std::vector<JointStrategy> joint = every_joint();

  std::vector<std::size_t> sizes() const {
    return {media.size(),  distance.size(),      splitting.size(), candidates.size(),
            lights.size(), transmittance.size(), guiding.size(),   joint.size()};
  }
  Variant variant(const Combination& c) const {
    Variant v;
    v.media = media[c[0]];
    v.distance = distance[c[1]];
    v.splitting = splitting[c[2]];
    v.candidates = candidates[c[3]].first;
    v.shadow_rays = candidates[c[3]].second;
    v.lights = lights[c[4]];
    v.transmittance = transmittance[c[5]];
    v.guiding = guiding[c[6]];
    v.joint = joint[c[7]];
    return v;
  }
  /// A collision's light has no distance of its own.
  bool allowed(const Combination& c) const {
    const DistanceStrategy d = distance[c[1]];
    return media[c[0]] != MediaStrategy::vertex || d == DistanceStrategy::automatic || d == DistanceStrategy::tracking;
  }
  std::vector<Combination> covering() const {
    return covering_combinations(sizes(), [this](const Combination& c) { return allowed(c); });
  }
};

/// `per_commit`: the precision that a commit can afford; nightly it is that of all tests.
void check_media(const std::string& name, const std::string& scene, double per_commit) {
  const Factors factors;
  std::vector<std::pair<std::string, Variant>> variants;
  auto chosen = factors.covering();  // the first is rendered to the end: one that has little noise
  std::stable_partition(chosen.begin(), chosen.end(),
                        [&](const Combination& c) { return factors.media[c[0]] == MediaStrategy::product; });
  for (const Combination& c : chosen) {
    std::string title;
    for (const std::size_t i : c) title += std::to_string(i);
    variants.emplace_back(title, factors.variant(c));
  }
  Agreement how;
  if (!nightly()) how.d = per_commit;
  check_all_agree(name, scene, variants, how);
}

/// For cases that compare two to five variants, of which one finds the light by chance: 0.3 % is out of reach even at night.
Agreement to(double per_commit, double in_the_night = 0.01) {
  Agreement how;
  how.d = nightly() ? in_the_night : per_commit;
  return how;
}

}  // namespace

TEST_CASE("covering combinations hold every allowed pair") {
  const Factors factors;
  const auto allowed = [&](const Combination& c) { return factors.allowed(c); };
  const auto chosen = factors.covering();
  CHECK(chosen.size() <= 48);  // of 8 kinds of light choice and 5 of distance there are 40 pairs
  std::size_t missing = 0;
  for (const Combination& c : all_combinations(factors.sizes(), allowed)) {
    for (std::size_t j = 1; j < c.size(); ++j) {
      for (std::size_t i = 0; i < j; ++i) {
        const auto has = [&](const Combination& x) { return x[i] == c[i] && x[j] == c[j]; };
        missing += std::any_of(chosen.begin(), chosen.end(), has) ? 0 : 1;
      }
    }
  }
  CHECK(missing == 0);
}

TEST_CASE("thin medium") {
  check_media("thin",
              look(2) + lights() +
                  homogeneous("m", {.sigma_a = {0.02f, 0.05f, 0.1f}, .sigma_s = {0.3f, 0.2f, 0.1f}, .g = 0.2f}) +
                  medium_box("m", "", kBox),
              0.01);
}

TEST_CASE("dense medium") {
  check_media(
      "dense",
      look(3) + lights() + homogeneous("m", {.sigma_a = {0.5f, 0.2f, 1}, .sigma_s = {5, 6, 3}}) + medium_box("m", "", kBox),
      0.02);
}

TEST_CASE("forward scattering, g = 0.9") {
  check_media("forward",
              look(3) + lights() + homogeneous("m", {.sigma_a = {0.1f, 0.1f, 0.2f}, .sigma_s = {1.2f, 1, 0.8f}, .g = 0.9f}) +
                  medium_box("m", "", kBox),
              0.02);
}

TEST_CASE("a grid with holes and a homogeneous medium that overlap, camera in unbounded fog") {
  const View fog{.eye = {1.4f, 0.9f, -3.4f},
                 .look = {0, -0.1f, 0},
                 .fov_degrees = 38,
                 .resolution = 32,
                 .max_depth = 2,
                 .before_camera = homogeneous("fog", {.sigma_a = Rgb(0.02f), .sigma_s = Rgb(0.08f)}),
                 .medium = "fog"};
  check_media("overlapping",
              view(fog) + lights(SmallLight::ball) + diffuse_plane(1.8f, 3, 0.5f) +
                  uniform_grid("smoke", {.sigma_a = {0.3f, 0.2f, 0.2f}, .sigma_s = {2, 3, 2.5f}, .g = 0.5f}, holes()) +
                  homogeneous("haze", {.sigma_a = Rgb(0.1f), .sigma_s = {0.5f, 0.4f, 0.3f}, .g = -0.3f}) +
                  medium_box("smoke", "", kBox) + medium_box("haze", "", {{-0.5f, -1.2f, -0.6f}, {1.3f, 0.4f, 0.7f}}),
              0.04);
}

// With pairs along spans, what stands behind the camera's fog is attenuated instead of seen by the rays that pass.
TEST_CASE("a metal floor and area lights behind fog") {
  const std::string floor = block(
      "Material \"conductor\" \"float roughness\" 0.2\nTranslate 0 -1 0\nRotate -90 1 0 0\n"
      "Shape \"disk\" \"float radius\" 4\n");
  const std::string emitters = emitting_square({-0.8f, 0.6f, 1.2f}, 0.7f, 1) + emitting_square({0.8f, 1.5f, 0.3f}, 0.7f, 1.5f);
  const std::string fog = homogeneous("fog", {.sigma_a = {0.7f, 0.6f, 0.8f}, .sigma_s = {0.03f, 0.02f, 0.04f}}) +
                          medium_box("fog", "", {{-5, -1.5f, -2}, {5, 2.5f, 5}});
  const Agreement how = to(0.04);  // blocks see more than the mean does
  check_all_agree("behind fog", look(2) + floor + emitters + fog,
                  {{"passing", {.media = MediaStrategy::vertex}}, {"dimmed", {}}}, how);
}

// Coats, rough and smooth, and a diffuse surface beside smoke, of which they see more or less; emitters that scattered rays
// find as well. Without the guided density in the MIS weights of scattered rays the means are 1 to 2.4 % apart, each 13 to 16
// standard errors from the pooled one.
TEST_CASE("paths sent toward smoke make the picture of those that are not") {
  const std::string floor =
      block(
          "Material \"coateddiffuse\" \"float roughness\" 0.3 \"rgb reflectance\" [0.5 0.4 0.3]\nTranslate 0 -1.2 0\n"
          "Rotate -90 1 0 0\nShape \"disk\" \"float radius\" 4\n") +
      block("Material \"coateddiffuse\" \"float roughness\" 0\nTranslate 1.6 0 0.4\nShape \"sphere\" \"float radius\" 0.5\n");
  const std::string emitters =
      emitting_square({-1.5f, 1.5f, 0.3f}, 0.7f, 0.2f) + point_light({0.2f, 0.1f, 0}, 0.2f) + environment(0.02f);
  const std::string smoke = uniform_grid("smoke", {.sigma_a = {0.3f, 0.2f, 0.2f}, .sigma_s = {4, 5, 6}, .g = 0.5f}, holes()) +
                            medium_box("smoke", "", kBox);
  const Agreement how = to(0.005, 0.003);
  check_all_agree("guided", look(3) + floor + diffuse_plane(1.8f, 3, 0.5f) + emitters + smoke,
                  {{"off", {.guiding = GuidingStrategy::off}}, {"media", {.guiding = GuidingStrategy::media}}}, how);
}

/// An octahedron of the medium: the corners of its box are free of it.
std::string medium_octahedron(const std::string& inside, float r) {
  const std::string x = number(r), y = "-" + x;
  return block("Material \"interface\"\nMediumInterface \"" + inside + "\" \"\"\nShape \"trianglemesh\" \"point3 P\" [" + x +
               " 0 0 " + y + " 0 0 0 " + x + " 0 0 " + y + " 0 0 0 " + x + " 0 0 " + y +
               "]\n  \"integer indices\" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]\n");
}

// Point lights in the box of the smoke, but where it is not: what chooses lights at collisions has no finite variance where
// these come near. Without the MIS weight of the path's own ray "off" is 2.9 to 4.0 % below the mean of all, 28 to 32 standard
// errors.
TEST_CASE("collisions drawn near point lights make the picture of those that are not, whatever else chooses lights") {
  const std::string spot =
      "LightSource \"spot\" \"point3 from\" [0.9 0.9 -0.3] \"point3 to\" [-0.3 -1 0.2] \"float coneangle\" 50 "
      "\"float conedeltaangle\" 20 \"rgb I\" [0.1 0.2 0.3]\n";
  const std::string emitters = point_light({0.2f, 0.9f, 0.9f}, 0.1f) + point_light({-0.9f, -0.3f, -0.9f}, 0.1f) + spot +
                               emitting_square({-1.5f, 1.5f, 0.3f}, 0.3f, 0.3f);
  const std::string smoke = uniform_grid("smoke", {.sigma_a = {0.3f, 0.2f, 0.2f}, .sigma_s = {4, 5, 6}, .g = 0.5f}, holes()) +
                            homogeneous("haze", {.sigma_a = Rgb(0.1f), .sigma_s = {0.5f, 0.4f, 0.3f}, .g = -0.3f}) +
                            medium_octahedron("smoke", 1.5f) + medium_octahedron("haze", 1.6f);
  const Agreement how = to(0.02);
  check_all_agree("joint", look(3) + diffuse_plane(1.8f, 3, 0.5f) + emitters + smoke,
                  {{"off", {.joint = JointStrategy::off}},
                   {"points", {.joint = JointStrategy::points}},
                   {"tracked", {.distance = DistanceStrategy::both, .joint = JointStrategy::points}},
                   {"vertex", {.media = MediaStrategy::vertex, .joint = JointStrategy::points}},
                   {"power", {.lights = LightStrategy::power, .joint = JointStrategy::points}}},
                  how);
}

// Few pixels, so that the lights' images and what is around them are much of the picture. The lights stand again where the
// smoke is not, before it and behind, with a board among them and the camera in a fog that attenuates them. Without the MIS
// weight of the camera's own ray "off" is 2.5 to 2.9 % below the mean of all with the Gaussian and 4.2 to 4.5 % with
// Mitchell's, 9 to 14 standard errors.
TEST_CASE("rays drawn near point lights on the film make the picture of those that are not, with negative filters too") {
  const std::string spot =
      "LightSource \"spot\" \"point3 from\" [-0.9 0.9 0.3] \"point3 to\" [0.3 -1 -0.2] \"float coneangle\" 50 "
      "\"float conedeltaangle\" 20 \"rgb I\" [0.1 0.2 0.3]\n";
  const std::string emitters = point_light({0.8f, 0.6f, -1}, 0.2f) + point_light({-0.5f, -0.7f, 1.2f}, 0.3f) + spot;
  const std::string smoke =
      uniform_grid("smoke", {.sigma_a = {0.3f, 0.2f, 0.2f}, .sigma_s = {2, 1.5f, 1}, .g = 0.5f}, holes()) +
      homogeneous("haze", {.sigma_a = Rgb(0.1f), .sigma_s = {0.5f, 0.4f, 0.3f}, .g = -0.3f}) +
      medium_octahedron("smoke", 1.5f) + medium_octahedron("haze", 1.6f);
  const std::string board = block("Translate -0.6 -0.9 0\n" + diffuse_plane(0.9f, 0.3f, 0.5f));
  const Agreement how = to(0.03);
  View few{.eye = {1.4f, 0.9f, -3.4f}, .look = {0, -0.1f, 0}, .fov_degrees = 38, .resolution = 8, .max_depth = 1};
  few.before_camera = homogeneous("fog", {.sigma_a = Rgb(0.3f)});
  few.medium = "fog";
  for (const char* filter : {"gaussian", "mitchell"}) {
    few.filter = '"' + std::string(filter) + '"';
    check_all_agree(filter, view(few) + board + emitters + smoke,
                    {{"off", {.joint = JointStrategy::off}},
                     {"points", {.joint = JointStrategy::points}},
                     {"tracked", {.distance = DistanceStrategy::both, .joint = JointStrategy::points}},
                     {"vertex", {.media = MediaStrategy::vertex, .joint = JointStrategy::points}}},
                    how);
  }
}

// Lights around dense smoke, one of them close to it: rays that pass far from that one choose lights at collisions, others
// along the span.
TEST_CASE("segments that no light comes close to, lit at their collisions, make the picture of pairs everywhere") {
  const std::string emitters = point_light({1.6f, 1.2f, 0.3f}, 0.5f) + point_light({-1.5f, -0.2f, 1.3f}, 0.4f) +
                               point_light({-0.9f, 0.8f, -0.7f}, 0.1f) + emitting_square({-1.8f, 1.5f, 0.3f}, 0.5f, 0.6f);
  const std::string smoke = uniform_grid("smoke", {.sigma_a = {0.3f, 0.2f, 0.2f}, .sigma_s = {8, 9, 10}, .g = 0.4f}, holes()) +
                            medium_box("smoke", "", kBox);
  const Agreement how = to(0.03);
  check_all_agree("stand-off", look(4) + diffuse_plane(1.8f, 3, 0.5f) + emitters + smoke,
                  {{"pairs", {.distance = DistanceStrategy::profile}},
                   {"auto", {}},
                   {"vertex", {.media = MediaStrategy::vertex, .joint = JointStrategy::points}}},
                  how);
}

/// What the camera does not aim at is noisy, and the cheaper for it.
std::vector<Contender> aimed_or_not(const std::string& scene, int times = 16) {
  return {{.name = "off", .scene = scene, .variant = {.candidates = 1, .joint = JointStrategy::off}, .times = times},
          {.name = "points", .scene = scene, .variant = {.candidates = 1, .joint = JointStrategy::points}}};
}

// Small surfaces of every kind, before, in and behind smoke, one half hidden by a board, one half off the frame, the camera in
// a fog that attenuates them; then in one that scatters a little, behind which they are seen whole (Path's Beyond).
TEST_CASE("small emitters that the camera aims at make the picture of those that it does not") {
  const auto emitter = [](const std::string& where, const std::string& L, const std::string& shape) {
    return block("Translate " + where + "\nAreaLightSource \"diffuse\" \"rgb L\" [" + L + "]\n" + shape);
  };
  const std::string triangle =
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0  0.2 0 0.05  0 0.15 0] \"integer indices\" [0 2 1]\n";
  const std::string surfaces =
      emitter("-0.6 0.3 -0.9", "30 20 10", "Shape \"sphere\" \"float radius\" 0.07\n") +
      emitter("0.5 0.4 0.2", "60 80 20", "Shape \"sphere\" \"float radius\" 0.05\n") +
      emitter("0.1 -0.5 -0.8", "50 50 90", triangle) +
      emitter("-0.25 0.62 1.4", "90 40 30", "Shape \"disk\" \"float radius\" 0.1\n") +
      emitter("1.15 -0.2 0", "40 40 60", "Rotate 30 0 1 0\nShape \"sphere\" \"float radius\" 0.08 \"float zmax\" 0.03\n") +
      emitting_square({-0.2f, 0, 0.6f}, 0.06f, 70) +
      // In a shade that hides it, nearer to it than the end of a shadow ray to its place.
      emitter("3000 -2000 30000", "3e4 3e4 3e4", "Shape \"sphere\" \"float radius\" 300\n") +
      block("Translate 3000 -2000 30000\nMaterial \"diffuse\"\nShape \"sphere\" \"float radius\" 301\n");
  const std::string smoke =
      uniform_grid("smoke", {.sigma_a = {0.3f, 0.2f, 0.2f}, .sigma_s = {1, 0.8f, 0.6f}, .g = 0.5f}, holes()) +
      medium_octahedron("smoke", 1.1f);
  const std::string board = block("Translate -0.2 0.62 1.1\n" + diffuse_plane(0, 0.12f, 0.5f));
  const Agreement how = to(0.04);
  View few{.eye = {0.1f, 0.1f, -3.4f}, .look = {0, 0, 0}, .fov_degrees = 36, .resolution = 12, .max_depth = 0};
  few.medium = "fog";
  few.before_camera = homogeneous("fog", {.sigma_a = Rgb(0.1f)});
  few.filter = "\"gaussian\"";
  check_all_agree("shining, gaussian", aimed_or_not(view(few) + surfaces + board + smoke), how);

  few.max_depth = 1;
  few.before_camera = homogeneous("fog", {.sigma_a = Rgb(0.1f), .sigma_s = Rgb(0.02f)});
  few.filter = "\"mitchell\"";
  auto methods = aimed_or_not(view(few) + surfaces + board);
  methods.push_back({.name = "vertex",
                     .scene = methods[0].scene,
                     .variant = {.candidates = 1, .media = MediaStrategy::vertex, .joint = JointStrategy::points},
                     .times = 8});
  check_all_agree("shining, mitchell", methods, how);
}

// Of several pixels each: round, flat and cut off by the frame, one held by smoke, one of many primitives that instances share,
// with a small one before another. The rest is as for the small ones.
TEST_CASE("emitters whose images are drawn where they end make the picture of those that the filter finds") {
  const auto emitter = [](const std::string& where, const std::string& L, const std::string& shape) {
    return block("Translate " + where + "\nAreaLightSource \"diffuse\" \"rgb L\" [" + L + "]\n" + shape);
  };
  std::string fan = "ObjectBegin \"fan\"\nAreaLightSource \"diffuse\" \"rgb L\" [9 7 2]\n";
  for (int i = 0; i < 16; ++i) {
    fan +=
        block("Rotate " + number(22.5f * static_cast<float>(i)) +
              " 0 0 1\nShape \"trianglemesh\" \"point3 P\" [0 0 0  0.4 0 0  0.37 0.15 0.1] " + "\"integer indices\" [0 2 1]\n");
  }
  const std::string surfaces =
      emitter("-0.5 0.3 0.2", "3 2 1", "Shape \"sphere\" \"float radius\" 0.35\n") +
      emitter("-0.65 0.35 -0.9", "60 50 40", "Shape \"sphere\" \"float radius\" 0.03\n") +
      emitter("0.55 0.4 -0.6", "2 4 1", "Shape \"disk\" \"float radius\" 0.3\n") +
      emitter("-1.2 -0.6 0", "4 4 6", "Rotate 30 0 1 0\nShape \"sphere\" \"float radius\" 0.4 \"float zmax\" 0.2\n") + fan +
      "ObjectEnd\n" + block("Translate 0.4 -0.5 0.8\nObjectInstance \"fan\"\n");
  const std::string smoke =
      uniform_grid("smoke", {.sigma_a = {0.3f, 0.2f, 0.2f}, .sigma_s = {1, 0.8f, 0.6f}, .g = 0.5f}, holes()) +
      medium_octahedron("smoke", 0.9f);
  const Agreement how = to(0.02);
  View lens{.eye = {0.1f, 0.1f, -3.4f}, .look = {0, 0, 0}, .fov_degrees = 36, .resolution = 16, .max_depth = 0};
  lens.medium = "fog";
  lens.before_camera = homogeneous("fog", {.sigma_a = Rgb(0.1f)});
  lens.filter = "\"gaussian\"";
  check_all_agree("edges, gaussian", aimed_or_not(view(lens) + surfaces + smoke), how);

  lens.max_depth = 1;
  lens.before_camera = homogeneous("fog", {.sigma_a = Rgb(0.1f), .sigma_s = Rgb(0.02f)});
  lens.filter = "\"mitchell\"";
  check_all_agree("edges, mitchell", aimed_or_not(view(lens) + surfaces, 4), how);

  lens.filter = "\"gaussian\"";
  lens.fov_degrees = 0;
  lens.half_width = 1.1f;
  const std::string around_screen =
      homogeneous("haze", {.sigma_a = Rgb(0.5f)}) + medium_box("haze", "", {{-0.6f, -0.7f, -4}, {0.2f, 0.5f, -2.5f}});
  check_all_agree("edges, orthographic", aimed_or_not(view(lens) + surfaces + around_screen), how);

  // The film takes less of a sample than most of them send.
  lens.fov_degrees = 36;
  std::string limited = view(lens) + surfaces + smoke;
  limited.insert(limited.find("Film \"rgb\"") + 10, " \"float maxcomponentvalue\" 1.5");
  check_all_agree("edges, limited", aimed_or_not(limited), how);
}

// Nothing but such fog is in the picture, and phase functions that find the sphere by themselves.
// A fiftieth of a pixel wide and a pixel long: of 64 samples few meet one.
TEST_CASE("slivers that few samples meet have a hundredth of the filter's noise at most, and the same mean") {
  std::string slivers;
  for (int i = 0; i < 12; ++i) {
    const std::string x = number(-0.75f + 0.13f * static_cast<float>(i)), y = number(-0.7f + 0.12f * static_cast<float>(i));
    slivers += block("Translate " + x + " " + y + " 0\nRotate " + number(31.0f * static_cast<float>(i)) +
                     " 0 0 1\nAreaLightSource \"diffuse\" \"rgb L\" [9 7 5]\nShape \"trianglemesh\" " +
                     "\"point3 P\" [0 0 0  0 0.1 0  0.002 0 0] \"integer indices\" [0 1 2]\n");
  }
  View lens{.eye = {0, 0, -3}, .look = {0, 0, 0}, .fov_degrees = 36, .resolution = 20, .max_depth = 0};
  const auto noise_and_mean = [&](JointStrategy joint) { return noise_of(view(lens) + slivers, joint, 64); };
  const auto [noise, mean] = noise_and_mean(JointStrategy::off);
  const auto [less_noise, same_mean] = noise_and_mean(JointStrategy::points);
  CHECK(less_noise < 0.01 * noise);
  // Standard errors of the sums are the square roots of the variances'.
  CHECK(std::abs(mean - same_mean) < 4 * std::sqrt(noise + less_noise));
}

TEST_CASE("fog that scatters next to nothing, and looks for light seldom, is as bright as by its collisions") {
  const std::string emitters =
      block("Translate -4 2 1\nAreaLightSource \"diffuse\" \"rgb L\" [9 8 6]\nShape \"sphere\" \"float radius\" 0.8\n") +
      point_light({0.2f, 2.5f, 0.4f}, 1);
  const std::string fog = homogeneous("fog", {.sigma_a = Rgb(0.01f), .sigma_s = Rgb(0.01f), .g = 0.7f}) +
                          medium_box("fog", "", {{-1.5f, -1.5f, -1.5f}, {1.5f, 1.5f, 1.5f}});
  const Agreement how = to(0.02);
  check_all_agree(
      "faint", look(2) + emitters + fog,
      {{"seldom", {}}, {"both", {.distance = DistanceStrategy::both}}, {"vertex", {.media = MediaStrategy::vertex}}}, how);
}

// 65,536 samples of each: standard errors of 0.002 at most; Approx allows 0.017. Roulette without its weight is off by 0.11.
TEST_CASE("a sky behind fog leaves A = 1 - transmittance, passed or attenuated") {
  const std::string scene = look(3) + lights() + homogeneous("fog", {.sigma_a = Rgb(0.3f), .sigma_s = Rgb(0.2f)}) +
                            medium_box("fog", "", {{-5, -5, -1}, {5, 5, 1}});
  const auto mean_A = [&](const Variant& variant) {
    const Image image = Subject(scene, variant).render(64, 5);
    const std::vector<float>& A = image.find("A")->values;
    return std::accumulate(A.begin(), A.end(), 0.0) / double(A.size());
  };
  CHECK(mean_A({}) == doctest::Approx(mean_A({.media = MediaStrategy::vertex})).epsilon(0.01));
}
