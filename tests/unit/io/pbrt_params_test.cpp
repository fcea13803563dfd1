/// Parameter lists: types, counts, unknown and repeated names, defaults of the Attribute directive.
#include "io/pbrt_suggest.h"
#include "unit/io/reader_checks.h"

using namespace tyndall;
using test::world_error;

TEST_CASE("values stand alone or in brackets") {
  const Scene scene = test::read_world("Shape \"sphere\" \"float radius\" 2 \"float zmin\" [ -1 ]");
  const Sphere& s = std::get<Sphere>(scene.shapes.at(0).kind);
  CHECK(s.radius == 2);
  CHECK(s.z_min == -1);
}

TEST_CASE("errors name the place, the fault and the way out") {
  CHECK(test::error_of("WorldBegin\nShape \"sphere\"\n  \"float radus\" 2") ==
        "test.pbrt:3:3: shape \"sphere\" has no parameter \"radus\"; did you mean \"radius\"?");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"string radius\" \"2\""),
                 "test.pbrt:1:27: parameter \"radius\" of shape \"sphere\" is a float, not a string");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"float radius\" [1 2]"), "has more than one value");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"float radius\" []"), "has no value");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"float radius\" 1 \"float radius\" 2"), "is given twice");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"floot radius\" 1"),
                 "\"floot\" is not a parameter type; did you mean \"float\"?");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"color alpha\" [1 1 1]"), "use \"rgb\"");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"radius\" 1"), "write \"type name\"");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"float radius big\" 1"), "write \"type name\"");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"float radius\" \"1\""), "found the string \"1\"");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"float radius\" [1"), "add the missing ]");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"float radius\""), "expected a number but the file ends");
  CHECK_CONTAINS(world_error("Shape \"trianglemesh\" \"point3 P\" [1 2 3 4]"), "has 4 values; a point3 takes 3");
  CHECK_CONTAINS(world_error("Shape \"trianglemesh\" \"integer indices\" [0 1.5 2]"), "\"1.5\" is not an integer");
  CHECK_CONTAINS(world_error("AreaLightSource \"diffuse\" \"bool twosided\" \"true\""), "expected true or false");
  CHECK_CONTAINS(world_error("AreaLightSource \"diffuse\" \"spectrum L\" [400 \"a\"]"), "mixes numbers and strings");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"float radius\" 1e60"), "too large");
  CHECK_CONTAINS(world_error("Shape \"sphere\" \"float radius\" nan"), "not a number");
}

TEST_CASE("suggestions are near in spelling, or a list of what there is") {
  using pbrt::nearest_names;
  using pbrt::suggestion;
  const std::vector<std::string> known{"radius", "phimax", "zmin", "zmax"};
  CHECK(nearest_names("Radius", known) == std::vector<std::string>{"radius"});
  CHECK(nearest_names("zmix", known) == std::vector<std::string>{"zmax", "zmin"});
  CHECK(nearest_names("colour", known).empty());
  CHECK(suggestion("zmix", known) == "did you mean \"zmax\" or \"zmin\"?");
  CHECK(suggestion("colour", known) == "known: \"radius\", \"phimax\", \"zmin\", \"zmax\"");
  CHECK(nearest_names(std::string(10000, 'z'), known).empty());
}

TEST_CASE("Attribute gives defaults to later entities and stays within its block") {
  const Scene scene = test::read_world(R"(
    AttributeBegin
      Attribute "shape" "float radius" 3 "float height" 1
      Shape "sphere"
      Shape "sphere" "float radius" 4
      Attribute "shape" "float radius" 5
      Shape "sphere"
    AttributeEnd
    Shape "sphere"
    Attribute "light" "float scale" 10
    LightSource "point" "rgb I" [1 2 3]
    Attribute "material" "rgb reflectance" [.1 .2 .3]
    Material "diffuse"
    Attribute "medium" "float g" 0.5
    MakeNamedMedium "m" "string type" "homogeneous"
    Attribute "texture" "float uscale" 7
    Texture "t" "float" "checkerboard")");
  const auto radius = [&](int i) { return std::get<Sphere>(scene.shapes.at(i).kind).radius; };
  CHECK(radius(0) == 3);
  CHECK(radius(1) == 4);
  CHECK(radius(2) == 5);
  CHECK(radius(3) == 1);
  CHECK(std::get<PointLight>(scene.lights.at(0).kind).I == Rgb(10, 20, 30));
  CHECK(test::constant(scene, std::get<DiffuseMaterial>(test::last_material(scene).kind).reflectance) == Rgb(.1f, .2f, .3f));
  CHECK(scene.media.at(0).optics.phase == Phase(HenyeyGreenstein{0.5f}));
  CHECK(std::get<CheckerboardTexture>(scene.textures.back().kind).mapping.scale.x == 7);
  CHECK_CONTAINS(world_error("Attribute \"shapes\" \"float radius\" 1"), "did you mean \"shape\"?");
}
