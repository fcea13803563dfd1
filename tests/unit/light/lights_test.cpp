#include "light/lights.h"

#include <doctest/doctest.h>

#include "environment_maps.h"
#include "light_cases.h"
#include "math/vec3d.h"
#include "texture/textures.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

Shape emissive(decltype(Shape::kind) kind, Rgb L, const Transform& t = {}) {
  Shape s;
  s.kind = std::move(kind);
  s.to_world = t;
  s.emission = AreaLight{};
  s.emission->L = L;
  return s;
}

TriangleMesh quad(float half, float z) {
  return {{{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}},
          {},
          {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
          {0, 1, 2, 0, 2, 3}};
}

/// Lights of shapes alone, each placed by its own transform.
Lights lights_of(const std::vector<Shape>& shapes, const LightBuildOptions& options = {}) {
  std::vector<EmitterShape> placed;
  for (const Shape& s : shapes) placed.push_back({&s, s.to_world});
  return build_lights({}, placed, {{-10, -10, -10}, {10, 10, 10}}, options);
}

const LightSelector& selector_of(const Lights& lights) { return lights.selector(lights.selectors()[0].strategy); }

/// Irradiance at p facing n from all lights, without occlusion.
double irradiance(const Lights& lights, Vec3 p, Vec3 n, int samples, std::uint64_t seed = 1) {
  Rng rng(seed);
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const auto s = selector_of(lights).select(PointQuery{p, n}, rng.uniform_wide());
    const float x = rng.uniform(), y = rng.uniform();
    if (!s) continue;
    if (const auto l = lights.sample(s->light, p, {x, y}))
      sum += mean(l->L) * std::max(0.0f, dot(n, l->wi)) / (double(l->pdf) * s->pmf);
  }
  return sum / samples;
}

