#include "light/instanced_emitters.h"

#include <doctest/doctest.h>

#include "environment_maps.h"
#include "instanced_cases.h"
#include "segment_cases.h"
#include "texture/textures.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

/// A sheet of 2 n^2 triangles with bumps, over the square from -1 to 1.
TriangleMesh bumpy_sheet(std::uint32_t n, bool with_normals) {
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      const float x = 2.0f * i / n - 1, y = 2.0f * j / n - 1;
      mesh.positions.push_back({x, y, 0.3f * std::sin(3 * x) * std::cos(4 * y)});
      if (with_normals) mesh.normals.push_back({0, 0.1f, -1});
      mesh.uvs.push_back({x, y});
    }
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      for (const std::uint32_t k : {a, b, d, a, d, c}) mesh.indices.push_back(k);
    }
  }
  return mesh;
}

Shape emissive(decltype(Shape::kind) kind, Rgb L) {
  Shape s;
  s.kind = std::move(kind);
  s.emission = AreaLight{};
  s.emission->L = L;
  return s;
}

/// An object of every kind of emissive shape, and instances of it: turned, mirrored, larger and smaller.
struct Stage {
  Scene scene;
  Textures textures;
  test::ScratchMap map{"instanced", 8, 8, [](int x, int y) { return Rgb(1.0f + x, 0.5f * y, x == y ? 3.0f : 0.0f); }};

  explicit Stage(bool with_power = false, std::uint64_t seed = 1) {
    Object& object = scene.objects.emplace_back();
    object.shapes.push_back(emissive(bumpy_sheet(3, false), {2, 1, 0.5f}));
    object.shapes.push_back(emissive(bumpy_sheet(2, true), Rgb(1)));
    object.shapes.back().emission->path = map.path();
    object.shapes.back().to_world = Transform::translate(0, 2, 0) * Transform::scale(-1, 1, 2);
    object.shapes.push_back(emissive(bumpy_sheet(2, true), Rgb(0)));  // dark
    object.shapes.push_back(emissive(Sphere{.radius = 0.4f, .z_min = -0.4f, .z_max = 0.4f}, Rgb(4)));
    object.shapes.back().to_world = Transform::translate(-2, 0, 1) * Transform::scale(1, -1, 1);
    object.shapes.push_back(emissive(Disk{0, 0.7f, 0.1f, 300}, Rgb(3)));
    object.shapes.back().reverse_orientation = true;
    object.shapes.back().to_world = Transform::translate(0, -2, 1) * Transform::rotate(50, 1, 0, 0) * Transform::scale(1, 2, 1);
    object.shapes.push_back(
        emissive(BilinearMesh{{{0, 0, 2}, {1, 0, 2}, {0, 1, 2}, {1, 1.5f, 2.5f}}, {}, {}, {0, 1, 2, 3}}, Rgb(2)));
    object.shapes.back().emission->two_sided = true;
    object.shapes.push_back(emissive(bumpy_sheet(2, false), Rgb(2)));  // seen through holes that stand still in the world
    object.shapes.back().to_world = Transform::translate(3, 0, 0);
    object.shapes.back().alpha = 2;
    object.shapes.back().reverse_orientation = true;
    for (Shape& s : object.shapes)
      if (with_power) s.emission->power = 5;
    scene.textures = {
        {ConstantTexture{Rgb(0.2f)}, {}}, {ConstantTexture{Rgb(0.9f)}, {}}, {CheckerboardTexture{3, {}, 0, 1}, {}}};
    textures = build_textures(scene.textures);
    scene.shapes.push_back(emissive(Sphere{}, Rgb(1)));
    Rng rng(seed);
    for (int i = 0; i < 6; ++i) scene.instances.push_back({0, test::random_similarity(rng, 6)});
  }

  std::vector<EmitterShape> placed(bool shared) const {
    std::vector<EmitterShape> all;
    for (const Shape& s : scene.shapes) all.push_back({&s, s.to_world});
    for (const Instance& i : scene.instances)
      for (const Shape& s : scene.objects[i.object].shapes) all.push_back({&s, i.to_world * s.to_world, shared ? &i : nullptr});
    return all;
  }
  Lights build(bool shared, std::vector<LightStrategy> strategies = {LightStrategy::tree}) const {
    return build_lights(scene, placed(shared), {{-10, -10, -10}, {10, 10, 10}}, {std::move(strategies), &textures});
  }
};

