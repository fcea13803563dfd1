/// Shapes and lights at the ends of what geometry allows: needles, no area at all, many in one place, rays that all but graze,
/// coordinates a million away. Each gives the picture of its harmless version.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/agreement.h"
#include "support/scene_text.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};

/// The square |x|, |y| <= half at z, its normal along -z or +z, cut along x into needles: half of them one part in 10^6 as
/// wide as the others.
std::string needles(float z, float half, int pairs, bool up = false) {
  std::string points, indices;
  for (int i = 0; i <= pairs; ++i) {
    const float x = -half + 2 * half * float(i) / float(pairs);
    const float next = std::max(std::nextafter(x, half), x + 1e-6f * half);
    for (const float column : {x, i == pairs ? x : next})
      for (const float y : {-half, half}) points += number(column) + " " + number(y) + " " + number(z) + " ";
  }
  for (int i = 0; i < 2 * pairs; ++i) {
    const int a = 2 * i, b = a + 1, c = a + 2, d = a + 3;
    for (const int corner : up ? std::array{a, c, d, a, d, b} : std::array{a, d, c, a, b, d})
      indices += std::to_string(corner) + " ";
  }
  return "Shape \"trianglemesh\" \"point3 P\" [" + points + "] \"integer indices\" [" + indices + "]\n";
}
std::string quad(float z, float half) {
  const std::string h = number(half), m = number(-half), Z = number(z);
  return "Shape \"trianglemesh\" \"point3 P\" [" + m + " " + m + " " + Z + "  " + m + " " + h + " " + Z + "  " + h + " " + h +
         " " + Z + "  " + h + " " + m + " " + Z + "] \"integer indices\" [0 1 2 0 2 3]\n";
}

const std::string kEmission =
    "AreaLightSource \"diffuse\" \"rgb L\" [3 3 3]\nMaterial \"diffuse\" \"rgb reflectance\" [0 0 0]\n";
const std::string kGrey = "Material \"diffuse\" \"rgb reflectance\" [0.6 0.6 0.6]\n";

std::string front(int max_depth = 3) {
  return view({.eye = {0.4f, 0.3f, -3}, .look = {0, 0, 1}, .fov_degrees = 40, .resolution = 16, .max_depth = max_depth});
}
std::string smoke() {
  return homogeneous("m", {.sigma_a = Rgb(0.1f), .sigma_s = Rgb(0.4f), .g = 0.3f}) + medium_box("m", "", kBox);
}

Agreement coarse() { return {.d = nightly() ? 0.003 : 0.03}; }

}  // namespace

TEST_CASE("a light cut into needles emits like one in one piece") {
  const std::string room = front() + smoke() + block(kGrey + quad(2, 4));
  check_same("light of needles",
             {{"square", room + block(kEmission + quad(0.4f, 0.5f))},
              {"needles", room + block(kEmission + needles(0.4f, 0.5f, 64))},
              {"needles, by power", room + block(kEmission + needles(0.4f, 0.5f, 64)), {.lights = LightStrategy::power}}},
             coarse());
}

TEST_CASE("a wall cut into needles looks like one in one piece") {
  const std::string room = front() + point_light({0.5f, 1, -1}, 4) + environment(0.3f) + smoke();
  check_same("wall of needles",
             {{"square", room + block(kGrey + quad(1.5f, 2))}, {"needles", room + block(kGrey + needles(1.5f, 2, 64))}},
             coarse());
}

TEST_CASE("boundaries cut into needles hold the medium between them") {
  const std::string between =
      block("Material \"interface\"\nMediumInterface \"m\" \"\"\n" + needles(-1, 3, 500) + needles(1, 3, 500, true) + R"(
Shape "trianglemesh" "point3 P" [-3 -3 -1  3 -3 -1  3 -3 1  -3 -3 1  -3 3 -1  3 3 -1  3 3 1  -3 3 1] "integer indices"
  [0 1 2 0 2 3  5 4 7 5 7 6  4 0 3 4 3 7  1 5 6 1 6 2]
)");
  const View wide{.eye = {0.13f, 0.07f, -4}, .look = {0.13f, 0.07f, 0}, .half_width = 2.5f, .resolution = 64};
  check_agrees("needles around smoke", view(wide) + environment(1) + homogeneous("m", {.sigma_a = Rgb(0.5f)}) + between,
               grey(std::exp(-1.0)));
}

TEST_CASE("triangles without area, and lights without power, change nothing") {
  const std::string nothing =
      R"(Shape "trianglemesh" "point3 P" [0 0 0  1 1 1  2 2 2  0.3 0.2 -0.5  0.3 0.2 -0.5  0.3 0.2 -0.5  -1 0 0  1 0 0  1 0 0]
  "integer indices" [0 1 2  3 4 5  6 7 8  0 0 1])"
      "\n";
  const std::string lit =
      front() + smoke() + block(kGrey + quad(2, 4)) + block(kEmission + quad(0.4f, 0.5f)) + point_light({1, 1, -1}, 1);
  std::string more = lit + block(kEmission + nothing) + block(kGrey + nothing) +
                     block("AreaLightSource \"diffuse\" \"rgb L\" [0 0 0]\n" + kGrey + quad(2, 1));
  for (int i = 0; i < 20; ++i) more += point_light({0.1f * float(i), 0, 0}, 0);
  check_same("nothing added", {{"without", lit}, {"with", more}, {"with, uniform", more, {.lights = LightStrategy::uniform}}},
             coarse());
}

