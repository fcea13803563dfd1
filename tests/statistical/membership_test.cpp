/// Which media is the camera in, and a ray? Absorption along one ray tells, in closed form.
#include <doctest/doctest.h>

#include <cmath>

#include "support/agreement.h"
#include "support/sanitized.h"
#include "support/scene_text.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}}, kOuter{{-2, -2, -2}, {2, 2, 2}};

std::string absorber(const std::string& name, float sigma) { return homogeneous(name, {.sigma_a = Rgb(sigma)}); }

/// A ray along +z from `z`, a little off the axis so that no edge is met.
std::string along_z(float z, const std::string& media = "", const std::string& medium = "") {
  return view({.eye = {0.13f, 0.07f, z}, .look = {0.13f, 0.07f, z + 1}, .before_camera = media, .medium = medium}) +
         environment(1);
}

void check_depth(const std::string& name, const std::string& scene, double tau) {
  check_agrees(name, scene, grey(std::exp(-tau)));
}

}  // namespace

TEST_CASE("camera inside a box: declared, or found by tracing") {
  const std::string medium = absorber("m", 1), box = medium_box("m", "", kBox);
  check_depth("inside, declared", along_z(0.25f, medium, "m") + box, 0.75);
  check_depth("inside, not declared", along_z(0.25f, medium) + box, 0.75);
  check_depth("outside, looking through", along_z(-3, medium) + box, 2);
  check_depth("outside, looking away", along_z(3, medium) + box, 0);
}

TEST_CASE("a box of six quads is one boundary") {
  const std::string medium = absorber("m", 1), box = medium_box_of_quads("m", "", kBox);
  check_depth("quads, inside", along_z(0.25f, medium) + box, 0.75);
  check_depth("quads, inside, declared", along_z(0.25f, medium, "m") + box, 0.75);
  check_depth("quads, outside", along_z(-3, medium) + box, 2);
}

TEST_CASE("nested pair: the inner medium takes the outer one's place") {
  const std::string media = absorber("outer", 0.3f) + absorber("inner", 1);
  for (const bool quads : {false, true}) {
    const auto box = quads ? medium_box_of_quads : medium_box;
    const std::string boxes = box("outer", "", kOuter) + box("inner", "outer", kBox);
    const std::string name = quads ? "nested quads, " : "nested, ";
    check_depth(name + "camera in the inner", along_z(0.25f, media) + boxes, 0.75 + 0.3);
    check_depth(name + "camera in the inner, declared", along_z(0.25f, media, "inner") + boxes, 0.75 + 0.3);
    check_depth(name + "camera between", along_z(-1.5f, media) + boxes, 0.5 * 0.3 + 2 + 0.3);
    check_depth(name + "camera between, declared", along_z(-1.5f, media, "outer") + boxes, 0.5 * 0.3 + 2 + 0.3);
    check_depth(name + "camera outside", along_z(-3, media) + boxes, 0.6 + 2);
  }
}

TEST_CASE("overlapping boxes add") {
  const std::string media = absorber("a", 0.4f) + absorber("b", 0.9f);
  const std::string boxes = medium_box("a", "", kBox) + medium_box("b", "", {{-1, -1, 0}, {1, 1, 3}});
  check_depth("overlap, from outside", along_z(-3, media) + boxes, 2 * 0.4 + 3 * 0.9);
  check_depth("overlap, from within both", along_z(0.5f, media) + boxes, 0.5 * 0.4 + 2.5 * 0.9);
}

TEST_CASE("an empty box carved out of a medium") {
  const std::string media = absorber("m", 0.5f);
  const std::string boxes = medium_box("m", "", kOuter) + medium_box("", "m", kBox);
  check_depth("hole, from outside", along_z(-3, media) + boxes, 2 * 0.5);
  check_depth("hole, from inside it", along_z(0, media) + boxes, 0.5);
}

TEST_CASE("unbounded fog of the camera, and a box of smoke in it") {
  const std::string media = absorber("fog", 0.2f) + absorber("smoke", 0.7f);
  const std::string scene =
      view({.eye = {0.13f, 0.07f, -3}, .look = {0.13f, 0.07f, 0}, .before_camera = media, .medium = "fog"}) +
      emitting_square({0, 0, 4}, 2, 1);
  check_depth("fog alone", scene, 7 * 0.2);
  check_depth("fog, smoke instead of it", scene + medium_box("smoke", "fog", kBox), 5 * 0.2 + 2 * 0.7);
  check_depth("fog, smoke on top of it", scene + medium_box("smoke", "", kBox), 7 * 0.2 + 2 * 0.7);
  // In pbrt files shapes often inherit the camera's interface: opaque ones, some not even closed.
  const std::string opaque = "MediumInterface \"\" \"fog\"\n" + diffuse_plane(4.5f, 8, 0.5f) + diffuse_plane(-5, 8, 0.5f) +
                             block("Translate 0 1.5 0\nShape \"sphere\" \"float radius\" 0.8\n");
  check_depth("fog, opaque shapes that inherit its interface", scene + opaque, 7 * 0.2);
}

