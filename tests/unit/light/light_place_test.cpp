/// The lit part of a ray: no light arrives outside of it, and inside hardly any place is dark.
#include "light/light_place.h"

#include <doctest/doctest.h>

#include "light/lights.h"
#include "light_cases.h"

namespace tyndall {
namespace {

Shape emissive(decltype(Shape::kind) kind, const Transform& to_world, bool two_sided = false) {
  Shape s;
  s.kind = std::move(kind);
  s.to_world = to_world;
  s.emission = AreaLight{};
  s.emission->L = Rgb(1);
  s.emission->two_sided = two_sided;
  return s;
}

/// Flat ones, curved ones and spots, of sizes about 1, in a scene that is `scale` times as large and lies off the origin.
struct Case {
  std::vector<Shape> shapes;
  Scene scene;
  Transform placed;

  explicit Case(float scale) {
    const Transform turned = Transform::rotate(77, 1, 2, -3);
    placed = Transform::scale(scale, scale, scale) * Transform::translate(2, -1, 3);
    const TriangleMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {0, 1, 2}};
    const TriangleMesh sliver{{{0, 0, 0}, {1, 0, 0}, {2, 1e-5f, 0}}, {}, {}, {0, 1, 2}};
    const auto add = [&](decltype(Shape::kind) kind, Transform t = {}, bool two_sided = false) {
      shapes.push_back(emissive(std::move(kind), placed * turned * t, two_sided));
    };
    add(triangle);
    add(triangle, Transform::scale(1, -1, 1));
    add(triangle, {}, true);
    add(sliver, Transform::translate(0, 0, 1));
    add(BilinearMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {}, {}, {0, 1, 2, 3}});
    add(BilinearMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}, {}, {}, {0, 1, 2, 3}});
    add(Disk{0.5f, 0.7f, 0.1f, 200}, Transform::scale(1, 2, 0.1));
    shapes.back().reverse_orientation = true;
    add(Sphere{.radius = 0.4f, .z_min = -0.4f, .z_max = 0.4f});
    for (const float cone : {1e-4f, 0.3f, 5.0f, 30.0f, 80.0f, 89.9f, 120.0f}) {
      Light light;
      light.kind = SpotLight{placed * turned * Transform::rotate(cone, 0, 1, 0), Rgb(1), cone, 0.8f * cone};
      scene.lights.push_back(light);
    }
    Light distorted;
    distorted.kind = SpotLight{placed * Transform::scale(1, 3, 0.5), Rgb(1), 20, 10};
    scene.lights.push_back(distorted);
  }

  Lights build() const {
    std::vector<EmitterShape> emitters;
    for (const Shape& s : shapes) emitters.push_back({&s, s.to_world});
    return build_lights(scene, emitters, {{-10, -10, -10}, {10, 10, 10}});
  }
};

/// Through a place near the light: within its size, far off, or along what it faces.
Ray ray_near(const LightPlace& light, float scale, Rng& rng) {
  const float size = scale * std::exp(6 * rng.uniform() - 4);
  const Vec3 through = *light.center + test::random_direction(rng) * size;
  const Vec3 axis = light.flat() ? light.normal : light.beam.axis;
  const Vec3 d = rng.uniform() < 0.3f ? normalize(axis + test::random_in_cube(rng, 0.05f)) : test::random_direction(rng);
  return {through - d * (size * 3 * rng.uniform()), d};
}

TEST_CASE("light arrives on the lit part of a ray only, which is dark hardly anywhere") {
  for (const float scale : {0x1p-20f, 1.0f, 0x1p20f}) {
    const Case c(scale);
    const Lights lights = c.build();
    Rng rng(5);
    for (LightId id = 0; id < lights.size(); ++id) {
      CAPTURE(scale);
      CAPTURE(id);
      const LightPlace place = lights.place(id);
      const bool everywhere = !place.flat() && place.beam.full();
      int lit = 0, dark_inside = 0, inside = 0;
      for (int i = 0; i < 20'000; ++i) {
        const Ray ray = ray_near(place, scale, rng);
        const float t = 4 * rng.uniform() * length(*place.center - ray.o), x = rng.uniform(), y = rng.uniform();
        const RayPart part = lit_part(place, ray);
        const bool within = part.begin <= t && t <= part.end;
        const auto sample = lights.sample(id, ray.at(t), {x, y});
        const bool arrives = sample && !is_black(sample->L);
        REQUIRE((within || !arrives));
        lit += arrives;
        inside += within;
        dark_inside += within && !arrives;
      }
      if (everywhere) CHECK(inside == 20'000);
      // By the margins; the narrowest beams are within theirs. Wide ones and those of distorted spots are not told apart.
      if (place.flat()) CHECK(dark_inside <= inside / 200);
      if (place.beam.theta > 0.05f && place.beam.theta < 1.5f) CHECK(dark_inside <= inside / 20);
      if (place.beam.theta > 0.05f || place.flat()) CHECK(lit > 200);
    }
  }
}

TEST_CASE("the lit part of rays in, across, along and away from planes and beams") {
  const LightPlace flat{.center = Vec3(0, 0, 1), .radius = 1e-6f, .normal = {0, 0, 1}};
  CHECK(lit_part(flat, {{5, 0, 0}, {0, 0, 1}}).begin == doctest::Approx(1).epsilon(1e-4));
  CHECK(lit_part(flat, {{5, 0, 3}, {0, 0, -1}}).end == doctest::Approx(2).epsilon(1e-4));
  CHECK(lit_part(flat, {{5, 0, 2}, {1, 0, 0}}).end == kInfinity);
  CHECK(lit_part(flat, {{5, 0, 2}, {1, 0, 0}}).begin == -kInfinity);
  const RayPart behind = lit_part(flat, {{5, 0, 0}, {1, 0, 0}});
  CHECK_FALSE(behind.begin < behind.end);

  const LightPlace spot{.center = Vec3(0, 0, 0), .beam = DirectionCone::around({0, 0, 1}, kPi / 4)};
  const RayPart across = lit_part(spot, {{-5, 0, 2}, {1, 0, 0}});
  CHECK(across.begin == doctest::Approx(3).epsilon(2e-3));
  CHECK(across.end == doctest::Approx(7).epsilon(2e-3));
  const RayPart opposite = lit_part(spot, {{-5, 0, -2}, {1, 0, 0}});
  CHECK_FALSE(opposite.begin < opposite.end);
  const RayPart out = lit_part(spot, {{1, 0, -3}, {0, 0, 1}});
  CHECK(out.begin == doctest::Approx(4).epsilon(2e-3));
  CHECK(out.end == kInfinity);
  const RayPart back = lit_part(spot, {{1, 0, 9}, {0, 0, -1}});
  CHECK(back.begin == -kInfinity);
  CHECK(back.end == doctest::Approx(8).epsilon(2e-3));
  const RayPart through = lit_part(spot, {{0, 0, -3}, {0, 0, 1}});
  CHECK(through.begin == doctest::Approx(3).epsilon(2e-3));
  CHECK(lit_part({}, {{1, 2, 3}, {0, 0, 1}}).begin == -kInfinity);  // a sky
}

}  // namespace
}  // namespace tyndall