/// The ids of the same light in both.
std::vector<std::pair<LightId, LightId>> same_lights(const Stage& stage, const Lights& a, const Lights& b) {
  std::vector<std::pair<LightId, LightId>> pairs;
  const auto placed = stage.placed(false);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    LightId size = 1;
    if (const auto* mesh = std::get_if<TriangleMesh>(&placed[i].shape->kind))
      size = static_cast<LightId>(mesh->indices.size() / 3);
    for (LightId k = 0; k < size; ++k) pairs.emplace_back(a.first_light(i) + k, b.first_light(i) + k);
  }
  return pairs;
}

double brightness(Rgb c) { return c.r + 2 * c.g + 3 * c.b; }

TEST_CASE("emitters of instances: power, place, samples and densities are those of the same shapes alone") {
  for (const bool with_power : {false, true}) {
    const Stage stage(with_power);
    const Lights shared = stage.build(true), alone = stage.build(false);
    CHECK(shared.size() == alone.size());
    CHECK(shared.stats().shared == shared.size() - 1);
    CHECK(alone.stats().shared == 0);
    CHECK(shared.stats().emitters == alone.stats().emitters);
    CHECK(shared.stats().dark == alone.stats().dark);
    CHECK(shared.stats().power == doctest::Approx(alone.stats().power).epsilon(1e-5));
    const Bounds3& around = alone.near_box();
    for (int k = 0; k < 8; ++k)
      REQUIRE(shared.near_box().contains(around.center() + (around.corner(k) - around.center()) * 0.999f));
    Rng rng(3);
    int lit = 0;
    for (const auto& [s, a] : same_lights(stage, shared, alone)) {
      REQUIRE(around.contains(*alone.place(a).center));
      REQUIRE(shared.power(s) == doctest::Approx(alone.power(a)).epsilon(1e-5));
      const LightPlace at = shared.place(s), there = alone.place(a);
      REQUIRE(length(*at.center - *there.center) <= 0.3f * (at.radius + there.radius));
      for (int i = 0; i < 40; ++i) {
        const Vec3 p = *there.center + test::random_direction(rng) * (0.2f + 6 * rng.uniform());
        const float x = rng.uniform(), y = rng.uniform();
        const auto l = shared.sample(s, p, {x, y});
        if (!l) continue;
        // What the sample says, the other lights say of the point that it hits.
        ++lit;
        REQUIRE(length(l->wi) == doctest::Approx(1).epsilon(1e-6));
        EmitterHit hit{p + l->wi * l->distance, -l->wi, {}, l->distance};
        REQUIRE(shared.pdf(s, p, hit) == doctest::Approx(l->pdf).epsilon(2e-3));
        REQUIRE(alone.pdf(a, p, hit) == doctest::Approx(l->pdf).epsilon(2e-3));
      }
    }
    CHECK(lit > 3000);
  }
}

/// Irradiance from a light at p, by `samples` of it on a grid.
std::array<double, 2> irradiance(const Lights& lights, LightId light, Vec3 p, int side) {
  double sum = 0, samples = 0;
  for (int i = 0; i < side * side; ++i) {
    const auto l = lights.sample(light, p, {(i % side + 0.5f) / side, (i / side + 0.5f) / side});
    if (!l) continue;
    sum += brightness(l->L) / l->pdf;
    samples += 1;
  }
  return {sum / (side * side), samples};
}

TEST_CASE("emitters of instances: each gives its light to the same places as alone, textures, sides and mirrors included") {
  for (const bool with_power : {false, true}) {
    const Stage stage(with_power, 2);
    const Lights shared = stage.build(true), alone = stage.build(false);
    Rng rng(7);
    for (const auto& [s, a] : same_lights(stage, shared, alone)) {
      for (int i = 0; i < 6; ++i) {
        const Vec3 p = *alone.place(a).center + test::random_direction(rng) * (1 + 6 * rng.uniform());
        const auto [x, x_lit] = irradiance(shared, s, p, 16);
        const auto [y, y_lit] = irradiance(alone, a, p, 16);
        REQUIRE(std::abs(x_lit - y_lit) <= 40);
        REQUIRE(std::abs(x - y) <= 0.12 * (x + y) + 1e-9);
      }
    }
  }
}