TEST_CASE("irradiance of emitters with a closed form") {
  // Whole sphere: pi L R^2 / d^2 toward its centre. Disk: pi L R^2 / (R^2 + h^2) on its axis.
  const Transform moved = Transform::translate(1, -2, 3) * Transform::rotate(60, 1, 1, 0) * Transform::scale(0.5, 0.5, 0.5);
  const Vec3 center{1, -2, 3}, p = center + Vec3{0, 3, 4} * 0.4f;
  const double d = 2.0;
  CHECK(irradiance(lights_of({emissive(Sphere{}, Rgb(3), moved)}), p, normalize(center - p), 20'000) ==
        doctest::Approx(kPi * 3 * 0.25 / (d * d)).epsilon(2e-3));
  CHECK(irradiance(lights_of({emissive(Disk{0, 2, 0, 360}, Rgb(3), Transform::rotate(180, 1, 0, 0))}), {0, 0, -1.5f}, {0, 0, 1},
                   100'000) == doctest::Approx(kPi * 3 * 4 / (4 + 2.25)).epsilon(6e-3));

  // Under a corner of an a x b rectangle at height h: (L/2)(A atan B + C atan D), A = a/sqrt(a^2+h^2), B = b/sqrt(a^2+h^2), ...
  const double a = 2, b = 1.5, h = 0.8, ra = std::sqrt(a * a + h * h), rb = std::sqrt(b * b + h * h);
  const double expected = 0.5 * 3 * (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb));
  const BilinearMesh rectangle{{{0, 0, 0}, {2, 0, 0}, {0, 1.5f, 0}, {2, 1.5f, 0}}, {}, {}, {0, 1, 2, 3}};
  const TriangleMesh triangles{{{0, 0, 0}, {2, 0, 0}, {0, 1.5f, 0}, {2, 1.5f, 0}}, {}, {}, {0, 1, 2, 2, 1, 3}};
  CHECK(irradiance(lights_of({emissive(rectangle, Rgb(3))}), {0, 0, 0.8f}, {0, 0, -1}, 60'000) ==
        doctest::Approx(expected).epsilon(5e-3));
  for (const LightStrategy s : {LightStrategy::uniform, LightStrategy::power, LightStrategy::tree, LightStrategy::tree_binary,
                                LightStrategy::cycles_rule, LightStrategy::lightcuts, LightStrategy::cells})
    CHECK(irradiance(lights_of({emissive(triangles, Rgb(3))}, {{s}}), {0, 0, 0.8f}, {0, 0, -1}, 100'000) ==
          doctest::Approx(expected).epsilon(8e-3));
}

TEST_CASE("an ellipsoid's irradiance is the integral over the directions that meet it") {
  const Transform t = Transform::translate(0.5, 0, 4) * Transform::rotate(30, 1, 0, 0) * Transform::scale(0.3, 1.2, 0.7);
  const Transform to_object = t.inverse();
  double expected = 0;
  constexpr int kSteps = 1500;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double z = (i + 0.5) / kSteps, phi = 2 * kPi * (j + 0.5) / kSteps, r = std::sqrt(1 - z * z);
      const Vec3d o(to_object.point({})), w(to_object.vector({float(r * std::cos(phi)), float(r * std::sin(phi)), float(z)}));
      const double a = dot(w, w), half_b = dot(o, w), c = dot(o, o) - 1;
      if (half_b < 0 && half_b * half_b > a * c) expected += 5 * z * 2 * kPi / (double(kSteps) * kSteps);
    }
  CHECK(irradiance(lights_of({emissive(Sphere{}, Rgb(5), t)}), {0, 0, 0}, {0, 0, 1}, 300'000) ==
        doctest::Approx(expected).epsilon(5e-3));
}

TEST_CASE("ids run through the scene's lights, then the primitives of the shapes in order") {
  Scene scene;
  scene.lights = {{PointLight{{0, 0, 5}, Rgb(1)}, {}},
                  {InfiniteLight{}, {}},
                  {DistantLight{{0, 0, -1}, Rgb(2)}, {}},
                  {SpotLight{{}, Rgb(1), 30, 25}, {}}};
  const std::vector<Shape> shapes{emissive(quad(1, 0), Rgb(1)), emissive(Sphere{}, Rgb(2)), emissive(quad(1, 3), Rgb(0))};
  const std::vector<EmitterShape> placed{{&shapes[0], {}}, {&shapes[1], Transform::translate(5, 0, 0)}, {&shapes[2], {}}};
  const Lights lights = build_lights(scene, placed, {{-1, -1, -1}, {1, 1, 1}});
  CHECK(lights.size() == 9);
  CHECK(lights.first_light(0) == 4);
  CHECK(lights.first_light(1) == 6);
  CHECK(lights.first_light(2) == 7);
  REQUIRE(lights.infinite().size() == 1);
  CHECK(lights.infinite()[0] == 1);
  CHECK(lights.environment(1, {{}, {0, 0, 1}}) == Rgb(1));
  CHECK(lights.stats().emitters == 5);
  CHECK(lights.stats().dark == 2);
  CHECK(lights.power(0) == doctest::Approx(4 * kPi));
  CHECK(lights.power(1) == doctest::Approx(4 * kPi * kPi * 3));
  CHECK(lights.power(2) == doctest::Approx(2 * kPi * 3));
  CHECK(lights.power(4) == doctest::Approx(2 * kPi));
  CHECK(lights.power(6) == doctest::Approx(2 * 4 * kPi * kPi));
  // Black lights keep their ids, are never chosen and give nothing.
  CHECK(selector_of(lights).pmf(PointQuery{{0, 0, 1}, {}}, 7) == 0);
  CHECK(!lights.sample(7, {0, 0, 5}, {0.3f, 0.3f}));
  CHECK(is_black(lights.emitted(8, {{0, 0, 3}, {0, 0, 1}, {}, 1}, {0, 0, 1})));
  // Only surfaces have a density for hits.
  CHECK(lights.pdf(0, {0, 0, 1}, {{0, 0, 5}, {0, 0, 1}, {}, 4}) == 0);
  CHECK(lights.pdf(6, {0, 0, 0}, {{4, 0, 0}, {-1, 0, 0}, {}, 4}) > 0);
  CHECK(Lights().empty());
  CHECK(!selector_of(lights_of({})).select(PointQuery{}, 0.5));
}

TEST_CASE("suns come the brightest first, and apart from the sky's even light") {
  Scene scene;
  scene.lights = {{DistantLight{{0, 0, -1}, Rgb(2)}, {}},
                  {PointLight{{0, 0, 5}, Rgb(1)}, {}},
                  {InfiniteLight{}, {}},
                  {DistantLight{{-1, 0, 0}, Rgb(5)}, {}},
                  {DistantLight{{0, 1, 0}, Rgb(0)}, {}}};
  const Lights lights = build_lights(scene, {}, {{-1, -1, -1}, {1, 1, 1}});
  const Lights::Far& far = lights.far();
  REQUIRE(far.suns.size() == 2);
  CHECK(far.suns[0].directions.axis == Vec3{1, 0, 0});
  CHECK(far.suns[0].fluence == doctest::Approx(5));
  CHECK(far.suns[1].fluence == doctest::Approx(2));
  CHECK(far.rest == doctest::Approx(4 * kPi));
  CHECK(Lights().far().suns.empty());
}

TEST_CASE("the power of near lights does not vanish beside a sun's") {
  Scene scene;
  scene.lights = {{DistantLight{{0, 0, -1}, Rgb(1e20f)}, {}}, {PointLight{{0, 0, 5}, Rgb(1)}, {}}};
  const Lights lights = build_lights(scene, {}, {{-1, -1, -1}, {1, 1, 1}});
  CHECK(lights.near_power() == doctest::Approx(4 * kPi));
}

TEST_CASE("one-sided emitters emit to the side of their normal, two-sided ones on both") {
  std::vector<Shape> shapes{emissive(quad(1, 0), Rgb(1))};
  const Vec3 above{0.1f, 0.2f, 1}, below{0.1f, 0.2f, -1};
  const EmitterHit hit{{0, 0, 0}, {0, 0, 1}, {0.5f, 0.5f}, 1};
  const auto lights_up = [&](const Lights& l, Vec3 p) {
    return l.sample(0, p, {0.4f, 0.4f}) && selector_of(l).pmf(PointQuery{p, {}}, 0) > 0;
  };
  const Lights one = lights_of(shapes);
  CHECK(lights_up(one, above));
  CHECK(!lights_up(one, below));
  CHECK(one.emitted(0, hit, {0, 0, 1}) == Rgb(1));
  CHECK(is_black(one.emitted(0, hit, {0, 0, -1})));
  shapes[0].reverse_orientation = true;
  CHECK(lights_up(lights_of(shapes), below));
  CHECK(!lights_up(lights_of(shapes), above));
  shapes[0].reverse_orientation = false;
  shapes[0].to_world = Transform::scale(-1, 1, 1);  // the mirrored winding is turned back
  CHECK(lights_up(lights_of(shapes), above));
  shapes[0].emission->two_sided = true;
  const Lights two = lights_of(shapes);
  CHECK(lights_up(two, above));
  CHECK(lights_up(two, below));
  CHECK(two.emitted(0, hit, {0, 0, -1}) == Rgb(1));
  CHECK(two.power(0) == doctest::Approx(2 * one.power(0)));
}

TEST_CASE("power is what each primitive emits, as pbrt has it") {
  std::vector<Shape> shapes{emissive(quad(0.6f, 3), Rgb(1))};
  shapes[0].emission->power = 40;
  const Lights lights = lights_of(shapes);
  CHECK(lights.power(0) == doctest::Approx(40));
  CHECK(lights.power(1) == doctest::Approx(40));
  CHECK(lights.emitted(0, {{0, 0, 3}, {0, 0, 1}, {}, 1}, {0, 0, 1}).g == doctest::Approx(40 / (kPi * 0.72)));
}

TEST_CASE("an emission image lies over uv with v upward") {
  const test::ScratchMap map("emission", 2, 2, [](int x, int y) { return Rgb(float(1 + x), float(1 + y), 4); });
  std::vector<Shape> shapes{emissive(quad(1, 0), {1, 2, 1})};
  shapes[0].emission->path = map.path();
  const Lights lights = lights_of(shapes);
  const auto at = [&](Vec2 uv) { return lights.emitted(0, {{}, {0, 0, 1}, uv, 1}, {0, 0, 1}); };
  CHECK(at({0.1f, 0.9f}) == Rgb(1, 2, 4));  // top left
  CHECK(at({0.9f, 0.1f}) == Rgb(2, 4, 4));  // bottom right
  CHECK(lights.power(0) == doctest::Approx(kPi * 2 * (1.5 + 3 + 4) / 3));
  const auto s = lights.sample(1, {0, 0, 2}, {0.5f, 0.5f});
  REQUIRE(s);
  const Vec3 x = Vec3{0, 0, 2} + s->wi * s->distance;
  CHECK(s->L.r == doctest::Approx(at({(x.x + 1) / 2, (x.y + 1) / 2}).r).epsilon(1e-3));
  shapes[0].emission->path = "no such file.exr";
  shapes[0].where = {"a.pbrt", 7, 1};
  CHECK_THROWS_WITH_AS(lights_of(shapes), doctest::Contains("a.pbrt:7:1"), Error);
}

TEST_CASE("alpha dims an emitter's samples, and at 0 hides the surface but not its light") {
  std::vector<Shape> shapes{emissive(quad(1, 0), Rgb(2))};
  shapes[0].alpha = 0;
  const auto sample = [&](float alpha) {
    const Textures textures = build_textures({Texture{ConstantTexture{Rgb(alpha)}, {}}});
    const Lights lights = lights_of(shapes, {{LightStrategy::tree_binary}, &textures});
    return lights.sample(0, {0, 0, 1}, {0.5f, 0.4f});
  };
  const auto opaque = sample(1), half = sample(0.5f), hidden = sample(0);
  REQUIRE((opaque && half && hidden));
  CHECK(opaque->L.r == 2);
  CHECK(half->L.r == 1);
  CHECK(!half->delta);
  CHECK(hidden->delta);
  CHECK(hidden->L.r == doctest::Approx(2 / opaque->pdf));
}

TEST_CASE("an emitter's alpha may depend on the normal") {
  std::vector<Shape> shapes{emissive(quad(1, 0), Rgb(2))};
  shapes[0].alpha = 0;
  const Textures textures = build_textures(
      {{DirectionMixTexture{1, 2, {0, 0.6f, 0.8f}}, {}}, {ConstantTexture{Rgb(1)}, {}}, {ConstantTexture{Rgb(0)}, {}}});
  const auto sample = lights_of(shapes, {{LightStrategy::tree_binary}, &textures}).sample(0, {0, 0, 1}, {0.5f, 0.4f});
  REQUIRE(sample);
  CHECK(sample->L.r == doctest::Approx(2 * 0.8f));
}

TEST_CASE("lights with infinite or missing strength are refused with their place") {
  Scene scene;
  scene.lights = {{PointLight{{}, Rgb(kInfinity)}, {"a.pbrt", 2, 3}}};
  CHECK_THROWS_WITH_AS(build_lights(scene, {}, {}), doctest::Contains("a.pbrt:2:3"), Error);
  std::vector<Shape> shapes{emissive(Sphere{}, {1, std::nanf(""), 0})};
  shapes[0].where = {"b.pbrt", 4, 5};
  CHECK_THROWS_WITH_AS(lights_of(shapes), doctest::Contains("b.pbrt:4:5"), Error);
}

TEST_CASE("exhaustive: every light has pmf 1") {
  const Lights lights = lights_of({emissive(quad(1, 0), Rgb(1))}, {{LightStrategy::exhaustive}});
  CHECK(selector_of(lights).exhaustive());
  CHECK(selector_of(lights).pmf(PointQuery{}, 1) == 1);
  CHECK_THROWS_AS(lights.selector(LightStrategy::power), Error);
}

/// A scene with every kind of light, among them dark, degenerate and mirrored ones.
struct Zoo {
  Zoo() : map("zoo", 16, 16, [](int x, int y) { return Rgb(x == 3 && y == 5 ? 500.0f : 0.1f * y); }) {
    Rng rng(31);
    scene.lights = {{PointLight{{2, 2, 2}, {1, 2, 3}}, {}},
                    {PointLight{{2, 2, 2}, Rgb(0)}, {}},
                    {SpotLight{Transform::translate(-2, 0, 2) * Transform::scale(1, 2, 1), Rgb(4), 50, 10}, {}},
                    {DistantLight{{0.2f, 0.3f, -1}, Rgb(1)}, {}},
                    {InfiniteLight{}, {}}};
    InfiniteLight infinite;
    infinite.path = map.path();
    infinite.to_world = Transform::rotate(77, 1, 2, 0);
    scene.lights.push_back({infinite, {}});
    shapes = {emissive(quad(0.5f, -2), Rgb(3)),
              emissive(Sphere{0.4f, -0.4f, 0.4f, 360}, Rgb(1), Transform::translate(0, 3, 0)),
              emissive(Sphere{0.4f, -0.1f, 0.4f, 200}, Rgb(1), Transform::translate(0, -3, 0) * Transform::scale(-1, 2, 0.5)),
              emissive(Disk{}, Rgb(1), Transform::translate(3, 0, -1)),
              emissive(Cylinder{0.2f, 0, 2, 360}, Rgb(2)),
              emissive(TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}, {}, {0, 1, 2}}, Rgb(1)),
              emissive(BilinearMesh{{{4, 0, 0}, {5, 0, 1}, {4, 1, 0}, {5, 1, -1}}, {}, {}, {0, 1, 2, 3}}, Rgb(1))};
    shapes[4].emission->two_sided = true;
    TriangleMesh soup;
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = test::random_in_cube(rng, 3);
      for (int k = 0; k < 3; ++k) {
        soup.indices.push_back(static_cast<std::uint32_t>(soup.positions.size()));
        soup.positions.push_back(p + test::random_in_cube(rng, 0.1f));
      }
    }
    shapes.push_back(emissive(soup, {1, 0, 0.5f}));
  }
  Lights build(LightStrategy strategy) const {
    std::vector<EmitterShape> placed;
    for (const Shape& s : shapes) placed.push_back({&s, s.to_world});
    return build_lights(scene, placed, {{-5, -5, -5}, {5, 5, 5}}, {{strategy}});
  }
  test::ScratchMap map;
  Scene scene;
  std::vector<Shape> shapes;
};

TEST_CASE("all kinds together: no light of probability 0 contributes, and none that is chosen lacks a probability") {
  const Zoo zoo;
  const Lights lights = zoo.build(LightStrategy::tree_binary);
  Rng rng(17);
  std::size_t zero = 0;
  for (int i = 0; i < 3000; ++i) {
    PointQuery q{test::random_in_cube(rng, 4), test::random_direction(rng), rng.uniform() < 0.2f};
    if (i % 4 == 0) q.n = {};
    double sum = 0;
    for (LightId id = 0; id < lights.size(); ++id) {
      const float pmf = selector_of(lights).pmf(q, id);
      sum += pmf;
      if (pmf > 0) continue;
      ++zero;
      const float x = rng.uniform(), y = rng.uniform();
      const auto s = lights.sample(id, q.p, {x, y});
      const bool received = s && (length_squared(q.n) == 0 || q.transmissive || dot(q.n, s->wi) > 0);
      REQUIRE_MESSAGE(!received, "light ", id);
    }
    REQUIRE(sum < 1 + 1e-5);
    const double u = rng.uniform_wide();
    if (const auto s = selector_of(lights).select(q, u))
      REQUIRE(selector_of(lights).pmf(q, s->light) == doctest::Approx(s->pmf).epsilon(1e-6));
  }
  CHECK(zero > 100'000);
}

TEST_CASE("even skies alone are not worth seeking: a scattered ray that finds them has all of their light") {
  CHECK(!Lights().sought());
  CHECK(lights_of({emissive(Disk{0, 2, 0, 360}, Rgb(3))}).sought());
  CHECK(Zoo().build(LightStrategy::tree).sought());
  const auto sky = [](const std::string& path) {
    Scene scene;
    scene.lights = {{InfiniteLight{}, {}}};
    InfiniteLight light;
    light.path = path;
    scene.lights.push_back({light, {}});
    return build_lights(scene, {}, {{-1, -1, -1}, {1, 1, 1}});
  };
  const test::ScratchMap even("even", 8, 8, [](int, int) { return Rgb(3); });
  const test::ScratchMap spotted("spotted", 8, 8, [](int x, int y) { return Rgb(x == 3 && y == 4 ? 9 : 3); });
  CHECK(!sky(even.path()).sought());
  CHECK(sky(spotted.path()).sought());
}

TEST_CASE("all kinds together: every strategy gives the same irradiance") {
  const Zoo zoo;
  const Lights exhaustive = zoo.build(LightStrategy::exhaustive);
  Rng rng(5);
  int lit = 0;
  for (int k = 0; k < 6; ++k) {
    const Vec3 p = test::random_in_cube(rng, 4), n = test::random_direction(rng);
    double expected = 0, expected_variance = 0;
    for (LightId id = 0; id < exhaustive.size(); ++id) {
      const int samples = id < 10 ? 20'000 : 1000;
      double first = 0, second = 0;
      for (int i = 0; i < samples; ++i) {
        const float x = rng.uniform(), y = rng.uniform();
        const auto l = exhaustive.sample(id, p, {x, y});
        const double value = l ? mean(l->L) * std::max(0.0f, dot(n, l->wi)) / double(l->pdf) : 0;
        first += value / samples;
        second += value * value / samples;
      }
      expected += first;
      expected_variance += (second - first * first) / samples;
    }
    lit += expected > 0;
    for (const LightStrategy s : {LightStrategy::uniform, LightStrategy::power, LightStrategy::tree, LightStrategy::tree_binary,
                                  LightStrategy::cycles_rule, LightStrategy::lightcuts, LightStrategy::cells}) {
      const Lights lights = zoo.build(s);
      double sum = 0, sum2 = 0;
      constexpr int kBatches = 20;
      for (int b = 0; b < kBatches; ++b) {
        const double e = irradiance(lights, p, n, 4000, rng.next());
        sum += e / kBatches;
        sum2 += e * e / kBatches;
      }
      const double error = std::sqrt(std::max(0.0, sum2 - sum * sum) / (kBatches - 1) + expected_variance);
      CAPTURE(name_of(s));
      CHECK(std::abs(sum - expected) <= 4 * error);
    }
  }
  CHECK(lit >= 5);  // one place may see only what is left to scattered rays
}

}  // namespace
}  // namespace tyndall
