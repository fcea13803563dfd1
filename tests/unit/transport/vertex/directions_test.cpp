/// Where paths go on from a collision.
#include "transport/vertex/directions.h"

#include <doctest/doctest.h>

#include "session/world_parts.h"
#include "support/chi_squared.h"
#include "support/scene_text.h"
#include "support/sphere_scene.h"

namespace tyndall {
namespace {

using namespace test;

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};

/// A world all in fog, and a collision in it, with the camera's medium around it.
class Collision {
 public:
  Collision(const std::string& more, Vec3 wo)
      : world_(world_of("Camera \"perspective\"\nWorldBegin\n" +
                            homogeneous("fog", {.sigma_a = Rgb(0.01f), .sigma_s = Rgb(4), .g = 0.85f}) +
                            medium_box("fog", "", kBox) + more,
                        {})) {
    const BuiltWorld& built = world_.parts().built;
    const Vec3 p = world_.parts().to_user.inverse().point({0.1f, 0.2f, 0});
    MediaState state = built.camera_media;
    for (const Crossing& c : built.geometry.trace_all({built.camera.center(), p - built.camera.center()}, 0, 1))
      state.cross(c.group, c.sign);
    PhaseMix phase;
    phase.add(Rgb(4), phase_);
    vertex_.emplace(Vertex::InMedium{p, phase}, wo, state);
  }
  Directions directions(const RenderSettings& settings = {}, int bounce = 1, float guided_weight = 1) {
    const BuiltWorld& built = world_.parts().built;
    return {LightContext{built, built.lights.selector(settings.lights), settings, sampler_, counters_, bounce, bounce,
                         guided_weight},
            *vertex_};
  }
  const Vertex& vertex() const { return *vertex_; }

 private:
  World world_;
  Phase phase_ = HenyeyGreenstein{0.85f};
  std::optional<Vertex> vertex_;
  Sampler sampler_{{0, 0, 0, 0}};
  Counters counters_;
};

const Vec3 kWo = normalize(Vec3{0.3f, -1, 0.2f});
const std::string kSun = distant_light({0, -1, 0.2f}, 3);

TEST_CASE("directions toward a sun follow their density, which weighs them against lights, and weights are by it") {
  Collision collision(kSun + environment(0.1f), kWo);
  const Directions directions = collision.directions();
  REQUIRE(directions.aureole());
  int sample = 0, wrong = 0;
  const auto result = chi_squared_test(
      [&](const Uniform&) -> std::optional<Vec3> {
        Sampler sampler({1, 0, 0, sample++});
        const auto s = directions.sample(Rgb(1.0f), sampler);
        if (!s) return std::nullopt;
        const float pdf = directions.pdf(s->wi, Rgb(1.0f));
        wrong += std::abs(s->pdf / pdf - 1) < 1e-4f ? 0 : 1;
        wrong += std::abs(s->weight.g * pdf / collision.vertex().eval(s->wi).g - 1) < 1e-4f ? 0 : 1;
        return s->wi;
      },
      [&](Vec3 w) { return directions.pdf(w, Rgb(1.0f)); }, {.axis = {0, 1, 0}, .theta_power = 2});
  CHECK_MESSAGE(result.passed, result.summary());
  CHECK(wrong == 0);
}

TEST_CASE("a path that guiding has sent astray is guided no more, so that its weight stays near what it is") {
  Collision collision(kSun, kWo);
  const auto most = [&](float weight) {
    const Directions directions = collision.directions({}, 1, weight);
    float largest = 0;
    for (int i = 0; i < 2000; ++i) {
      Sampler sampler({1, 0, 0, i});
      if (const auto s = directions.sample(Rgb(1.0f), sampler)) largest = std::max(largest, s->weight.r);
    }
    return largest;
  };
  CHECK(most(1) > 1.5f);
  CHECK(most(10) == most(1));
  CHECK(most(1e4f) < 1.02f);
  CHECK(most(kInfinity) == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("collisions follow no sun that is hidden, nor where it is not asked for or only lights are sought") {
  const std::string roof = block("Translate 0 1.5 0\nRotate -90 1 0 0\nShape \"disk\" \"float radius\" 4\n");
  CHECK_FALSE(Collision(kSun + roof, kWo).directions().aureole());
  CHECK_FALSE(Collision(environment(1), kWo).directions().aureole());
  Collision lit(kSun, kWo);
  RenderSettings off, two;
  off.guiding = GuidingStrategy::off;
  two.max_depth = 2;
  CHECK(lit.directions().aureole());
  CHECK_FALSE(lit.directions(off).aureole());
  CHECK_FALSE(lit.directions(two).aureole());
  CHECK(lit.directions(two, 0).aureole());
}

}  // namespace
}  // namespace tyndall
