/// Partial derivatives of shapes, footprints, and normals that textures bend.
#include "surface/bump.h"

#include <doctest/doctest.h>

#include <cmath>

#include "geometry_scenes.h"
#include "surface/material.h"
#include "texture/textures.h"

using namespace tyndall;
using namespace tyndall::test;
using doctest::Approx;

namespace {

/// What the ray meets, and how the surface goes on there.
struct Place {
  SurfaceHit hit;
  SurfaceTangents tangents;
};

std::optional<Place> place(const Geometry& geometry, const Ray& ray) {
  const Trace trace = geometry.trace(ray, 0, kInfinity);
  if (!trace.hit) return std::nullopt;
  return Place{*trace.hit, geometry.tangents(*trace.hit)};
}

void check_near(Vec3 a, Vec3 b, float tolerance) {
  INFO(a.x, " ", a.y, " ", a.z, " against ", b.x, " ", b.y, " ", b.z);
  CHECK(length(a - b) <= tolerance * std::max(1.0f, length(b)));
}

/// The oracle: of two near places p and uv differ by the partial derivatives, and so does the normal.
int check_differences(const Scene& scene, float curvature) {
  const Geometry geometry(scene, nullptr, 1);
  Rng rng(3);
  int met = 0;
  for (int i = 0; i < 400; ++i) {
    const Ray ray = random_ray(rng, 1.5f, {});
    const auto a = place(geometry, ray);
    if (!a) continue;
    const Vec3 aside = normalize(Vec3{rng.uniform() - 0.5f, rng.uniform() - 0.5f, rng.uniform() - 0.5f});
    const auto b = place(geometry, {ray.o + 0.002f * aside, ray.d});
    if (!b || b->hit.primitive != a->hit.primitive || b->hit.shape != a->hit.shape) continue;
    const Vec2 duv = b->hit.uv - a->hit.uv;
    if (std::abs(duv.x) + std::abs(duv.y) > 0.05f) continue;  // near poles and seams
    const SurfaceTangents& t = a->tangents;
    check_near(duv.x * t.dpdu + duv.y * t.dpdv, b->hit.p - a->hit.p, 3e-4f);
    check_near(duv.x * t.dndu + duv.y * t.dndv, b->hit.ns - a->hit.ns, 3e-4f * curvature);
    const Vec3 step = b->hit.p - a->hit.p;
    const Footprint footprint = footprint_on(t, step, {});
    CHECK(footprint.duvdx.x == Approx(duv.x).epsilon(0.05).scale(0.02));
    CHECK(footprint.duvdx.y == Approx(duv.y).epsilon(0.05).scale(0.02));
    ++met;
  }
  return met;
}

}  // namespace

TEST_CASE("partial derivatives of every shape are the limits of differences, in instances too") {
  const Transform turned = Transform::rotate(40, 1, 2, 3);
  BilinearMesh twisted;
  twisted.positions = {{-1, -1, 0.2f}, {1, -1, -0.3f}, {-1, 1, 0}, {1, 1, 0.5f}};
  twisted.indices = {0, 1, 2, 3};
  BilinearMesh mapped = twisted;
  mapped.uvs = {{0, 0}, {2, 0}, {0, 3}, {2, 3}};
  TriangleMesh triangle{.positions = {{-1, -1, 0}, {2, -1, 0.5f}, {0, 2, 0}},
                        .normals = {},
                        .uvs = {{0, 0}, {1, 0.2f}, {0.3f, 2}},
                        .indices = {0, 1, 2}};
  for (const Shape& shape :
       {make_shape(Sphere{}, turned), make_shape(Cylinder{1, -0.8f, 0.7f, 250}, turned),
        make_shape(Disk{0.1f, 1.2f, 0.3f, 300}, turned), make_shape(Sphere{1.2f, -0.5f, 0.8f, 200}, turned),
        make_shape(twisted, turned), make_shape(mapped, turned), make_shape(triangle, turned)}) {
    INFO(shape.kind.index());
    Scene scene = empty_scene();
    scene.shapes.push_back(shape);
    CHECK(check_differences(scene, 3) > 30);
    Scene instanced = empty_scene();
    instanced.objects.push_back({"o", {shape}});
    instanced.instances.push_back({0, Transform::translate(0.1, 0, 0.2) * Transform::rotate(70, 0, 1, 0)});
    CHECK(check_differences(instanced, 3) > 30);
  }
}

