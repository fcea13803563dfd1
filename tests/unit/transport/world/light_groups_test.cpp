#include "transport/world/light_groups.h"

#include <doctest/doctest.h>

#include "session/world_parts.h"
#include "support/scene_text.h"
#include "support/sphere_scene.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};

std::string grouped(const std::string& group, const std::string& text) {
  return test::block("Attribute \"light\" \"string lightgroup\" \"" + group +
                     "\"\nAttribute \"medium\" \"string lightgroup\" \"" + group + "\"\n" + text);
}

/// `count` triangles.
std::string mesh(int count) {
  std::string points, indices;
  for (int i = 0; i < count; ++i) {
    points += std::to_string(i) + " 0 0 " + std::to_string(i) + ".5 0 0 " + std::to_string(i) + " 0.5 0 ";
    for (int k = 0; k < 3; ++k) indices += std::to_string(3 * i + k) + " ";
  }
  return "AreaLightSource \"diffuse\"\nShape \"trianglemesh\" \"point3 P\" [" + points + "] \"integer indices\" [" + indices +
         "]\n";
}

std::string medium(const std::string& name) {
  return test::homogeneous(name, {.sigma_a = Rgb(1), .Le = Rgb(1)}) + test::medium_box(name, "", kBox);
}

std::vector<std::string> groups_of(const World& world) {
  const BuiltWorld& built = world.parts().built;
  std::vector<std::string> groups;
  for (LightId id = 0; id < built.lights.size(); ++id) groups.push_back(built.light_groups.names()[built.light_groups.of(id)]);
  return groups;
}

World world_of(const std::string& lights) {
  return test::world_of(test::view({.eye = {0, 0, -5}, .look = {}}) + lights, {.volume_lights = true});
}

}  // namespace

TEST_CASE("light groups of all kinds of lights: by id as they are built") {
  const std::string object = "ObjectBegin \"o\"\n" + grouped("sign", mesh(20)) + mesh(2) + "ObjectEnd\n";
  const World world =
      world_of(grouped("key", test::point_light({3, 3, 3}, 1)) + test::environment(1) + grouped("lamp", mesh(3)) +
               grouped("fire", medium("a")) + medium("b") + grouped("lamp", mesh(1)) + object +
               test::block("Translate 9 0 0\nObjectInstance \"o\"\n") + test::block("Translate 0 9 0\nObjectInstance \"o\"\n"));
  const LightGroups& groups = world.parts().built.light_groups;
  CHECK(groups.names() == std::vector<std::string>{"fire", "key", "lamp", "sign", "default"});
  const auto of = groups_of(world);
  std::vector<std::string> expected{"key", "default", "lamp", "lamp", "lamp", "lamp"};
  const auto& volumes = world.parts().built.volume_lights;
  const LightId first = world.parts().built.lights.first_volume();
  REQUIRE(first == expected.size());
  for (LightId id = first; volumes.holds(id); ++id)
    expected.push_back(&volumes.medium(id) == &world.parts().built.media[0] ? "fire" : "default");
  REQUIRE(expected.size() > first + 1);
  for (int instance = 0; instance < 2; ++instance) {
    expected.insert(expected.end(), 20, "sign");
    expected.insert(expected.end(), 2, "default");
  }
  CHECK(of == expected);
  const auto& media = world.parts().built.media;
  CHECK(groups.names()[groups.of(media[0])] == "fire");
  CHECK(groups.names()[groups.of(media[1])] == "default");
}

TEST_CASE("light groups: none without names, no rest where everything has one, the rest by its own name") {
  CHECK(world_of(test::point_light({3, 3, 3}, 1)).parts().built.light_groups.empty());
  const World all = world_of(grouped("b", test::point_light({3, 3, 3}, 1)) + grouped("a", test::environment(1)));
  CHECK(all.parts().built.light_groups.names() == std::vector<std::string>{"a", "b"});
  const World own = world_of(grouped("default", test::point_light({3, 3, 3}, 1)) + test::environment(1));
  CHECK(own.parts().built.light_groups.names() == std::vector<std::string>{"default"});
  CHECK(groups_of(own) == std::vector<std::string>{"default", "default"});
}

TEST_CASE("light groups: a name that no channel can have is refused, wherever the scene comes from") {
  Scene scene;
  scene.lights.push_back({PointLight{}, {}, "a.b"});
  CHECK_THROWS_AS(LightGroupsBuilder{scene}, Error);
  scene.lights[0].group = "b";
  scene.objects.push_back({"o", {{.emission = AreaLight{}}}});
  scene.objects[0].shapes[0].emission->group = "a";
  scene.media.emplace_back().group = "b";
  CHECK(named_light_groups(scene) == std::vector<std::string>{"a", "b"});
}

}  // namespace tyndall
