/// From material descriptions to lobes: pbrt's rules for textures, roughness, indices and mixes.
#include <doctest/doctest.h>

#include "surface/fresnel.h"
#include "surface/material.h"
#include "tyndall/error.h"
#include "unit/surface/bsdf_cases.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// A scene under construction: textures and materials are added and named by their index.
struct Palette {
  Scene scene;

  TextureId texture(Rgb value) {
    scene.textures.push_back({.kind = ConstantTexture{value}, .where = {}});
    return TextureId(scene.textures.size() - 1);
  }
  TextureId texture(float value) { return texture(Rgb(value)); }
  Roughness roughness(float u, float v, bool remap = true) { return {texture(u), texture(v), remap}; }
  template <typename Kind>
  MaterialId material(const Kind& kind) {
    scene.materials.push_back({.kind = kind, .name = "test", .where = {"test.pbrt", 7, 3}});
    return MaterialId(scene.materials.size() - 1);
  }
};

const SurfaceQuery kQuery{.p = {1, 2, 3}, .uv = {0.5f, 0.5f}, .shading = {}, .wo = {0, 0, 1}, .random = 0.4f};

Bsdf build(const Palette& palette, MaterialId id, const SurfaceQuery& query = kQuery) {
  const Textures textures = build_textures(palette.scene.textures);
  return Materials(palette.scene, textures).bsdf(id, query);
}

Rgb normal_weight(const Bsdf& bsdf) { return bsdf.sample({0, 0, 1}, 0, {0.5f, 0.5f})->weight; }

}  // namespace

TEST_CASE("reflectances are clamped to [0, 1] and diffuse transmission is scaled first") {
  Palette p;
  const auto diffuse = p.material(DiffuseMaterial{p.texture({1.5f, 0.5f, -0.2f})});
  CHECK(normal_weight(build(p, diffuse)) == Rgb{1, 0.5f, 0});
  const auto leaf = p.material(DiffuseTransmissionMaterial{p.texture(0.3f), p.texture(0.8f), 2});
  const Bsdf bsdf = build(p, leaf);
  CHECK(bsdf.eval({0, 0, 1}, {0, 0, 1}).g == doctest::Approx(0.6 / double(kPi)));
  CHECK(bsdf.eval({0, 0, 1}, {0, 0, -1}).g == doctest::Approx(1 / double(kPi)));
}

TEST_CASE("roughness becomes alpha by its square root unless remapping is off") {
  Palette p;
  const auto optics = ConductorOptics{.reflectance = p.texture(0.8f)};
  const auto remapped = p.material(ConductorMaterial{optics, p.roughness(0.09f, 0.09f)});
  const auto plain = p.material(ConductorMaterial{optics, p.roughness(0.3f, 0.3f, false)});
  const Vec3 wo = polar(30, 0), wi = polar(40, 160);
  CHECK(build(p, remapped).eval(wo, wi).g == doctest::Approx(build(p, plain).eval(wo, wi).g).epsilon(1e-5));
  // pbrt's threshold of a mirror: both alphas below 1e-3.
  CHECK_FALSE(build(p, p.material(ConductorMaterial{optics, p.roughness(0.9e-6f, 0)})).has_smooth());
  CHECK(build(p, p.material(ConductorMaterial{optics, p.roughness(1.1e-6f, 0)})).has_smooth());
  CHECK_FALSE(build(p, p.material(DielectricMaterial{1.5f, p.roughness(0, 0)})).has_smooth());
}