TEST_CASE("vertex normals give the normal's derivatives") {
  Scene scene = empty_scene();
  // On the unit sphere's tangent plane: n = p normalised, so that dn is nearly dp.
  TriangleMesh mesh{.positions = {{0, 0, 1}, {0.2f, 0, 1}, {0, 0.2f, 1}},
                    .normals = {},
                    .uvs = {{0, 0}, {1, 0}, {0, 1}},
                    .indices = {0, 1, 2}};
  mesh.normals = mesh.positions;
  BilinearMesh patch{.positions = {{1, 0, 1}, {1.2f, 0, 1}, {1, 0.2f, 1}, {1.2f, 0.2f, 1}},
                     .normals = {{0, 0, 1}, {0.2f, 0, 1}, {0, 0.2f, 1}, {0.2f, 0.2f, 1}},
                     .uvs = {},
                     .indices = {0, 1, 2, 3}};
  scene.shapes = {make_shape(mesh), make_shape(patch)};
  const Geometry geometry(scene, nullptr, 1);
  for (const float x : {0.01f, 1.01f}) {
    const auto at = place(geometry, {{x, 0.01f, 5}, {0, 0, -1}});
    REQUIRE(at.has_value());
    check_near(at->tangents.dndu, {0.2f, 0, 0}, 1e-6f);
    check_near(at->tangents.dndv, {0, 0.2f, 0}, 1e-6f);
    CHECK(std::abs(dot(at->tangents.shading_dpdu, at->hit.ns)) < 1e-6f);
    CHECK(std::abs(dot(at->tangents.shading_dpdv, at->hit.ns)) < 1e-6f);
    CHECK(length(at->tangents.shading_dpdu) == Approx(0.2).epsilon(0.01));
  }
}

TEST_CASE("a slope tilts the normal by its angle, a constant height not at all, on the side that faces") {
  const SurfaceTangents flat{{2, 0, 0}, {0, 3, 0}, {2, 0, 0}, {0, 3, 0}, {}, {}};
  const TextureQuery at{.uv = {0.3f, 0.4f}, .p = {0.6f, 1.2f, 0}, .n = {0, 0, 1}};
  const auto normal = [&](const Frame& shading, Vec3 ng, auto height) {
    TextureQuery query = at;
    query.n = ng;
    return bumped(shading, query, flat, height).z;
  };
  const auto along_u = [](const TextureQuery& q) { return q.uv.x; };  // rises 1 for every 2 units of x
  const auto along_y = [](const TextureQuery& q) { return 0.5f * q.p.y; };
  check_near(normal({}, {0, 0, 1}, along_u), normalize(Vec3{-0.5f, 0, 1}), 1e-4f);
  check_near(normal({}, {0, 0, 1}, along_y), normalize(Vec3{0, -0.5f, 1}), 1e-3f);
  check_near(normal({}, {0, 0, 1}, [](const TextureQuery&) { return 7.0f; }), {0, 0, 1}, 1e-6f);
  const Frame turned = Frame::around({0, 0, -1}, {1, 0, 0});  // reversed: heights go down, and the normal faces down
  check_near(normal(turned, {0, 0, -1}, along_u), normalize(Vec3{-0.5f, 0, -1}), 1e-4f);
  const Frame same = bumped({}, at, flat, [](const TextureQuery&) { return std::nanf(""); });
  CHECK(same.z == Vec3{0, 0, 1});

  // On a ball a constant height is a larger ball: the tangents grow, the normal stays; a slope counts for less.
  SurfaceTangents ball = flat;
  ball.dndu = ball.dpdu, ball.dndv = ball.dpdv;
  const Vec3 n = bumped({}, at, ball, [](const TextureQuery& q) { return 1 + q.uv.x - 0.3f; }).z;
  check_near(n, normalize(Vec3{-0.25f, 0, 1}), 1e-4f);
}