TEST_CASE("lights in one place are one light") {
  const std::string room = front() + smoke() + block(kGrey + quad(2, 4));
  const auto spot = [](double I) {
    return "LightSource \"spot\" \"point3 from\" [0 0 -1.5] \"point3 to\" [0 0 2] \"float coneangle\" 40 \"rgb I\" [" +
           number(I) + " " + number(I) + " " + number(I) + "]\n";
  };
  std::string many;
  for (int i = 0; i < 64; ++i)
    many += point_light({0.5f, 1.5f, -1}, 3.0f / 64) + distant_light({1, -1, 2}, 0.5f / 64) + spot(4.0 / 64);
  const std::string one = point_light({0.5f, 1.5f, -1}, 3) + distant_light({1, -1, 2}, 0.5f) + spot(4);
  check_same("64 lights of each kind",
             {{"one", room + one}, {"64", room + many}, {"64, uniform", room + many, {.lights = LightStrategy::uniform}}},
             coarse());
}

// Into the box by its top, and out by its side: each number here is a float.
TEST_CASE("rays that all but graze a face") {
  for (const int k : {4, 10, 16, 21}) {
    const double slope = std::ldexp(1.0, -k);
    const View grazing{.eye = {-3, 0.125f, float(1 + 3 * slope)},
                       .look = {1, 0.125f, float(1 - slope)},
                       .half_width = 1e-30f,
                       .resolution = 8};
    for (const bool quads : {false, true}) {
      check_agrees("slope 2^-" + std::to_string(k) + (quads ? ", quads" : ""),
                   view(grazing) + environment(1) + homogeneous("m", {.sigma_a = Rgb(1.0f)}) +
                       (quads ? medium_box_of_quads : medium_box)("m", "", kBox),
                   grey(std::exp(-std::sqrt(1 + slope * slope))));
    }
  }
}

TEST_CASE("a world written with coordinates a million away looks as it does here") {
  const auto scene = [](float x, float y) {
    const Vec3 o{x, y, -x};
    const Bounds3 box{o + Vec3{-4, -4, -4}, o + Vec3{4, 4, 4}};
    Grid lumps{box, 3, 3, 3, {}};
    for (int i = 0; i < 27; ++i) lumps.density.push_back(0.25f * float(i * 7 % 5));
    return view({.eye = o + Vec3{6, 5, -12}, .look = o, .fov_degrees = 45, .resolution = 16, .max_depth = 4}) +
           environment(0.2f) + point_light(o + Vec3{3, 9, -5}, 60) +
           block("Translate " + number(o.x) + " " + number(o.y) + " " + number(o.z) + "\n" + kGrey + quad(6, 12)) +
           block(kEmission + box_mesh({o + Vec3{-6, 6, -2}, o + Vec3{-5, 7, 2}})) +
           uniform_grid("m", {.sigma_a = Rgb(0.02f), .sigma_s = Rgb(0.15f), .g = 0.5f}, lumps) + medium_box("m", "", box);
  };
  check_same("a million away", {{"here", scene(0, 0)}, {"there", scene(1'048'576, -1'048'576)}}, coarse());
}

// Turned, so that points of their surfaces are rounded to both sides of them. Emitters elsewhere in these tests reflect
// nothing.
TEST_CASE("no flat or convex emitter lights itself, and none its dark side") {
  const auto brightest = [](const std::string& shape, Vec3 eye, bool two_sided) {
    const std::string emitter =
        block("AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" " + std::string(two_sided ? "true" : "false") +
              "\nMaterial \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\nRotate 31.7 0.3 1 0.2\nTranslate 0.123 0.311 0.777\n" +
              shape + "\n");
    const View from{.eye = eye, .look = {}, .fov_degrees = 12, .resolution = 16, .max_depth = 3};
    const Image image = Subject(view(from) + emitter).render(16, 1);
    float most = 0;
    for (const char* name : {"R", "G", "B"}) {
      for (const float v : image.find(name)->values) most = std::max(most, v);
    }
    return most;
  };
  const std::string rectangle = "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 0  1 -1 0  -1 1 0  1 1 0]",
                    kite = "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 0  1.3 -1 0  -1 1.1 0  1 1 0]",
                    triangle = "Shape \"trianglemesh\" \"point3 P\" [-2 -1 0  2 -1 0  0 2 0] \"integer indices\" [0 1 2]",
                    disk = "Shape \"disk\" \"float radius\" 1.2", sphere = "Shape \"sphere\"",
                    cylinder = "Rotate 90 1 0 0 Shape \"cylinder\" \"float radius\" 0.7";
  for (const std::string& shape : {rectangle, kite, triangle, disk, sphere, cylinder}) {
    CAPTURE(shape);
    for (const float z : {-6.0f, 6.0f}) CHECK(brightest(shape, {0, 0, z}, true) == doctest::Approx(1).epsilon(1e-5));
  }
  for (const std::string& shape : {rectangle, kite, triangle, disk})
    CHECK(brightest(shape, {0, 0, -6}, false) < 1e-6f);                             // but for rounding
  CHECK(brightest("Shape \"sphere\" \"float radius\" 8", {0, 0, -6}, false) == 0);  // from within
}
