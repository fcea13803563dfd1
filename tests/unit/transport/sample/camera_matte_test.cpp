#include "transport/sample/camera_matte.h"

#include <doctest/doctest.h>

#include <cmath>

#include "session/world_parts.h"
#include "support/scene_text.h"
#include "support/sphere_scene.h"
#include "transport/media/camera_media.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// Mean of what rays from `eye` along +z see, of so many samples.
struct Seen {
  double transmittance = 0;
  std::vector<double> opacity;  ///< by medium
  bool surface = false;
};

Seen look(const std::string& scene, int samples) {
  const World world = world_of(view({.eye = {0, 0, -4}, .look = {}}) + point_light({0, 5, 0}, 1) + scene, {});
  const BuiltWorld& built = world.parts().built;
  Counters counters;
  Seen seen;
  seen.opacity.resize(built.media.size());
  for (int s = 0; s < samples; ++s) {
    Sampler sampler({.seed = 3, .sample = s});
    const LightContext context{built, built.lights.selector(LightStrategy::tree, false), world.parts().built.scene.settings,
                               sampler, counters};
    const Ray ray = built.camera.ray({8, 8}, {0.5f, 0.5f});
    const Trace trace = built.geometry.trace(ray, 0, kInfinity);
    CameraMatte matte;
    matte.meet(trace);
    matte.see_through(context,
                      make_span(built.media_context(), built.media_at_start(ray.o), ray, trace, counters.parity_errors));
    seen.transmittance += static_cast<double>(matte.transmittance()) / samples;
    for (const CameraMatte::Share& share : matte.media())
      seen.opacity[static_cast<std::size_t>(share.medium - built.media.data())] += static_cast<double>(share.opacity) / samples;
    seen.surface = matte.shape().has_value();
  }
  return seen;
}

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};

}  // namespace

TEST_CASE("a medium covers by its opacity, the surface behind it by what is left") {
  const Seen seen = look(homogeneous("m", {.sigma_a = Rgb(0.2f), .sigma_s = {0.3f, 0.1f, 0.5f}}) + medium_box("m", "", kBox) +
                             diffuse_plane(3, 5, 0.5f),
                         1);
  const double T = (std::exp(-1.0) + std::exp(-0.6) + std::exp(-1.4)) / 3;
  CHECK(seen.surface);
  CHECK(seen.transmittance == doctest::Approx(T).epsilon(1e-5));
  CHECK(seen.opacity[0] == doctest::Approx(1 - T).epsilon(1e-5));
}

TEST_CASE("what is behind another medium covers less, and nothing covers what is not there") {
  const Seen seen =
      look(homogeneous("front", {.sigma_s = Rgb(0.5f)}) + homogeneous("back", {.sigma_a = Rgb(1)}) +
               medium_box("front", "", {{-1, -1, -1}, {1, 1, 0}}) + medium_box("back", "", {{-1, -1, 0.5f}, {1, 1, 1}}),
           1);
  CHECK_FALSE(seen.surface);
  CHECK(seen.opacity[0] == doctest::Approx(1 - std::exp(-0.5)).epsilon(1e-5));
  CHECK(seen.opacity[1] == doctest::Approx(std::exp(-0.5) * (1 - std::exp(-0.5))).epsilon(1e-5));
  CHECK(seen.transmittance == doctest::Approx(std::exp(-1.0)).epsilon(1e-5));
}

TEST_CASE("media that overlap share what they hide by their extinction") {
  const Seen even = look(homogeneous("a", {.sigma_s = Rgb(0.3f)}) + homogeneous("b", {.sigma_a = Rgb(0.9f)}) +
                             medium_box("a", "", kBox) + medium_box("b", "", kBox),
                         1);
  CHECK(even.opacity[0] == doctest::Approx(0.25 * (1 - std::exp(-2.4))).epsilon(1e-4));
  CHECK(even.opacity[1] == doctest::Approx(0.75 * (1 - std::exp(-2.4))).epsilon(1e-4));

  // Densities that grow and fall along the ray: integrals of T sigma.
  std::vector<float> rising, falling;
  for (int i = 0; i < 32; ++i) {
    rising.push_back(static_cast<float>(i) / 16);
    falling.push_back(static_cast<float>(31 - i) / 16);
  }
  const test::Coefficients c{.sigma_a = Rgb(0.5f), .sigma_s = Rgb(0.5f)};
  const Seen graded = look(uniform_grid("a", c, {kBox, 1, 1, 32, rising}) + uniform_grid("b", c, {kBox, 1, 1, 32, falling}) +
                               medium_box("a", "", kBox) + medium_box("b", "", kBox),
                           400);
  double T = 1, hidden = 0, by_a = 0;
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double x = 32 * (i + 0.5) / steps - 0.5, at = std::min(std::max(x, 0.0), 31.0);
    const double edge = x < 0 ? 1 + x : x > 31 ? 32 - x : 1;  // grids are zero outside
    const double a = edge * at / 16, b = edge * (31 - at) / 16, next = T * std::exp(-(a + b) * 2 / steps);
    by_a += (T - next) * (a + b > 0 ? a / (a + b) : 0);
    hidden += T - next;
    T = next;
  }
  CHECK(graded.transmittance == doctest::Approx(T).epsilon(0.02));
  CHECK(graded.opacity[0] + graded.opacity[1] == doctest::Approx(hidden).epsilon(0.02));
  CHECK(graded.opacity[0] == doctest::Approx(by_a).epsilon(0.03));
}
