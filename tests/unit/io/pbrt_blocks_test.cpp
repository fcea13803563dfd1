#include "unit/io/reader_checks.h"

using namespace tyndall;
using test::world_error;

TEST_CASE("AttributeEnd restores the whole graphics state") {
  const Scene scene = test::read_world(R"(
    MakeNamedMedium "m" "string type" "homogeneous"
    AttributeBegin
      Translate 1 0 0
      Material "dielectric"
      AreaLightSource "diffuse"
      ReverseOrientation
      MediumInterface "m" ""
      ColorSpace "aces2065-1"
      Shape "sphere"
    AttributeEnd
    Shape "sphere"
    Material "diffuse" "rgb reflectance" [.25 .5 .75])");
  const Shape &in = scene.shapes.at(0), &out = scene.shapes.at(1);
  CHECK(in.reverse_orientation);
  CHECK(in.emission);
  CHECK(in.boundary);
  CHECK(in.material == 1);
  CHECK_FALSE(in.to_world.is_identity());
  CHECK_FALSE(out.reverse_orientation);
  CHECK_FALSE(out.emission);
  CHECK_FALSE(out.boundary);
  CHECK(out.material == 0);
  CHECK(out.to_world.is_identity());
  CHECK(test::constant(scene, std::get<DiffuseMaterial>(test::last_material(scene).kind).reflectance) == Rgb(.25f, .5f, .75f));
}

TEST_CASE("ReverseOrientation toggles") {
  const Scene scene =
      test::read_world("ReverseOrientation ReverseOrientation Shape \"sphere\" ReverseOrientation Shape \"sphere\"");
  CHECK_FALSE(scene.shapes.at(0).reverse_orientation);
  CHECK(scene.shapes.at(1).reverse_orientation);
}

TEST_CASE("TransformBegin acts as AttributeBegin, with one warning") {
  const SceneFile file =
      test::read_world_file("TransformBegin Translate 1 0 0 TransformEnd TransformBegin TransformEnd Shape \"sphere\"");
  CHECK(file.scene.shapes.at(0).to_world.is_identity());
  CHECK(file.warnings.size() == 1);
}

TEST_CASE("blocks must match and close") {
  CHECK(test::error_of("WorldBegin\nAttributeBegin\n AttributeBegin\nAttributeEnd") ==
        "test.pbrt:2:1: AttributeBegin is not closed; add AttributeEnd");
  CHECK_CONTAINS(world_error("AttributeEnd"), "AttributeEnd closes nothing");
  CHECK_CONTAINS(world_error("ObjectBegin \"a\" AttributeEnd"), "stands inside the ObjectBegin of line 1");
  CHECK_CONTAINS(world_error("ObjectBegin \"a\" AttributeBegin ObjectEnd"), "close that first with AttributeEnd");
  CHECK_CONTAINS(world_error("ObjectBegin \"a\""), "ObjectBegin is not closed");
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "AttributeBegin ";
  CHECK_CONTAINS(world_error(deep), "nested deeper than 64");
}

TEST_CASE("objects hold shapes, instances place them") {
  const Scene scene = test::read_world(R"(
    Translate 1 0 0
    ObjectBegin "o"
      Translate 0 1 0
      Shape "sphere"
      AttributeBegin Shape "disk" AttributeEnd
    ObjectEnd
    Translate 0 0 1
    ObjectInstance "o"
    Shape "cylinder")");
  REQUIRE(scene.objects.size() == 1);
  REQUIRE(scene.instances.size() == 1);
  CHECK(scene.objects[0].shapes.size() == 2);
  CHECK(scene.objects[0].shapes[0].to_world.point({0, 0, 0}) == Vec3{1, 1, 0});
  CHECK(scene.instances[0].to_world.point({0, 0, 0}) == Vec3{1, 0, 1});
  CHECK(scene.shapes.at(0).to_world.point({0, 0, 0}) == Vec3{1, 0, 1});
}

TEST_CASE("objects are defined once, before use, and not nested") {
  CHECK_CONTAINS(world_error("ObjectInstance \"a\""), "object \"a\" is not defined; define it with ObjectBegin before line 1");
  CHECK_CONTAINS(world_error("ObjectBegin \"a\" ObjectEnd ObjectBegin \"a\" ObjectEnd"), "defined twice");
  CHECK_CONTAINS(world_error("ObjectBegin \"a\" ObjectBegin \"b\" ObjectEnd ObjectEnd"), "cannot be nested");
  CHECK_CONTAINS(world_error("ObjectBegin \"a\" ObjectInstance \"a\" ObjectEnd"), "stands inside an object");
}

TEST_CASE("a boundary group is a pair of media in one block") {
  const Scene scene = test::read_world(R"(
    MakeNamedMedium "a" "string type" "homogeneous"
    MakeNamedMedium "b" "string type" "homogeneous"
    MediumInterface "a" ""
    Shape "sphere"
    Shape "disk"
    MediumInterface "" "b"
    Shape "sphere"
    AttributeBegin
      Shape "sphere"
      MediumInterface "b"
      Shape "sphere"
      MediumInterface "" ""
      Shape "sphere"
    AttributeEnd
    MediumInterface "a" ""
    Shape "sphere"
    ObjectBegin "o" Shape "sphere" ObjectEnd)");
  const auto boundary = [&](int i) { return scene.shapes.at(i).boundary; };
  CHECK(boundary(0) == boundary(1));
  CHECK(boundary(2) != boundary(0));
  CHECK(boundary(3) != boundary(2));  // another block
  CHECK_FALSE(boundary(4));           // "b" on both sides
  CHECK_FALSE(boundary(5));
  CHECK(boundary(6) == boundary(0));
  CHECK(scene.objects.at(0).shapes.at(0).boundary != boundary(0));
  CHECK(scene.boundaries.size() == 4);
  CHECK(scene.boundaries.at(*boundary(0)).inside == MediumId{0});
  CHECK_FALSE(scene.boundaries.at(*boundary(0)).outside);
  CHECK(scene.boundaries.at(*boundary(2)).outside == MediumId{1});
}

TEST_CASE("directives keep to their side of WorldBegin") {
  CHECK_CONTAINS(world_error("Camera \"perspective\""), "Camera stands after WorldBegin");
  CHECK_CONTAINS(world_error("WorldBegin"), "WorldBegin stands after WorldBegin");
  CHECK_CONTAINS(test::error_of("Shape \"sphere\" WorldBegin"), "Shape stands before WorldBegin");
  CHECK(test::error_of("Translate 1 0 0") ==
        "test.pbrt:1:16: the file ends without WorldBegin; add it after the camera and the film");
  CHECK_CONTAINS(world_error("WorldEnd"), "not part of pbrt-v4");
  CHECK(world_error("Shap \"sphere\"") == "test.pbrt:1:12: unknown directive \"Shap\"; did you mean \"Shape\"?");
  CHECK_CONTAINS(world_error("\"sphere\""), "expected a directive");
}
