#include "unit/io/reader_checks.h"

using namespace tyndall;

namespace {

const std::string kMedium =
    "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" MediumInterface \"m\" \"\" Material \"interface\" ";

std::vector<Warning> warnings(const std::string& body) { return test::read_world_file(kMedium + body).warnings; }

std::string ball(const std::string& transform, const std::string& radius = "1") {
  return "AttributeBegin " + transform + " Shape \"sphere\" \"float radius\" " + radius + " AttributeEnd\n";
}

}  // namespace

TEST_CASE("boundaries that cross each other are warned of; nested, touching and separate ones are not") {
  const auto crossing = warnings(ball("Translate 1 0 0") + ball("Translate 0.2 0.5 0"));
  REQUIRE(crossing.size() == 1);
  CHECK(crossing[0].where.line == 1);
  CHECK_CONTAINS(crossing[0].message, "seem to cross here");
  CHECK(warnings(ball("") + ball("Translate 0.1 0.1 0.1", "0.5")).empty());
  CHECK(warnings(ball("") + ball("")).empty());
  CHECK(warnings(ball("") + ball("Translate 2 0 0")).empty());
  CHECK(warnings(ball("") + ball("Translate 0 5 0")).empty());
}

TEST_CASE("of instances every place counts") {
  const std::string object = "ObjectBegin \"o\" Shape \"sphere\" ObjectEnd ObjectInstance \"o\" Translate 0 ";
  CHECK(warnings(object + "1 0 ObjectInstance \"o\"").size() == 1);
  CHECK(warnings(object + "3 0 ObjectInstance \"o\"").empty());
}

TEST_CASE("what pbrt-v4 does with emitters of objects and with media before Camera is said") {
  const auto emitting =
      test::read_world_file("ObjectBegin \"o\" AreaLightSource \"diffuse\" Shape \"sphere\" ObjectEnd").warnings;
  REQUIRE(emitting.size() == 1);
  CHECK_CONTAINS(emitting[0].message, "in pbrt-v4 they stay dark");
  const std::string cloud = "MakeNamedMedium \"c\" \"string type\" \"cloud\" ", camera = "Camera \"perspective\" ";
  const auto count = [](const std::string& text) { return read_scene_text(text, "test.pbrt").warnings.size(); };
  CHECK(count(cloud + camera + "WorldBegin") == 1);
  CHECK(count(camera + cloud + "WorldBegin") == 0);
  CHECK(count(camera + "WorldBegin " + cloud) == 0);
  CHECK(count("Option \"rendercoordsys\" \"world\" " + cloud + camera + "WorldBegin") == 0);
  CHECK(count("MakeNamedMedium \"m\" \"string type\" \"homogeneous\" " + camera + "WorldBegin") == 0);
}