TEST_CASE("metals reflect as their reflectance, or as their index over the coat's") {
  Palette p;
  const auto mirror = p.material(ConductorMaterial{{.reflectance = p.texture(0.6f)}, p.roughness(0, 0)});
  CHECK(normal_weight(build(p, mirror)).g == doctest::Approx(0.6).epsilon(1e-4));

  const TextureId eta = p.texture(0.2f), k = p.texture(3.9f);
  const auto coated = p.material(CoatedConductorMaterial{
      {.reflectance = {}, .eta = eta, .k = k},
      p.roughness(0, 0),
      {.roughness = p.roughness(0, 0), .thickness = p.texture(0), .eta = 1.5f, .g = p.texture(0), .albedo = p.texture(0)}});
  const Bsdf bsdf = build(p, coated);
  CHECK_FALSE(bsdf.has_smooth());
  // At the normal all orders add up: F + T^2 R / (1 - F R), R the metal seen from the coat.
  const double F = 0.04, R = double(fresnel_conductor(1, Rgb(0.2f / 1.5f), Rgb(3.9f / 1.5f)).g);
  TestRandom random(5);
  Estimate power;
  for (int n = 0; n < 20000; ++n) {
    const auto s = bsdf.sample({0, 0, 1}, random(), random.pair());
    power.add(s ? double(s->weight.g) : 0.0);
    if (s) CHECK(s->specular);
  }
  CHECK(std::abs(power.mean() - (F + (1 - F) * (1 - F) * R / (1 - F * R))) < 5 * power.error() + 1e-5);
}

TEST_CASE("a mix chooses by its amount, nested ones independently") {
  Palette p;
  const auto black = p.material(DiffuseMaterial{p.texture(0)});
  const auto grey = p.material(DiffuseMaterial{p.texture(0.5f)});
  const auto white = p.material(DiffuseMaterial{p.texture(1)});
  const auto inner = p.material(MixMaterial{grey, white, p.texture(0.5f)});
  const auto outer = p.material(MixMaterial{black, inner, p.texture(0.3f)});
  const auto never = p.material(MixMaterial{black, white, p.texture(0)});
  const auto always = p.material(MixMaterial{black, white, p.texture(1)});
  const Textures textures = build_textures(p.scene.textures);
  const Materials materials(p.scene, textures);
  int greys = 0, whites = 0;
  constexpr int n = 10000;
  for (int i = 0; i < n; ++i) {
    SurfaceQuery query = kQuery;
    query.random = (float(i) + 0.5f) / n;
    const float albedo = materials.bsdf(outer, query).albedo(query.wo).g;
    greys += albedo == 0.5f;
    whites += albedo == 1;
    CHECK(materials.bsdf(never, query).albedo(query.wo).g == 0);
    CHECK(materials.bsdf(always, query).albedo(query.wo).g == 1);
  }
  CHECK(greys == doctest::Approx(0.15 * n).epsilon(0.01));
  CHECK(whites == doctest::Approx(0.15 * n).epsilon(0.01));
}

TEST_CASE("interfaces are known as such, and pass light where a mix holds one") {
  Palette p;
  const auto open = p.material(InterfaceMaterial{});
  const auto wall = p.material(DiffuseMaterial{p.texture(0.5f)});
  const auto mix = p.material(MixMaterial{wall, open, p.texture(1)});
  const Textures textures = build_textures(p.scene.textures);
  const Materials materials(p.scene, textures);
  CHECK(materials.is_interface(open));
  CHECK_FALSE(materials.is_interface(wall));
  CHECK_FALSE(materials.is_interface(mix));
  const auto s = materials.bsdf(mix, kQuery).sample({0, 0, 1}, 0.5f, {0.5f, 0.5f});
  REQUIRE(s);
  CHECK(s->wi == Vec3{0, 0, -1});
  CHECK(s->weight == Rgb(1.0f));
}

TEST_CASE("coated walks differ from point to point") {
  Palette p;
  const auto coated = p.material(CoatedDiffuseMaterial{
      p.texture(0.5f),
      {.roughness = p.roughness(0.2f, 0.2f), .thickness = p.texture(0.01f), .g = p.texture(0), .albedo = p.texture(0.5f)}});
  SurfaceQuery elsewhere = kQuery;
  elsewhere.p.x += 1e-3f;
  const Vec3 wo = polar(30, 0), wi = polar(40, 160);
  CHECK(build(p, coated).eval(wo, wi) == build(p, coated).eval(wo, wi));
  CHECK(build(p, coated).eval(wo, wi).g != build(p, coated, elsewhere).eval(wo, wi).g);
}

