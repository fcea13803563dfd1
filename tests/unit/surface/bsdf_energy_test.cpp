/// Energy, reciprocity, and values known in closed form.
#include <doctest/doctest.h>

#include <complex>

#include "support/relative.h"
#include "surface/fresnel.h"
#include "unit/surface/bsdf_cases.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// Amplitude reflectances by complex arithmetic, straight from Fresnel's equations.
double fresnel_oracle(double cos_i, std::complex<double> n) {
  const std::complex<double> sin_t = std::sqrt(1 - cos_i * cos_i) / n, cos_t = std::sqrt(1.0 - sin_t * sin_t);
  const auto parallel = (n * cos_i - cos_t) / (n * cos_i + cos_t);
  const auto perpendicular = (cos_i - n * cos_t) / (cos_i + n * cos_t);
  return 0.5 * (std::norm(parallel) + std::norm(perpendicular));
}

Vec3 world(Vec3 local) { return tilted_frame().to_world(local); }

}  // namespace

TEST_CASE("Fresnel reflectances agree with complex arithmetic") {
  for (const float c : {1.0f, 0.9f, 0.5f, 0.2f, 0.01f}) {
    for (const float eta : {1.5f, 1.0f, 1 / 1.5f, 0.3f, 2.4f})
      CHECK(fresnel_dielectric(c, eta) == doctest::Approx(fresnel_oracle(c, double(eta))).epsilon(1e-4));
    for (const auto& [eta, k] : {std::pair{0.2f, 3.9f}, std::pair{1.0f, 0.5f}, std::pair{2.5f, 2.0f}, std::pair{1.0f, 0.0f}})
      CHECK(fresnel_conductor(c, Rgb(eta), Rgb(k)).g ==
            doctest::Approx(fresnel_oracle(c, {double(eta), double(k)})).epsilon(1e-4));
  }
  CHECK(fresnel_dielectric(0, 1.5f) == 1);
  CHECK(fresnel_dielectric(1, 1.5f) == doctest::Approx(0.04));
  CHECK(fresnel_dielectric(0.5f, 1.0f) == 0);
  CHECK(fresnel_dielectric(0.7f, 1 / 1.5f) == 1);  // past the critical angle, cos 0.745
  CHECK(fresnel_conductor(0, Rgb(1.0f), Rgb(0.0f)).r == 1);
}

TEST_CASE("a reflectance becomes an index with that reflectance at normal incidence") {
  for (const float r : {0.0f, 0.1f, 0.5f, 0.9f})
    CHECK(fresnel_conductor(1, Rgb(1.0f), conductor_k(Rgb(r))).r == doctest::Approx(r).epsilon(1e-5));
  CHECK(fresnel_conductor(1, Rgb(1.0f), conductor_k(Rgb(1.0f))).r == doctest::Approx(0.9999).epsilon(1e-5));
}

TEST_CASE("reflection is reciprocal, refraction up to eta^2") {
  TestRandom random(3);
  int transmissions = 0;
  for (const BsdfCase& c : smooth_cases())
    for (int n = 0; n < 2000; ++n) {
      const Vec3 wo = random.direction();
      const auto s = c.bsdf.sample(wo, random(), random.pair());
      const float cos_o = abs_dot(wo, tilted_frame().z);
      if (!s || cos_o < 0.01f || abs_dot(s->wi, tilted_frame().z) < 0.01f) continue;
      CAPTURE(c.name);
      const float forth = c.bsdf.eval(wo, s->wi).g / abs_dot(s->wi, tilted_frame().z);
      const float back = c.bsdf.eval(s->wi, wo).g / cos_o;
      CHECK(forth * s->eta * s->eta == test::relative(back).epsilon(5e-3));
      transmissions += s->transmission;
    }
  CHECK(transmissions > 1000);
}

TEST_CASE("no sample carries more power than arrived") {
  TestRandom random(5);
  std::vector<BsdfCase> cases = smooth_cases();
  for (const float a : {0.0f, 1e-3f, 0.02f}) {
    cases.push_back({"metal", make(metal(a, a))});
    cases.push_back({"glass", make(glass(1.5f, a, a))});
  }
  for (const BsdfCase& c : cases)
    for (int n = 0; n < 3000; ++n) {
      const auto s = c.bsdf.sample(random.direction(), random(), random.pair());
      CAPTURE(c.name);
      if (s) CHECK(max_component(s->weight) * s->eta * s->eta <= 1 + 1e-5f);
    }
}

