/// Do samples follow the densities, and do weights, values and densities agree?
#include <doctest/doctest.h>

#include <deque>

#include "support/chi_squared.h"
#include "support/relative.h"
#include "unit/surface/bsdf_cases.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

DirectionSampler smooth_sampler(const Bsdf& bsdf, Vec3 wo) {
  return [=](const Uniform& random) -> std::optional<Vec3> {
    const float uc = random(), u = random(), v = random();
    const auto s = bsdf.sample(wo, uc, {u, v});
    if (!s || s->specular) return std::nullopt;
    return s->wi;
  };
}

DirectionDensity density(const Bsdf& bsdf, Vec3 wo) {
  return [=](Vec3 wi) { return double(bsdf.pdf(wo, wi)); };
}

}  // namespace

TEST_CASE("samples follow the density, the lost ones its missing mass") {
  const double alpha = sidak(1e-3, int(smooth_cases().size() * view_directions().size()));
  double worst_detectable = 0;
  for (const BsdfCase& c : smooth_cases())
    for (const Vec3 local : view_directions()) {
      CAPTURE(c.name);
      CAPTURE(local.z);
      const Vec3 wo = tilted_frame().to_world(local);
      const auto r = chi_squared_test(smooth_sampler(c.bsdf, wo), density(c.bsdf, wo),
                                      {.samples = 100'000, .axis = tilted_frame().z, .alpha = alpha});
      CHECK_MESSAGE(r.passed, r.summary());
      CHECK(std::abs(r.density_integral - r.sampled_fraction) < 5 * std::sqrt(0.25 / 1e5));
      worst_detectable = std::max(worst_detectable, r.detectable_deviation);
    }
  // Power: an rms deviation of the bins of this size is found with probability 0.99.
  CHECK(worst_detectable < 0.06);
}

TEST_CASE("narrow metal lobes follow their density") {
  const double alpha = sidak(1e-3, 6);
  for (const float a : {1e-3f, 0.01f, 0.05f})
    for (const float theta : {20.0f, 70.0f}) {
      CAPTURE(a);
      CAPTURE(theta);
      const Bsdf bsdf = make(metal(a, a));
      const Vec3 local = polar(theta, 40);
      const Vec3 wo = tilted_frame().to_world(local);
      // Bins around the mirror direction, as wide as the lobe near it.
      const auto r = chi_squared_test(smooth_sampler(bsdf, wo), density(bsdf, wo),
                                      {.theta_bins = 40,
                                       .phi_bins = 16,
                                       .axis = tilted_frame().to_world({-local.x, -local.y, local.z}),
                                       .theta_power = 1.0 - std::log(double(a)),
                                       .alpha = alpha});
      CHECK_MESSAGE(r.passed, r.summary());
      // A mirror-like microfacet metal loses next to nothing below the horizon.
      CHECK(r.density_integral == doctest::Approx(1).epsilon(a < 0.02f ? 1e-3 : 0.05));
    }
}

TEST_CASE("weight times density is the value, and both densities are one") {
  TestRandom random(7);
  for (const BsdfCase& c : smooth_cases())
    for (int n = 0; n < 4000; ++n) {
      const Vec3 wo = random.direction();
      const auto s = c.bsdf.sample(wo, random(), random.pair());
      if (!s) continue;
      CAPTURE(c.name);
      REQUIRE_FALSE(s->specular);
      // Float directions blur half vectors near the horizon and near the direction that passes unbent.
      const bool sharp = std::abs(dot(s->wi, tilted_frame().z)) > 1e-3f && std::abs(dot(wo, tilted_frame().z)) > 1e-3f;
      if (!sharp) continue;
      CHECK(s->pdf == test::relative(c.bsdf.pdf(wo, s->wi)).epsilon(5e-3));
      const Rgb value = c.bsdf.eval(wo, s->wi);
      for (int i = 0; i < 3; ++i) CHECK(s->weight[i] * s->pdf == test::relative(value[i]).epsilon(5e-3));
      const float side = dot(wo, tilted_frame().z) * dot(s->wi, tilted_frame().z);
      CHECK(s->transmission == (side < 0));
    }
}

TEST_CASE("nothing is ever negative, infinite or not a number") {
  TestRandom random(11);
  const std::vector<float> heights{0, 1e-30f, -1e-30f, 1e-12f, 1e-7f, -1e-7f, 1e-3f, -1e-3f, 0.5f, -0.5f, 1, -1};
  const auto direction = [&] {
    const float z = heights[std::size_t(random() * float(heights.size()))], phi = 2 * kPi * random();
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    return Vec3{r * std::cos(phi), r * std::sin(phi), z};
  };
  std::vector<Bsdf::Lobe> lobes{DiffuseLobe{}, DiffuseTransmissionLobe{}, ThinDielectricLobe{1.0f}, ThinDielectricLobe{0.7f},
                                PassThroughLobe{}};
  std::deque<CoatShares> kept;  // coats refer to them
  for (const float a : {0.0f, 9e-4f, 1e-3f, 0.02f, 0.3f, 1.0f}) {
    for (const float eta : {0.4f, 0.66f, 0.9999f, 1.0f, 1.00001f, 1.0003f, 1.5f, 4.0f}) lobes.push_back(glass(eta, a, a));
    lobes.push_back(metal(a, 1));
    lobes.push_back(ConductorLobe{.ggx = Ggx(a, a), .eta = Rgb(1.0f), .k = {}});
    for (const float eta : {0.66f, 1.0f, 1.5f}) {
      const Coat coat{.thickness = 0.01f, .albedo = Rgb(0.5f), .g = 0.9f};
      lobes.push_back(CoatedDiffuseLobe{glass(eta, a, a), {Rgb(0.9f)}, {}});
      lobes.push_back(CoatedConductorLobe{glass(eta, a, a), metal(a, 0.1f), coat});
      if (eta < 1 && a > 1e-3f) continue;  // not as a clear coat
      const CoatShares& shares = kept.emplace_back(coat_shares(glass(eta, a, a), 10 * a));
      lobes.push_back(ClearCoatLobe(glass(eta, a, a), Rgb(a), {.thickness = 10 * a}, shares));
    }
  }
  for (const Bsdf::Lobe& lobe : lobes) {
    const Bsdf bsdf(Frame{}, lobe);
    for (int n = 0; n < 1500; ++n) {
      const Vec3 wo = direction();
      const Vec3 wi = n % 5 == 0 ? -wo : n % 5 == 1 ? wo : direction();
      const Rgb value = bsdf.eval(wo, wi);
      const float pdf = bsdf.pdf(wo, wi);
      CAPTURE(lobe.index());
      CAPTURE(wo.z);
      CAPTURE(wi.z);
      REQUIRE(is_finite(value));
      REQUIRE(std::isfinite(pdf));
      REQUIRE(std::min({value.r, value.g, value.b, pdf}) >= 0);
      const float uc = n % 7 == 0 ? kOneMinusEpsilon : random();
      const Vec2 u = n % 11 == 0 ? Vec2{} : n % 13 == 0 ? Vec2{kOneMinusEpsilon, kOneMinusEpsilon} : random.pair();
      if (const auto s = bsdf.sample(wo, uc, u)) {
        REQUIRE(is_finite(s->weight));
        REQUIRE(std::isfinite(s->pdf));
        REQUIRE(s->pdf > 0);
        REQUIRE(std::min({s->weight.r, s->weight.g, s->weight.b}) >= 0);
        REQUIRE(length(s->wi) == doctest::Approx(1).epsilon(1e-5));
      }
      if (n % 100 == 0) REQUIRE(is_finite(bsdf.albedo(wo)));
    }
  }
}
