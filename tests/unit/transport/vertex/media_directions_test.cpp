/// Directions toward bright media follow their density, wherever one looks from.
#include "transport/vertex/media_directions.h"

#include <doctest/doctest.h>

#include "session/world_parts.h"
#include "support/chi_squared.h"
#include "support/scene_text.h"
#include "support/sphere_scene.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};

/// Smoke in one corner of a box, one point light in it.
std::string corner_of_smoke() {
  Grid grid{kBox, 8, 8, 8, std::vector<float>(512, 0.0f)};
  grid.density[0] = 1;
  return "Camera \"perspective\"\nWorldBegin\n" + point_light({-0.9f, -0.9f, -0.9f}, 1) +
         uniform_grid("smoke", {.sigma_a = Rgb(0.1f), .sigma_s = Rgb(8)}, grid) + medium_box("smoke", "", kBox);
}

/// In the units of the scene.
PointQuery query_at(const World& world, Vec3 p, Vec3 n, bool transmissive = false) {
  PointQuery query;
  query.p = world.parts().to_user.inverse().point(p);
  query.n = n;
  query.transmissive = transmissive;
  return query;
}

}  // namespace

TEST_CASE("directions toward smoke follow their density: from afar, beside it, inside it, over a horizon through it") {
  const World world = world_of(corner_of_smoke(), {});
  const BrightMedia& media = world.parts().built.bright_media;
  REQUIRE_FALSE(media.empty());
  const Vec3 up{0, 1, 0};
  const PointQuery queries[] = {query_at(world, {-0.9f, -30, -0.9f}, up), query_at(world, {-0.9f, -2, -0.8f}, up),
                                query_at(world, {-0.85f, -0.9f, -0.85f}, up), query_at(world, {1, -0.93f, -0.9f}, up),
                                query_at(world, {-0.9f, 2, -0.8f}, up, true)};
  for (const PointQuery& query : queries) {
    const MediaDirections directions(media, query, false);
    REQUIRE(directions.share() > 0);
    CHECK(directions.share() <= 0.5f);
    const Vec3 axis = normalize(Vec3{media.x()[0], media.y()[0], media.z()[0]} - query.p);
    const auto result = chi_squared_test(
        [&](const Uniform& random) -> std::optional<Vec3> {
          const float u = random();
          const Vec2 on_cone{random(), random()};
          return directions.sample(u, on_cone);
        },
        [&](Vec3 w) { return directions.pdf(w); }, {.axis = axis, .theta_power = 3, .alpha = sidak(1e-3, std::size(queries))});
    CHECK_MESSAGE(result.passed, result.summary());
    CHECK(result.density_integral == doctest::Approx(1).epsilon(0.01));
  }
}

TEST_CASE("fire that is sought as a light counts among the lights: facing it alone, half as many directions are guided") {
  Grid grid{kBox, 8, 8, 8, std::vector<float>(512, 0.0f)};
  grid.density[0] = 1;
  const test::Coefficients burning{.sigma_a = Rgb(8), .sigma_s = Rgb(1), .Le = Rgb(3)};
  const World world =
      world_of("Camera \"perspective\"\nWorldBegin\n" + uniform_grid("fire", burning, grid) + medium_box("fire", "", kBox), {});
  const BrightMedia& media = world.parts().built.bright_media;
  CHECK(media.emission_share() == 1);
  const PointQuery query = query_at(world, {-0.9f, -30, -0.9f}, {0, 1, 0});
  CHECK(MediaDirections(media, query, false).share() == doctest::Approx(0.5));
  CHECK(MediaDirections(media, query, true).share() == doctest::Approx(0.25).epsilon(0.01));
}

TEST_CASE("no direction is guided where none can: beyond the horizon, without light, without smoke that varies") {
  const World world = world_of(corner_of_smoke(), {});
  CHECK(MediaDirections(world.parts().built.bright_media, query_at(world, {0, 5, 0}, {0, 1, 0}), false).share() == 0);
  std::string dark = corner_of_smoke();
  dark.erase(dark.find("LightSource"), dark.find("MakeNamedMedium") - dark.find("LightSource"));
  CHECK(world_of(dark, {}).parts().built.bright_media.empty());
  const std::string fog = "Camera \"perspective\"\nWorldBegin\n" + point_light({-0.9f, -0.9f, -0.9f}, 1) +
                          homogeneous("fog", {.sigma_s = Rgb(1)}) + medium_box("fog", "", kBox);
  CHECK(world_of(fog, {}).parts().built.bright_media.empty());
}