TEST_CASE("a smooth dielectric passes on all the power it gets") {
  for (const float eta : {1.5f, 1 / 1.5f, 1.0f, 2.4f})
    for (const Vec3 local : view_directions()) {
      const Bsdf bsdf = make(glass(eta, 0, 0));
      CHECK_FALSE(bsdf.has_smooth());
      double power = 0;
      for (int n = 0; n < 1000; ++n) {
        const auto s = bsdf.sample(world(local), (float(n) + 0.5f) / 1000, {0.5f, 0.5f});
        REQUIRE(s);
        REQUIRE(s->specular);
        power += double(s->weight.g * s->eta * s->eta) / 1000;
        if (s->transmission) {
          // Snell's law, and the path goes on through the plane of incidence.
          const Vec3 wi = tilted_frame().to_local(s->wi);
          CHECK(wi.x * s->eta == doctest::Approx(-local.x).epsilon(1e-4));
          CHECK(wi.y * s->eta == doctest::Approx(-local.y).epsilon(1e-4));
          CHECK(s->eta == doctest::Approx(local.z > 0 ? eta : 1 / eta));
        }
      }
      CHECK(power == doctest::Approx(1).epsilon(1e-5));
      CHECK(is_black(bsdf.eval(world(local), world(-local))));
      CHECK(bsdf.pdf(world(local), world(-local)) == 0);
    }
}

TEST_CASE("an index of exactly one lets everything pass unbent") {
  for (const float a : {0.0f, 0.3f}) {
    const Bsdf bsdf = make(glass(1, a, a));
    TestRandom random(9);
    CHECK_FALSE(bsdf.has_smooth());
    CHECK_FALSE(bsdf.reflects());
    for (int n = 0; n < 1000; ++n) {
      const Vec3 wo = random.direction();
      const auto s = bsdf.sample(wo, random(), random.pair());
      REQUIRE(s);
      CHECK(length(s->wi + wo) < 1e-5f);
      CHECK(s->weight.g == doctest::Approx(1));
    }
  }
}

TEST_CASE("a thin pane reflects 2R/(1+R) and bends nothing") {
  const Bsdf bsdf = make(ThinDielectricLobe{1.5f});
  const Vec3 local = polar(130, 20);
  const double R = fresnel_dielectric(-local.z, 1.5f);
  int reflected = 0;
  for (int n = 0; n < 10000; ++n) {
    const auto s = bsdf.sample(world(local), (float(n) + 0.5f) / 10000, {});
    REQUIRE(s);
    CHECK(s->weight.g == 1);
    CHECK(s->eta == 1);
    reflected += !s->transmission;
    const Vec3 expected = s->transmission ? -local : Vec3{-local.x, -local.y, local.z};
    CHECK(length(s->wi - world(expected)) < 1e-5f);
  }
  CHECK(reflected / 10000.0 == doctest::Approx(2 * R / (1 + R)).epsilon(2e-3));
}

TEST_CASE("albedo is the mean power of the samples") {
  TestRandom random(13);
  std::vector<BsdfCase> cases = smooth_cases();
  cases.push_back({"mirror", make(metal(0, 0))});
  for (const BsdfCase& c : cases)
    for (const Vec3 local : {polar(30, 10), polar(65, 80)}) {
      Estimate power;
      for (int n = 0; n < 20000; ++n) {
        const auto s = c.bsdf.sample(world(local), random(), random.pair());
        power.add(s ? double(s->weight.g * s->eta * s->eta) : 0.0);
      }
      CAPTURE(c.name);
      CHECK(c.bsdf.albedo(world(local)).g == doctest::Approx(power.mean()).epsilon(0.15));
    }
}

TEST_CASE("flags say what a surface does") {
  const Bsdf black = make(DiffuseLobe{}), leaf = make(DiffuseTransmissionLobe{{}, Rgb(0.5f)}), mirror = make(metal(0, 0));
  CHECK_FALSE(black.has_smooth());
  CHECK_FALSE(black.reflects());
  CHECK(leaf.has_smooth());
  CHECK(leaf.transmits());
  CHECK_FALSE(leaf.reflects());
  CHECK(mirror.reflects());
  CHECK_FALSE(mirror.has_smooth());
  CHECK(make(metal(0, 0.1f)).has_smooth());
  CHECK(make(PassThroughLobe{}).transmits());
  CHECK_FALSE(black.sample(tilted_frame().z, 0.5f, {0.5f, 0.5f}).has_value());
}
