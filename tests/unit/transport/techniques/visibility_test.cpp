#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "session/world_parts.h"
#include "support/sphere_scene.h"
#include "transport/techniques/shadow_ray.h"

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
  RenderSettings settings;
  settings.max_depth = 1;  // else dark rays are traced by chance
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

// At 8 units the clearest channel has an optical depth of 3.2. The bounds are four standard errors wide.
TEST_CASE("shadow rays that hardly anything comes through are right on average, and few") {
  const World world = test::world_of(kFog + test::sphere_scene(4, 4), {});
  const World::Parts& parts = world.parts();
  RenderSettings settings;
  settings.max_depth = 5;
  constexpr int kRays = 20000;
  for (const float d : {0.5f, 8.0f, 16.0f}) {
    Counters counters;
    double sum = 0, squares = 0;
    for (int i = 0; i < kRays; ++i) {
      Sampler sampler({0, 0, 0, i});
      const LightContext context{parts.built, parts.built.lights.selector(settings.lights), settings, sampler, counters};
      const Rgb T = arriving(context, parts.built.camera_media, parts.to_user.inverse().point({0, 0, 0}),
                             {.wi = {-1, 0, 0}, .distance = d / parts.unit, .L = {}, .pdf = 1, .delta = true}, sampler);
      sum += T.r, squares += double{T.r} * T.r;
    }
    const double mean = sum / kRays, error = std::sqrt(std::max(squares / kRays - mean * mean, 0.0) / kRays);
    CHECK(std::abs(mean - std::exp(-0.4 * d)) <= 4 * error + 1e-5 * mean);
    if (d < 1) CHECK(counters.shadow_rays == kRays);
    if (d > 10) CHECK(counters.shadow_rays < kRays / 4);
  }
}

}  // namespace
}  // namespace tyndall
