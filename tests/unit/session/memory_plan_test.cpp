#include "session/memory_plan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "support/scratch.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

constexpr std::array kTree{LightStrategy::tree};

std::size_t part(const MemoryPlan& plan, const std::string& name) {
  const auto found = std::find_if(plan.parts.begin(), plan.parts.end(), [&](const auto& p) { return p.first == name; });
  REQUIRE(found != plan.parts.end());
  return found->second;
}

TEST_CASE("images on area lights are planned wherever they hang, and once") {
  const test::Scratch folder;
  Image image{.data = {0, 0, 64, 32}, .display = {0, 0, 64, 32}, .channels = {}, .attributes = {}, .chromaticities = {}};
  for (const char* name : {"R", "G", "B"}) image.add_channel(name);
  write_exr(image, folder / "sign.exr");
  AreaLight light;
  light.path = folder / "sign.exr";
  const Shape sign{.kind = Sphere{.radius = 1}, .emission = light};

  Scene bare, alone, in_object, both;
  alone.shapes.push_back(sign);
  in_object.objects.push_back({.name = "sign", .shapes = {sign}});
  both.shapes = alone.shapes;
  both.objects = in_object.objects;
  CHECK(part(plan_memory(bare, kTree), "textures") == 0);
  const std::size_t bytes = part(plan_memory(alone, kTree), "textures");
  CHECK(bytes >= 64 * 32 * 16);
  CHECK(part(plan_memory(in_object, kTree), "textures") == bytes);
  CHECK(part(plan_memory(both, kTree), "textures") == bytes);
}

TEST_CASE("what pixels know of emitters is planned where there are emitters") {
  Scene scene;
  scene.film.crop = {0, 0, 1000, 500};
  const auto film = [&] { return part(plan_memory(scene, kTree), "film"); };
  const std::size_t bare = film();
  scene.shapes.push_back({.kind = Sphere{.radius = 1}, .emission = AreaLight{}});
  const std::size_t one = film();
  CHECK(one > bare);
  CHECK(one < bare + 500'000 * 11);
  for (int i = 0; i < 100'000; ++i) scene.shapes.push_back(scene.shapes[0]);
  CHECK(film() >= bare + 500'000 * (4 + 4 + 8 * 8));
  scene.filter.radius = {5, 5};
  CHECK(film() == bare);
}

TEST_CASE("sums of light groups are planned where the scene names groups") {
  Scene scene;
  scene.film.crop = {0, 0, 1000, 500};
  scene.lights.resize(3);
  const auto film = [&] { return part(plan_memory(scene, kTree), "film"); };
  const std::size_t bare = film();
  scene.lights[0].group = scene.lights[1].group = "key";
  const std::size_t one = film();
  CHECK(one >= bare + 500'000 * 2 * 6 * 12);  // of the group and of the rest
  CHECK(one <= bare + 500'000 * 2 * 6 * 2 * (12 + 4));
  scene.lights[2].group = "sky";
  CHECK(film() - one == (one - bare) / 2);
}

TEST_CASE("mattes and deep images are planned where they are asked for") {
  Scene scene;
  scene.film.crop = {0, 0, 1000, 500};
  const auto film = [&] { return part(plan_memory(scene, kTree), "film"); };
  const std::size_t bare = film();
  scene.settings.aovs = {"CryptoObject"};
  CHECK(film() >= bare + 500'000 * 12 * 4);
  scene.settings.aovs.clear();
  scene.settings.deep_bins = 16;
  const std::size_t surfaces = film();
  CHECK(surfaces >= bare + 500'000 * 4 * 76);
  scene.media.emplace_back();
  const std::size_t deep = film();
  CHECK(deep - bare > 3 * (surfaces - bare));
  CHECK(deep >= bare + 500'000 * 16 * 76);
  scene.settings.deep_bins = 34;
  CHECK(film() - bare >= 2 * (deep - bare) - 500'000 * 40);
}

TEST_CASE("lights that instances share are planned once, for who shares them") {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {}};
  for (std::uint32_t i = 0; i < 3000; ++i) mesh.indices.push_back(i % 3);
  Scene scene;
  scene.objects.push_back({.name = "lamp", .shapes = {Shape{.kind = mesh, .emission = AreaLight{}}}});
  const auto lights = [&](std::initializer_list<LightStrategy> strategies) {
    return part(plan_memory(scene, std::vector<LightStrategy>(strategies)), "lights");
  };
  for (int i = 0; i < 1000; ++i) scene.instances.push_back({0, Transform::translate(i, 0, 0)});
  CHECK(lights({LightStrategy::tree}) < 2'000'000);
  CHECK(lights({LightStrategy::power}) > 150'000'000);
  CHECK(lights({LightStrategy::tree, LightStrategy::power}) > 150'000'000);
  // The grid of cells has a limit, whatever there is.
  CHECK(lights({LightStrategy::cells}) > lights({LightStrategy::power}) + 16'000'000);
  CHECK(lights({LightStrategy::cells}) < lights({LightStrategy::power}) + 40'000'000);
  for (int i = 0; i < 100; ++i) scene.instances.push_back({0, Transform::scale(1, 2, 1)});
  CHECK(lights({LightStrategy::tree}) > 15'000'000);
}

}  // namespace
}  // namespace tyndall
