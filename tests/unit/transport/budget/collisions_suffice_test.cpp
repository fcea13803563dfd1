#include "transport/budget/collisions_suffice.h"

#include <doctest/doctest.h>

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

  bool suffice_in(const ParticipatingMedium& medium, float length, const RenderSettings& settings, int bounce) {
    const float unit = world_.parts().unit;
    Span span;
    span.ray = {world_.parts().to_user.inverse().point({0, 0, -1}), {0, 0, 1}};
    span.t_end = length / unit;
    for (const auto& [t0, t1] : {std::pair{0.0f, 0.5f}, {0.5f, length}}) {
      SpanPart& part = span.parts.emplace_back();
      part.t0 = t0 / unit;
      part.t1 = t1 / unit;
      part.media.push_back(&medium);
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
constexpr const char* kPointWithin = "LightSource \"point\" \"point3 from\" [0.5 0 0]\n";

TEST_CASE("collisions suffice in dense segments, all lights far from them") {
  CHECK(Asked(kSun).suffice(2));
  CHECK_FALSE(Asked(kSun).suffice(0.9f));
  CHECK(Asked(kPoint).suffice(2));
  CHECK_FALSE(Asked(kPoint).suffice(2, 20));  // beside it now
  CHECK_FALSE(Asked(kPointWithin).suffice(2));
  CHECK_FALSE(Asked(std::string(kSun) + kPoint + kPointWithin).suffice(2));
  CHECK(Asked("Translate 0 0 30\nAreaLightSource \"diffuse\"\nShape \"sphere\" \"float radius\" 10\n").suffice(2));
  CHECK_FALSE(Asked("Translate 0 0 11\nAreaLightSource \"diffuse\"\nShape \"sphere\" \"float radius\" 10\n").suffice(2));
}

TEST_CASE("collisions suffice on later segments through grids, however thin, all lights far from them") {
  CHECK(Asked(kSun).suffice_in_grid(0.01f, 1));
  CHECK_FALSE(Asked(kSun).suffice_in_grid(0.01f, 0));
  CHECK_FALSE(Asked(kPointWithin).suffice_in_grid(0.01f, 1));
}

TEST_CASE("a segment without end is near every light but those at infinity") {
  CHECK(Asked(kSun).suffice(1, kInfinity));
  CHECK_FALSE(Asked(kPoint).suffice(1, kInfinity));
}

TEST_CASE("collisions suffice after the first bounce in media that are all but opaque among the lights") {
  const std::string point = "LightSource \"point\" \"point3 from\" ";
  Asked pair(point + "[0.5 0 -1]\n" + point + "[0.5 0 9]\n");
  const RenderSettings settings = by_default();
  CHECK(pair.suffice(1, 9, settings, 1));
  CHECK_FALSE(pair.suffice(1, 9, settings, 0));
  CHECK_FALSE(pair.suffice(1, 7, settings, 1));      // a surface stands there
  CHECK_FALSE(pair.suffice(0.7f, 90, settings, 1));  // what is beyond the lights does not count
  CHECK_FALSE(pair.suffice(0.7f, kInfinity, settings, 1));
  CHECK(pair.suffice(1, kInfinity, settings, 1));
  CHECK(pair.suffice_inside(1, 9));
  CHECK_FALSE(pair.suffice_inside(0.7f, 90));
}

TEST_CASE("collisions suffice in dense segments that no light comes close to before they are opaque") {
  const std::string place =
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\"\nAttributeBegin\nMaterial \"interface\"\n"
      "MediumInterface \"m\" \"\"\nShape \"sphere\" \"float radius\" 2\nAttributeEnd\n";
  const auto point = [](const std::string& at) { return "LightSource \"point\" \"point3 from\" [" + at + "]\n"; };
  const std::string beside = point("0.5 0 -1") + point("-0.5 0 1");
  Asked aside(place + beside);
  CHECK(aside.suffice(5, 2, by_default(), 0));
  CHECK_FALSE(aside.suffice(0.9f, 2, by_default(), 0));       // few collide
  CHECK_FALSE(aside.suffice(1.2f, 2, by_default(), 0));       // within what is not opaque, a light is close
  CHECK_FALSE(aside.suffice(0.45f, 2, by_default(), 1));      // later, fewer are enough,
  CHECK(aside.suffice(0.6f, 2, by_default(), 1));             // and lights may be closer
  CHECK_FALSE(aside.suffice(5, kInfinity, by_default(), 0));  // places to ask at would be infinitely far apart
  CHECK_FALSE(Asked(place + beside + point("0 0.05 -0.8")).suffice(5, 2, by_default(), 0));
  CHECK(Asked(place + beside + point("0 0.05 0.8")).suffice(5, 2, by_default(), 0));  // behind what is opaque
  CHECK_FALSE(Asked(beside).suffice(5, 2, by_default(), 0));                          // no medium of the world has bounds
}

TEST_CASE("of a ray in media, its segment to the end of their boxes counts") {
  Asked sun(kSun), point(kPoint);
  for (const float sigma : {0.2f, 2.0f}) {
    for (const float length : {2.0f, 20.0f}) {
      CHECK(sun.suffice_inside(sigma, length) == (sigma * length > 2));
      CHECK(point.suffice_inside(sigma, length) == (sigma * length > 2 && length == 2));
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