TEST_CASE("clear coats that are the same everywhere take no walks") {
  Palette p;
  const auto coated = [&](float alpha_v, TextureId thickness, float albedo, float eta) {
    return p.material(CoatedDiffuseMaterial{p.texture(0.5f),
                                            {.roughness = p.roughness(0.2f, alpha_v),
                                             .thickness = thickness,
                                             .eta = eta,
                                             .g = p.texture(0),
                                             .albedo = p.texture(albedo)}});
  };
  const TextureId thin = p.texture(0.01f);
  CHECK(build(p, coated(0.2f, thin, 0, 1.5f)).has_exact_pdf());
  CHECK_FALSE(build(p, coated(0.1f, thin, 0, 1.5f)).has_exact_pdf());
  CHECK_FALSE(build(p, coated(0.2f, thin, 0.1f, 1.5f)).has_exact_pdf());
  CHECK_FALSE(build(p, coated(0.2f, thin, 0, 0.7f)).has_exact_pdf());
}

TEST_CASE("clear coats of several tops and thicknesses have shares of their own, the same as alone") {
  struct Coated {
    float roughness, thickness;
  };
  const Coated coats[] = {{0.2f, 0.01f}, {0.2f, 0.4f}, {0.02f, 0.01f}, {0, 0.01f}, {0.2f, 0.01f}};
  Palette p;
  for (const Coated& c : coats)
    p.material(CoatedDiffuseMaterial{p.texture(0.5f),
                                     {.roughness = p.roughness(c.roughness, c.roughness, false),
                                      .thickness = p.texture(c.thickness),
                                      .g = p.texture(0),
                                      .albedo = p.texture(0)}});
  const Textures textures = build_textures(p.scene.textures);
  const Materials materials(p.scene, textures);
  for (MaterialId id = 0; id < std::size(coats); ++id) {
    const DielectricLobe top = glass(1.5f, coats[id].roughness, coats[id].roughness);
    const CoatShares shares = coat_shares(top, coats[id].thickness);
    const ClearCoatLobe alone(top, Rgb(0.5f), {.thickness = coats[id].thickness}, shares);
    const Vec3 wo = polar(40, 0), wi = polar(65, 100);
    CHECK(materials.bsdf(id, kQuery).eval(wo, wi).g == Bsdf(Frame{}, alone).eval(wo, wi).g);
  }
}

TEST_CASE("contradictory materials are refused with their place") {
  const auto message = [](const Palette& p) -> std::string {
    const Textures textures = build_textures(p.scene.textures);
    try {
      const Materials materials(p.scene, textures);
    } catch (const Error& e) {
      CHECK(e.failure() == Failure::scene);
      return e.what();
    }
    return "";
  };
  Palette missing;
  missing.material(DiffuseMaterial{4});
  CHECK(message(missing).starts_with("test.pbrt:7:3: material \"test\" uses texture 4 of 0"));

  Palette circle;
  const TextureId half = circle.texture(0.5f);
  circle.material(MixMaterial{1, 1, half});
  circle.material(MixMaterial{0, 0, half});
  CHECK(message(circle).find("contains itself") != std::string::npos);

  Palette stranger;
  stranger.material(MixMaterial{0, 9, stranger.texture(0.5f)});
  CHECK(message(stranger).find("contains itself") != std::string::npos);  // 0 is the mix itself: met first

  Palette vacuum;
  const Roughness smooth = vacuum.roughness(0, 0);
  vacuum.material(DielectricMaterial{0, smooth});
  CHECK(message(vacuum).find("index of refraction") != std::string::npos);
}
