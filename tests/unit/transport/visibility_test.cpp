#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include "session/world_parts.h"
#include "support/sphere_scene.h"
#include "transport/direct_light.h"

namespace tyndall {
namespace {

/// Fog around the camera, without bounds, and in it the lit sphere.
constexpr const char* kFog = R"(
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [0.1 0.2 0.3] "rgb sigma_s" [0.3 0.8 2]
MediumInterface "" "fog"
Camera "perspective"
)";

TEST_CASE("shadow rays: through homogeneous fog exp(-sigma_t d) passes, all the way to the light") {
  const World world = test::world_of(kFog + test::sphere_scene(4, 4), {});
  const World::Parts& parts = world.parts();
  const RenderSettings settings;
  Sampler sampler({0, 0, 0, 0});
  Counters counters;
  const LightContext context{parts.built, parts.built.lights.selector(settings.lights), settings, sampler, counters};
  const Vec3 origin = parts.to_user.inverse().point({0, 0, 0});
  const auto arriving_from = [&](Vec3 wi, float distance) {
    return arriving(context, parts.built.camera_media, origin,
                    {.wi = wi, .distance = distance, .L = {}, .pdf = 1, .delta = true}, sampler);
  };
  for (const float d : {0.01f, 0.5f, 2.0f, 8.0f}) {
    const Rgb T = arriving_from({-1, 0, 0}, d / parts.unit);
    // The segment ends at the light, not where the search for occluders does, 1e-4 before it.
    for (const auto& [channel, sigma_t] : {std::pair{T.r, 0.4}, {T.g, 1.0}, {T.b, 2.3}}) {
      CHECK(std::log(double{channel}) == doctest::Approx(-sigma_t * d).epsilon(1e-5));
    }
  }
  const Rgb blocked = arriving_from({0, 0, 1}, 8 / parts.unit);
  CHECK(is_black(blocked));
}

}  // namespace
}  // namespace tyndall