TEST_CASE("mirrored, turned, instanced and round boundaries") {
  const std::string medium = absorber("m", 1);
  const std::string shape = "Material \"interface\"\nMediumInterface \"m\" \"\"\nShape \"sphere\" \"float radius\" 0.5\n";
  const double chord = 2 * std::sqrt(0.25 - 0.13 * 0.13 - 0.07 * 0.07);
  check_depth("mirrored box", along_z(-3, medium) + block("Scale -1 1 1\n" + medium_box("m", "", kBox)), 2);
  check_depth("mirrored box, camera inside", along_z(0, medium) + block("Scale -1 1 1\n" + medium_box("m", "", kBox)), 1);
  check_depth("turned box", along_z(-3, medium) + block("Rotate 90 1 0 0\n" + medium_box("m", "", kBox)), 2);
  check_depth("sphere", along_z(-3, medium) + block(shape), chord);
  check_depth("sphere, camera inside", along_z(0, medium) + block(shape), chord / 2);
  check_depth("two instances, one mirrored",
              along_z(-3, medium) + "ObjectBegin \"o\"\n" + shape + "ObjectEnd\nObjectInstance \"o\"\n" +
                  block("Translate 0 0 2\nScale 1 1 -1\nObjectInstance \"o\"\n"),
              2 * chord);
}

TEST_CASE("scattering light crosses boundaries alike in a box and in six quads, once or twice around") {
  const Coefficients smoke{.sigma_a = Rgb(0.1f), .sigma_s = {1, 0.5f, 2}, .g = 0.4f};
  const Coefficients half{.sigma_a = Rgb(0.05f), .sigma_s = {0.5f, 0.25f, 1}, .g = 0.4f};
  const std::string front = view({.eye = {2.2f, 1.8f, -2.6f}, .look = {0, 0, 0}, .fov_degrees = 40, .resolution = 24}) +
                            point_light({0.5f, 2, -1}, 5) + environment(0.2f) + diffuse_plane(1.5f, 3, 0.5f);
  check_same("boundaries", {{"box", front + homogeneous("m", smoke) + medium_box("m", "", kBox)},
                            {"quads", front + homogeneous("m", smoke) + medium_box_of_quads("m", "", kBox)},
                            {"two halves", front + homogeneous("a", half) + homogeneous("b", half) + medium_box("a", "", kBox) +
                                               medium_box_of_quads("b", "", kBox)}});
}

// A collision next to a boundary, rounded to its far side, once made paths forget to leave: 1 in 10^7.
TEST_CASE("no path loses count of the media it is in") {
  const std::string box =
      "Translate 40 -30 55\nRotate 33 1 2 3\n" + medium_box("outer", "", kOuter) + medium_box_of_quads("inner", "outer", kBox) +
      block("Material \"interface\"\nMediumInterface \"ball\" \"inner\"\nShape \"sphere\" \"float radius\" 0.7\n");
  const std::string scene =
      view({.eye = {43, -28, 50}, .look = {40, -30, 55}, .fov_degrees = 60, .resolution = 48, .max_depth = 100'000}) +
      environment(1) + homogeneous("outer", {.sigma_s = Rgb(1.0f)}) + homogeneous("inner", {.sigma_s = Rgb(4.0f)}) +
      homogeneous("ball", {.sigma_s = Rgb(15.0f)}) + block(box);
  Subject subject(scene);
  const int renders = nightly() ? 200 : kSanitized ? 1 : 8;
  Moments mean;
  for (int i = 0; i < renders; ++i) {
    const Image image = subject.render(32, 77 + i);
    for (const float v : image.find("R")->values) mean.add(v);
  }
  CHECK_MESSAGE(subject.faults().empty(), subject.faults());
  CHECK(std::abs(mean.estimate().mean - 1) <= 4 * mean.estimate().standard_error() + 1e-6);  // a furnace, too
}