TEST_CASE("differences are taken over half the footprint") {
  const SurfaceTangents flat{{1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {}, {}};
  const Footprint wide{{}, {}, {0.2f, 0}, {0.4f, 0}};
  float reach = 0;
  bumped({}, {.uv = {}, .p = {}, .n = {0, 0, 1}, .footprint = &wide}, flat, [&](const TextureQuery& q) {
    reach = std::max(reach, q.uv.x);
    return 0.0f;
  });
  CHECK(reach == Approx(0.3));
}

TEST_CASE("normal maps: flat blue changes nothing, and texels are in the frame of dpdu and the normal") {
  const Frame frame = Frame::around({0, 1, 0}, {0, 0, 1});
  check_near(normal_mapped(frame, {0, 1, 0}, {0.5f, 0.5f, 1}).z, {0, 1, 0}, 1e-6f);
  check_near(normal_mapped(frame, {0, 1, 0}, {0.9f, 0.5f, 0.8f}).z, {0, 0.6f, 0.8f}, 1e-6f);
  check_near(normal_mapped(frame, {0, -1, 0}, {0.9f, 0.5f, 0.8f}).z, {0, -0.6f, -0.8f}, 1e-6f);
  CHECK(normal_mapped(frame, {0, 1, 0}, Rgb(0.5f)).z == Vec3{0, 1, 0});
  const Frame bent = normal_mapped(frame, {0, 1, 0}, {0.9f, 0.3f, 0.8f});
  CHECK(std::abs(dot(bent.x, bent.z)) < 1e-6f);
  CHECK(dot(cross(bent.x, bent.y), bent.z) == Approx(1));
}

TEST_CASE("materials say what they need, through mixes, and refract by the path's channel") {
  Scene scene = empty_scene();
  scene.textures.push_back({NoiseTexture{}, {}});
  Material bumpy{DiffuseMaterial{0}, "bumpy", {}};
  bumpy.displacement = TextureId{1};
  scene.materials.push_back(bumpy);                                                                         // 2
  scene.materials.push_back({MixMaterial{5, 0, 0}, "outer", {}});                                           // 3
  scene.materials.push_back({DielectricMaterial{1.5f, {0, 0, true}, Rgb(1.4f, 1.5f, 1.6f)}, "glass", {}});  // 4
  scene.materials.push_back({MixMaterial{2, 4, 0}, "inner", {}});                                           // 5
  scene.materials.push_back({DiffuseMaterial{1}, "noisy", {}});                                             // 6
  const Textures textures = build_textures(scene.textures);
  const Materials materials(scene, textures);
  CHECK_FALSE(materials.wants_detail(0));
  CHECK_FALSE(materials.bends_normals(0));
  CHECK(materials.wants_detail(2));
  CHECK(materials.bends_normals(2));
  for (const MaterialId mix : {MaterialId{3}, MaterialId{5}}) {
    CHECK(materials.wants_detail(mix));
    CHECK(materials.bends_normals(mix));
    CHECK(materials.is_dispersive(mix));
  }
  CHECK(materials.is_dispersive(4));
  CHECK_FALSE(materials.is_dispersive(2));
  CHECK(materials.wants_detail(6));
  CHECK_FALSE(materials.bends_normals(6));

  Scene smooth = empty_scene();
  smooth.textures[0].kind = ConstantTexture{Rgb(0.0f)};
  smooth.materials.push_back({DielectricMaterial{1.5f, {0, 0, true}, Rgb(1.4f, 1.5f, 1.6f)}, "glass", {}});
  const Textures none = build_textures(smooth.textures);
  const Materials glass(smooth, none);
  const Vec3 wo = normalize(Vec3{0.6f, 0, 0.8f});
  for (int channel = 0; channel < 3; ++channel) {
    SurfaceQuery query{.p = {}, .uv = {}, .shading = {}, .wo = wo};
    query.channel = channel;
    const auto s = glass.bsdf(2, query).sample(wo, 0.99f, {0.5f, 0.5f});
    REQUIRE(s.has_value());
    const double eta = 1.4 + 0.1 * channel;
    CHECK(-s->wi.x == Approx(0.6 / eta).epsilon(1e-4));  // Snell
  }
}
