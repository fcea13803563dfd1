#include "transport/budget/collisions_suffice.h"

#include <doctest/doctest.h>

#include <cmath>

#include "light/lights.h"
#include "session/world_parts.h"
#include "support/sphere_scene.h"
#include "support/test_media.h"

namespace tyndall {
namespace {

/// As resolved.
RenderSettings by_default() {
  RenderSettings settings;
  settings.media = MediaStrategy::product;
  return settings;
}

/// A world with the lights of `text`, asked about segments of homogeneous media on the z axis from -1 on.
/// All in the units of the scene.
class Asked {
 public:
  explicit Asked(const std::string& text) : world_(test::world_of("Camera \"perspective\"\nWorldBegin\n" + text, {})) {}

  /// A segment of `length` from there on, in two parts.
  bool suffice(float sigma_s, float length = 2, const RenderSettings& settings = by_default(), int bounce = 1) {
    return suffice_in(fog(sigma_s * world_.parts().unit), length, settings, bounce);
  }
  /// In a grid that is hardly anything in places.
  bool suffice_in_grid(float sigma_s, int bounce) {
    const auto half_empty = [](int i) { return i % 8 < 4 ? 1.0f : 1e-3f; };
    const float unit = world_.parts().unit;
    return suffice_in(test::grid({8, -9, 9}, {{}, Rgb(sigma_s * unit), 0}, half_empty), 2, by_default(), bounce);
  }

  /// In a grid of hardly anything, in fog.
  bool suffice_in_both(float sigma_s, int bounce) {
    const float unit = world_.parts().unit;
    const auto even = [](int) { return 1.0f; };
    const ParticipatingMedium grid = test::grid({8, -9, 9}, {{}, Rgb(1e-3f * unit), 0}, even), around = fog(sigma_s * unit);
    return suffice_in({&grid, &around}, 2, by_default(), bounce);
  }

  bool suffice_in(const ParticipatingMedium& medium, float length, const RenderSettings& settings, int bounce) {
    return suffice_in({&medium}, length, settings, bounce);
  }
  bool suffice_in(const std::vector<const ParticipatingMedium*>& media, float length, const RenderSettings& settings,
                  int bounce) {
    const float unit = world_.parts().unit;
    Span span;
    span.ray = {world_.parts().to_user.inverse().point({0, 0, -1}), {0, 0, 1}};
    span.t_end = length / unit;
    for (const auto& [t0, t1] : {std::pair{0.0f, 0.5f}, {0.5f, length}}) {
      SpanPart& part = span.parts.emplace_back();
      part.t0 = t0 / unit;
      part.t1 = t1 / unit;
      for (const ParticipatingMedium* medium : media) part.media.push_back(medium);
    }
    return collisions_suffice(context(settings, bounce), span);
  }

  /// The same in one part, known by the box around it.
  bool suffice_inside(float sigma_s, float length) {
    const float unit = world_.parts().unit;
    const ParticipatingMedium medium = fog(sigma_s * unit);
    Interval inside{0, length / unit, {}};
    inside.media.push_back(&medium);
    const RenderSettings settings = by_default();
    return collisions_suffice(context(settings, 1), {world_.parts().to_user.inverse().point({0, 0, -1}), {0, 0, 1}}, inside);
  }

 private:
  static ParticipatingMedium fog(float sigma_s) {
    std::vector<std::string> notes;
    Medium description;
    description.kind = HomogeneousMedium{};
    description.optics.sigma_a = Rgb(0.0f);
    description.optics.sigma_s = Rgb(sigma_s);
    return build_medium(description, {}, notes);
  }
  LightContext context(const RenderSettings& settings, int bounce) {
    return {world_.parts().built, world_.parts().built.lights.selector(settings.lights), settings, sampler_, counters_, bounce};
  }

