#include "unit/io/reader_checks.h"

using namespace tyndall;
using test::world_error;

namespace {

/// Where a sphere's centre ends up.
Vec3 origin(const std::string& directives) {
  return test::read_world(directives + " Shape \"sphere\"").shapes.at(0).to_world.point({0, 0, 0});
}

Vec3 moved(const std::string& directives, Vec3 p) {
  return test::read_world(directives + " Shape \"sphere\"").shapes.at(0).to_world.point(p);
}

void check_near(Vec3 a, Vec3 b) {
  for (int i = 0; i < 3; ++i) CHECK(a[i] == doctest::Approx(b[i]).epsilon(1e-6).scale(1));
}

}  // namespace

TEST_CASE("transforms multiply from the right") {
  check_near(origin("Translate 1 2 3"), {1, 2, 3});
  check_near(origin("Scale 2 2 2 Translate 1 2 3"), {2, 4, 6});
  check_near(origin("Rotate 90 0 0 1 Translate 1 0 0"), {0, 1, 0});
  check_near(origin("Translate 1 2 3 Identity"), {0, 0, 0});
  check_near(moved("LookAt 0 0 5  0 0 0  0 1 0", {0, 0, 5}), {0, 0, 0});
}

TEST_CASE("Transform and ConcatTransform take columns") {
  const std::string matrix = "[1 0 0 0  0 2 0 0  0 0 3 0  4 5 6 1]";
  check_near(moved("Translate 9 9 9 Transform " + matrix, {1, 1, 1}), {5, 7, 9});
  check_near(moved("Translate 1 0 0 ConcatTransform " + matrix, {1, 1, 1}), {6, 7, 9});
}

TEST_CASE("coordinate systems are named and recalled; camera and world are given") {
  check_near(origin("Translate 1 0 0 CoordinateSystem \"a\" Translate 5 5 5 CoordSysTransform \"a\""), {1, 0, 0});
  check_near(origin("Translate 1 0 0 CoordSysTransform \"world\""), {0, 0, 0});
  const Scene scene =
      test::read("Translate 0 0 -7 Camera \"perspective\" WorldBegin CoordSysTransform \"camera\" Shape \"sphere\"");
  check_near(scene.shapes.at(0).to_world.point({0, 0, 0}), {0, 0, 7});
  CHECK_CONTAINS(world_error("CoordSysTransform \"wurld\""), "did you mean \"world\"?");
}

TEST_CASE("WorldBegin resets the matrix") {
  const Scene scene = test::read("Translate 1 2 3 WorldBegin Shape \"sphere\"");
  CHECK(scene.shapes.at(0).to_world.is_identity());
}

TEST_CASE("moving transforms stand still, with one warning") {
  const SceneFile file = test::read_world_file(
      "ActiveTransform StartTime Translate 1 0 0 ActiveTransform EndTime Translate 0 9 0 Identity ActiveTransform All "
      "Translate 0 0 1 "
      "ActiveTransform EndTime Shape \"sphere\"");
  check_near(file.scene.shapes.at(0).to_world.point({0, 0, 0}), {1, 0, 1});
  REQUIRE(file.warnings.size() == 1);
  CHECK_CONTAINS(file.warnings[0].message, "moving transforms are not supported");
  CHECK(read_scene_text("TransformTimes 0 1 WorldBegin", "test.pbrt").warnings.size() == 1);
  CHECK_CONTAINS(world_error("ActiveTransform Always"), "expected StartTime, EndTime or All");
}

TEST_CASE("bad transforms are found where they stand") {
  CHECK_CONTAINS(world_error("Rotate 10 0 0 0"), "no axis");
  CHECK_CONTAINS(world_error("LookAt 0 0 0 0 0 0 0 1 0"), "no unique view");
  CHECK_CONTAINS(world_error("Transform [1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1]"), "not affine");
  CHECK_CONTAINS(world_error("Transform 1 0 0"), "expected [ and 16 numbers");
  CHECK_CONTAINS(world_error("Transform [1 0 0]"), "expected a number");
  CHECK_CONTAINS(world_error("Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 7]"), "expected ] after 16 numbers");
  CHECK_CONTAINS(world_error("Translate 1 2 Shape \"sphere\""), "\"Shape\" is not a number");
  CHECK_CONTAINS(world_error("Scale 1e200 1 1 Scale 1e200 1 1"), "more than a number can hold");
  CHECK_CONTAINS(world_error("Scale 1e30 1 1 Scale 1e30 1 1"), "more than a number can hold");
}

TEST_CASE("a singular matrix is an error only where something is made under it") {
  const std::string flat = "ConcatTransform [1 0 0 0  0 0 0 0  0 0 1 0  0 0 0 1] ";
  for (const std::string singular :
       {"Scale 1 0 1 ", "Scale 0 0 0 ", flat.c_str(), "Transform [1 0 0 0 0 1 0 0 1 0 0 0 0 0 0 1] "}) {
    INFO(singular);
    const auto made = [&](const std::string& what) { return world_error(singular + what); };
    CHECK(made("Translate 1 2 3 Material \"diffuse\"") == "no error");
    CHECK(made("Texture \"c\" \"float\" \"checkerboard\"") == "no error");
    CHECK(made("MakeNamedMedium \"m\" \"string type\" \"homogeneous\"") == "no error");
    CHECK(world_error("AttributeBegin " + singular + "AttributeEnd Shape \"sphere\"") == "no error");
    check_near(origin(singular + "Translate 1 0 0 Identity Translate 2 0 0"), {2, 0, 0});
    check_near(origin(singular + "CoordSysTransform \"world\""), {0, 0, 0});
    for (const std::string what :
         {"Shape \"sphere\"", "Translate 1 0 0 Shape \"sphere\"", "LightSource \"point\"",
          "MakeNamedMedium \"m\" \"string type\" \"cloud\"", "Texture \"f\" \"float\" \"checkerboard\" \"integer dimension\" 3",
          "Texture \"f\" \"float\" \"fbm\"", "CoordinateSystem \"flat\" Identity CoordSysTransform \"flat\" Shape \"sphere\"",
          "ObjectBegin \"o\" ObjectEnd ObjectInstance \"o\""}) {
      INFO(what);
      CHECK_CONTAINS(made(what), "the transformation is singular since line 1");
    }
  }
  CHECK(test::error_of("WorldBegin\nScale 1 0 1\n Shape \"sphere\"")
            .starts_with("test.pbrt:3:2: the transformation is singular since line 2"));
  CHECK_CONTAINS(test::error_of("Scale 1 0 1 Camera \"perspective\""), "singular");
}
