#include "tyndall/scene_edit.h"

#include <doctest/doctest.h>

#include <functional>
#include <string>

namespace tyndall {
namespace {

Medium fog(std::string name) {
  Medium medium;
  medium.name = std::move(name);
  medium.to_world = Transform::translate(1, 2, 3);
  return medium;
}

constexpr Bounds3 kBox{{-1, -2, -3}, {1, 2, 3}};

std::string message_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& e) {
    CHECK(e.failure() == Failure::usage);
    return e.what();
  }
  return "";
}

TEST_CASE("a medium is added with a closed box that points outward") {
  Scene scene;
  CHECK(add_medium(scene, fog("a"), kBox) == 0);
  CHECK(add_medium(scene, fog("b"), kBox) == 1);
  CHECK(medium_named(scene, "b") == 1);
  REQUIRE(scene.shapes.size() == 2);
  const Shape& box = scene.shapes[1];
  CHECK(scene.boundaries.at(*box.boundary).inside == MediumId{1});
  CHECK(!scene.boundaries.at(*box.boundary).outside);
  CHECK(std::holds_alternative<InterfaceMaterial>(scene.materials.at(box.material).kind));
  CHECK(box.to_world.point({0, 0, 0}) == Vec3{1, 2, 3});

  // By the divergence theorem the volume is what the faces, as they are oriented, enclose.
  const auto& mesh = std::get<TriangleMesh>(box.kind);
  REQUIRE(mesh.indices.size() == 36);
  float volume = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
    const Vec3 normal = cross(corner(1) - corner(0), corner(2) - corner(0));
    CHECK(dot(normal, corner(0)) > 0);
    volume += dot(corner(0), normal) / 6;
  }
  CHECK(volume == doctest::Approx(2 * 4 * 6));
}

TEST_CASE("media and materials that cannot be added, or are not there") {
  Scene scene;
  add_medium(scene, fog("a"), kBox);
  add_medium(scene, fog(""), kBox);
  add_medium(scene, fog(""), kBox);  // what has no name is not mistaken for another
  add_diffuse_material(scene, "clay", Rgb(0.5f));
  CHECK(message_of([&] { add_medium(scene, fog("a"), kBox); }).find("is there already") != std::string::npos);
  CHECK(message_of([&] { add_medium(scene, fog("b"), {{0, 0, 0}, {1, 0, 1}}); }).find("no volume") != std::string::npos);
  CHECK(message_of([&] { add_medium(scene, fog("b"), {}); }).find("no volume") != std::string::npos);
  CHECK(message_of([&] { add_diffuse_material(scene, "clay", Rgb(1.0f)); }).find("is there already") != std::string::npos);
  CHECK(message_of([&] { medium_named(scene, "b"); }) == "no medium is called \"b\"; choose from a");
  CHECK(message_of([&] { medium_named(scene, ""); }) == "no medium is called \"\"; choose from a");
  CHECK(message_of([&] { material_named(Scene(), "b"); }) == "no material is called \"b\"; none has a name");
  CHECK(scene.media.size() == 3);
  CHECK(scene.shapes.size() == 3);
}

TEST_CASE("a diffuse material has its reflectance") {
  Scene scene;
  add_diffuse_material(scene, "white", Rgb(1.0f));
  const MaterialId id = add_diffuse_material(scene, "clay", {0.7f, 0.5f, 0.3f});
  CHECK(material_named(scene, "clay") == id);
  const auto& diffuse = std::get<DiffuseMaterial>(scene.materials[id].kind);
  CHECK(std::get<ConstantTexture>(scene.textures[diffuse.reflectance].kind).value == Rgb(0.7f, 0.5f, 0.3f));
}

TEST_CASE("an error knows the place that its message begins with") {
  const Error placed(Location{"a.pbrt", 3, 7}, "what");
  CHECK(placed.what() == std::string("a.pbrt:3:7: what"));
  CHECK(placed.where().file == "a.pbrt");
  CHECK(placed.where().line == 3);
  CHECK(placed.where().column == 7);
  CHECK(Error(Failure::usage, "what").where().file.empty());
}

}  // namespace
}  // namespace tyndall