  World world_;
  Sampler sampler_{{0, 0, 0, 0}};
  Counters counters_;
};

constexpr const char* kSun = "LightSource \"distant\"\n";
constexpr const char* kPoint = "LightSource \"point\" \"point3 from\" [10 0 0]\n";

/// E[x^2] / E[x]^2 of 1 / d^2 where a path collides, d being the distance to `light`: by 20,000 steps along the segment, as far
/// as a twentieth of the paths come.
double varied(double sigma, double length, Vec3d light) {
  constexpr int n = 20'000;
  double mean = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double t = length * (i + 0.5) / n, z = -1 + t - light.z;
    if (sigma * t > std::log(20)) break;
    const double collides = sigma * std::exp(-sigma * t) * length / n, E = 1 / (light.x * light.x + light.y * light.y + z * z);
    mean += collides * E, squares += collides * E * E;
  }
  return squares / (mean * mean);
}

TEST_CASE("collisions suffice where what they find varies little") {
  int sufficed = 0, not_sufficed = 0;
  for (const double x : {0.05, 0.2, 0.6, 2.0, 10.0}) {
    for (const double z : {-1.5, -0.8, 0.1, 1.2, 4.0}) {
      Asked asked("LightSource \"point\" \"point3 from\" [" + std::to_string(x) + " 0 " + std::to_string(z) + "]\n");
      for (const float sigma : {0.1f, 0.35f, 0.8f, 2.0f, 6.0f}) {
        const double truth = varied(sigma, 2, {x, 0, z});
        INFO(x, " ", z, " ", sigma, ": ", truth);
        if (truth < 2.5 / 1.25) CHECK(asked.suffice(sigma, 2, by_default(), 0));
        if (truth > 2.5 * 1.25) CHECK_FALSE(asked.suffice(sigma, 2, by_default(), 0));
        (truth < 2.5 ? sufficed : not_sufficed) += std::abs(std::log(truth / 2.5)) > std::log(1.25);
      }
    }
  }
  CHECK(sufficed > 30);
  CHECK(not_sufficed > 30);
}

TEST_CASE("where all lights are at infinity collisions suffice if many paths collide") {
  for (const int bounce : {0, 1}) {
    CHECK(Asked(kSun).suffice(0.3f, 2, by_default(), bounce));  // 1 / (1 - exp(-0.6)) is 2.2
    CHECK_FALSE(Asked(kSun).suffice(0.2f, 2, by_default(), bounce));
  }
  CHECK_FALSE(Asked(std::string(kSun) + "LightSource \"point\" \"point3 from\" [0.05 0 0]\n").suffice(2));
}

TEST_CASE("collisions suffice on later segments through grids, however thin") {
  CHECK(Asked(kSun).suffice_in_grid(0.01f, 1));
  CHECK_FALSE(Asked(kSun).suffice_in_grid(0.01f, 0));
  CHECK(Asked("LightSource \"point\" \"point3 from\" [0.05 0 0]\n").suffice_in_grid(0.01f, 1));
}

TEST_CASE("where fog is in the grid as well, later segments are asked like any other") {
  Asked near("LightSource \"point\" \"point3 from\" [0.05 0 0]\n");
  for (const int bounce : {0, 1}) {
    CHECK_FALSE(near.suffice_in_both(0.2f, bounce));
    CHECK(Asked(kSun).suffice_in_both(2, bounce));
    CHECK_FALSE(Asked(kSun).suffice_in_both(0.1f, bounce));
  }
}

TEST_CASE("a segment without end is near every light but those at infinity") {
  CHECK(Asked(kSun).suffice(1, kInfinity));
  CHECK_FALSE(Asked(kPoint).suffice(1, kInfinity));
}

TEST_CASE("among many lights the nearest one counts, up to where the media are opaque") {
  const std::string place =
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\"\nAttributeBegin\nMaterial \"interface\"\n"
      "MediumInterface \"m\" \"\"\nShape \"sphere\" \"float radius\" 2\nAttributeEnd\n";
  const auto point = [](const std::string& at) { return "LightSource \"point\" \"point3 from\" [" + at + "]\n"; };
  const std::string beside = point("0.9 0 -1") + point("-0.9 0 1");
  CHECK(Asked(place + beside).suffice(5, 2, by_default(), 0));
  CHECK_FALSE(Asked(place + beside).suffice(0.2f, 2, by_default(), 0));  // few collide
  CHECK_FALSE(Asked(place + beside + point("0 0.05 -0.8")).suffice(5, 2, by_default(), 0));
  CHECK(Asked(place + beside + point("0 0.05 0.8")).suffice(5, 2, by_default(), 0));  // behind what is opaque
}

TEST_CASE("of a ray in media its segment to the end of their boxes counts") {
  Asked sun(kSun), point(kPoint);
  for (const float sigma : {0.02f, 0.2f, 2.0f}) {
    for (const float length : {2.0f, 20.0f}) {
      CHECK(sun.suffice_inside(sigma, length) == sun.suffice(sigma, length));
      CHECK(point.suffice_inside(sigma, length) == point.suffice(sigma, length));
      CHECK(sun.suffice_inside(sigma, length) == (sigma * length > 0.6f));
    }
  }
}

TEST_CASE("methods that are asked for are not replaced, nor the many pairs of single scattering") {
  Asked sun(kSun);
  RenderSettings profile = by_default(), closest = by_default(), direct = by_default();
  profile.distance = DistanceStrategy::profile;
  closest.media = MediaStrategy::closest;
  direct.max_depth = 1;
  CHECK_FALSE(sun.suffice(2, 2, profile));
  CHECK_FALSE(sun.suffice(2, 2, closest));
  CHECK_FALSE(sun.suffice(2, 2, direct, 0));
  CHECK(sun.suffice(2, 2, by_default(), 0));
}

}  // namespace
}  // namespace tyndall