TEST_CASE("emitters of instances: a hit emits what a sample says, on the same side") {
  const Stage stage(true, 3);
  const Lights shared = stage.build(true), alone = stage.build(false);
  Rng rng(5);
  for (const auto& [s, a] : same_lights(stage, shared, alone)) {
    const Vec3 ng = test::random_direction(rng), wo = test::random_direction(rng);
    const EmitterHit hit{{}, ng, {rng.uniform(), 0.3f}, 1};
    const Rgb x = shared.emitted(s, hit, wo), y = alone.emitted(a, hit, wo);
    CHECK(brightness(x) == doctest::Approx(brightness(y)).epsilon(1e-5));
  }
}

void check_left_out(const Lights& lights) {
  const LightSelector& tree = lights.selector(LightStrategy::tree);
  Rng rng(9);
  std::size_t left_out = 0;
  for (int i = 0; i < 600; ++i) {
    PointQuery q{.p = test::random_in_cube(rng, 8), .n = test::random_direction(rng)};
    const auto near = lights.place(static_cast<LightId>(rng.next() % lights.size()));
    if (i % 2) q.p = *near.center + test::random_direction(rng) * (near.radius * 2 * rng.uniform());
    for (LightId light = 0; light < lights.size(); ++light) {
      if (tree.pmf(q, light) > 0) {
        REQUIRE(lights.power(light) > 0);
        continue;
      }
      ++left_out;
      for (int k = 0; k < 4; ++k) {
        const float x = rng.uniform(), y = rng.uniform();
        const auto l = lights.sample(light, q.p, {x, y});
        REQUIRE((!l || dot(q.n, l->wi) <= 1e-6f));
      }
    }
  }
  CHECK(left_out > 10'000);
}

TEST_CASE("emitters of instances: lights that selection leaves out give nothing") {
  Stage all(false, 4), sheets(false, 4);
  sheets.scene.objects[0].shapes.resize(1);  // whose normals are all on one side
  for (const Stage* stage : {&all, &sheets}) check_left_out(stage->build(true));
}

TEST_CASE("emitters of instances: lights that are left out for a segment give nothing to any point of it") {
  const Stage stage(false, 5);
  const Lights lights = stage.build(true);
  const LightSelector& tree = lights.selector(LightStrategy::tree);
  std::vector<LightBounds> room{test::point_bounds({-8, -8, -8}, 1), test::point_bounds({8, 8, 8}, 1)};
  Rng rng(9);
  std::size_t left_out = 0;
  for (const SegmentQuery& q : test::segments_for(room, 400, 12)) {
    for (LightId light = 0; light < lights.size(); ++light) {
      if (tree.pmf(q, light) > 0) continue;
      ++left_out;
      for (int k = 0; k < 4; ++k) {
        const float t = q.t0 + (std::min(q.t1, q.t0 + 30) - q.t0) * rng.uniform(), x = rng.uniform(), y = rng.uniform();
        REQUIRE(!lights.sample(light, q.o + q.d * t, {x, y}));
      }
    }
  }
  CHECK(left_out > 2'000);
}

TEST_CASE("emitters of instances: a surface does not light its own points, far from the origin either") {
  Stage stage;
  stage.scene.objects[0].shapes = {emissive(bumpy_sheet(20, false), Rgb(1))};
  for (Instance& i : stage.scene.instances) i.to_world = Transform::translate(700, -300, 500) * i.to_world;
  const Lights lights = stage.build(true);
  REQUIRE(lights.stats().shared > 0);
  const TriangleMesh& mesh = std::get<TriangleMesh>(stage.scene.objects[0].shapes[0].kind);
  Rng rng(3);
  for (std::size_t i = 0; i < stage.scene.instances.size(); ++i) {
    const Transform& to_world = stage.scene.instances[i].to_world;
    for (std::uint32_t k = 0; k < mesh.indices.size() / 3; ++k) {
      const auto at = [&](std::uint32_t c) { return mesh.positions[mesh.indices[3 * k + c]]; };
      const float x = 0.1f + 0.4f * rng.uniform(), y = 0.1f + 0.4f * rng.uniform();
      const Vec3 p = to_world.point(at(0) * (1 - x - y) + at(1) * x + at(2) * y);
      REQUIRE(!lights.sample(lights.first_light(1 + i) + k, p, {0.4f, 0.6f}));
    }
  }
}

/// Disks of radius r, two instances of them.
Scene disks(float r, float spread, const Transform& to_world) {
  Scene scene;
  Object& object = scene.objects.emplace_back();
  Rng rng(5);
  for (int i = 0; i < 40; ++i) {
    object.shapes.push_back(emissive(Disk{0, r, 0, 360}, Rgb(1)));
    const Vec3 at = test::random_in_cube(rng, spread), axis = test::random_direction(rng);
    object.shapes.back().to_world = Transform::translate(at.x, at.y, spread > 1 ? 0 : at.z);
    if (spread <= 1)
      object.shapes.back().to_world = object.shapes.back().to_world * Transform::rotate(77, axis.x, axis.y, axis.z);
  }
  for (const double turn : {20.0, 130.0}) scene.instances.push_back({0, to_world * Transform::rotate(turn, 0, 0, 1)});
  return scene;
}

Lights lights_of(const Scene& scene) {
  std::vector<EmitterShape> placed;
  for (const Instance& i : scene.instances)
    for (const Shape& s : scene.objects[i.object].shapes) placed.push_back({&s, i.to_world * s.to_world, &i});
  return build_lights(scene, placed, {{-1, -1, -1}, {1, 1, 1}}, {});
}

TEST_CASE("emitters of instances: nothing is left out by rounding, at points that nearly touch tiny lights") {
  const Lights lights = lights_of(disks(1e-8f, 1, Transform::rotate(33, 1, 2, 3)));
  REQUIRE(lights.stats().shared == 80);
  const LightSelector& tree = lights.selector(LightStrategy::tree);
  Rng rng(4);
  int left_out = 0;
  for (int i = 0; i < 40'000; ++i) {
    const auto light = static_cast<LightId>(rng.next() % lights.size());
    const Vec3 away = test::random_direction(rng), side = normalize(cross(away, test::random_direction(rng)));
    PointQuery q{.p = *lights.place(light).center + away * 1e-5f,
                 .n = normalize(side + away * (0.01f * (rng.uniform() - 0.5f)))};
    if (tree.pmf(q, light) > 0) continue;
    ++left_out;
    const auto l = lights.sample(light, q.p, {0.5f, 0.5f});
    REQUIRE((!l || dot(q.n, l->wi) <= 0));
  }
  CHECK(left_out > 1000);
}

TEST_CASE("emitters of instances: nothing is left out by rounding, for segments far from the origin") {
  // In a plane that is askew, since points round to the grid of floats, over which an upright one would not lift them.
  const Transform place =
      Transform::translate(5000, 3000, -2000) * Transform::rotate(40, 1, 2, 0) * Transform::scale(0.01, 0.01, 0.01);
  const Scene scene = disks(1e-3f, 10, place);
  const Lights lights = lights_of(scene);
  REQUIRE(lights.stats().shared == 80);
  const LightSelector& tree = lights.selector(LightStrategy::tree);
  Rng rng(4);
  int left_out = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto number = static_cast<LightId>(rng.next() % 40);
    const Transform& to_world = scene.instances[0].to_world;
    const Vec3 at = scene.objects[0].shapes[number].to_world.point({}), d{0, 1, 0.04f * (rng.uniform() - 0.5f)};
    const float height = (i % 8 == 0 ? 5.0f : 0.1f) * (rng.uniform() - 0.5f);
    const SegmentQuery q{
        .o = to_world.point(at + Vec3{0.3f, -1, height}), .d = normalize(to_world.vector(d)), .t0 = 0, .t1 = 0.02f};
    const LightId light = lights.first_light(number);
    if (tree.pmf(q, light) > 0) continue;
    ++left_out;
    for (int k = 0; k < 20; ++k) {
      const Vec3 p = q.o + q.d * (q.t0 + (q.t1 - q.t0) * rng.uniform());
      REQUIRE(!lights.sample(light, p, {0.5f, 0.5f}));
    }
  }
  CHECK(left_out > 200);
}

TEST_CASE("instances share where they can, and are lights like others where they cannot") {
  const auto shared = [](Stage& stage) { return stage.build(true).stats().shared; };
  Stage all;
  const std::size_t each = 18 + 8 + 8 + 1 + 1 + 1 + 8;
  CHECK(shared(all) == 6 * each);
  Stage sheared;
  sheared.scene.instances[2].to_world = Transform::scale(1, 1.1, 1) * sheared.scene.instances[2].to_world;
  CHECK(shared(sheared) == 5 * each);
  CHECK(sheared.build(true).stats().power == doctest::Approx(sheared.build(false).stats().power).epsilon(1e-5));
  Stage once;
  once.scene.instances.resize(1);
  CHECK(shared(once) == 0);
  Stage few;
  few.scene.objects[0].shapes.erase(few.scene.objects[0].shapes.begin(), few.scene.objects[0].shapes.begin() + 3);
  CHECK(shared(few) == 0);  // 11 lights
  Stage both;
  both.scene.objects[0].shapes[1].emission->power = 3;
  CHECK(shared(both) == 0);
  CHECK(!Similarity::of(Transform::scale(1, 2, 1)));
  CHECK(Similarity::of(Transform::scale(-2, 2, 2))->scale() == doctest::Approx(2));
}

TEST_CASE("instances with emissive media: both keep their ids") {
  const Stage stage;
  const std::vector<VolumeEmitter> bricks{{{{0, 0, 0}, {1, 1, 1}}, 2}, {{{1, 0, 0}, {2, 1, 1}}, 3}};
  const auto placed = stage.placed(true);
  const Lights lights =
      build_lights(stage.scene, placed, {{-10, -10, -10}, {10, 10, 10}}, {{LightStrategy::tree}, &stage.textures, 1, bricks});
  REQUIRE(lights.first_volume() == 1);
  CHECK(lights.first_light(1) == 3);
  CHECK(lights.power(2) == doctest::Approx(4 * kPi * 3));
  const PointQuery q{.p = {0.5f, 0.5f, 3}, .n = {}};
  CHECK(lights.selector(LightStrategy::tree).pmf(q, 1) > 0);
  CHECK(lights.selector(LightStrategy::tree, false).pmf(q, 1) == 0);
  CHECK(lights.selector(LightStrategy::tree, false).pmf(q, lights.first_light(1)) > 0);
}

TEST_CASE("4,500 instances of 4,000 triangles: 18 million lights in little memory") {
  Scene scene;
  scene.objects.emplace_back().shapes.push_back(emissive(bumpy_sheet(45, false), Rgb(1)));  // 4,050 triangles
  Rng rng(1);
  for (int i = 0; i < 4500; ++i) scene.instances.push_back({0, test::random_similarity(rng, 100)});
  std::vector<EmitterShape> placed;
  for (const Instance& i : scene.instances) placed.push_back({&scene.objects[0].shapes[0], i.to_world, &i});
  const Lights lights = build_lights(scene, placed, {{-100, -100, -100}, {100, 100, 100}}, {});
  CHECK(lights.size() == 4500 * 4050);
  CHECK(lights.memory_bytes() < 5'000'000);
  MESSAGE(lights.memory_bytes() << " bytes, " << lights.selectors()[0].seconds << " s");
  const LightSelector& tree = lights.selector(LightStrategy::tree);
  int selected = 0;
  for (int i = 0; i < 2000; ++i) {
    const PointQuery q{.p = test::random_in_cube(rng, 110), .n = {}};
    const auto s = tree.select(q, rng.uniform_wide());
    if (!s) continue;
    ++selected;
    REQUIRE(tree.pmf(q, s->light) == doctest::Approx(s->pmf).epsilon(1e-6));
  }
  CHECK(selected > 1000);
}

}  // namespace
}  // namespace tyndall
