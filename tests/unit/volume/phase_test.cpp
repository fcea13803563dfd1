#include "volume/phase.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/rng.h"
#include "support/chi_squared.h"
#include "volume/phase_mix.h"

using namespace tyndall;

namespace {

Vec3 random_direction(Rng& rng) {
  const float z = 1 - 2 * rng.uniform(), phi = 2 * kPi * rng.uniform(), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

const float kGs[] = {0, 1e-4f, -1e-4f, 0.3f, -0.3f, 0.9f, -0.9f, 0.99f, -0.99f, 0.999f, -0.999f};

/// HG in double precision by its textbook form.
double textbook(double g, double cosine) {
  return (1 - g * g) / (4 * 3.14159265358979323846 * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

}  // namespace

TEST_CASE("HG samples follow its density") {
  const Vec3 wo = normalize({0.3f, -0.5f, 0.8f});
  for (const float g : kGs) {
    const HenyeyGreenstein phase{g};
    test::ChiSquaredOptions options;
    options.axis = g >= 0 ? -wo : wo;
    options.theta_power = std::abs(g) > 0.95f ? 4 : std::abs(g) > 0.5f ? 2 : 1;
    options.alpha = test::sidak(1e-3, 11);
    const auto result = test::chi_squared_test(
        [&](const test::Uniform& random) -> std::optional<Vec3> {
          const float u = random();
          return phase.sample(wo, {u, random()}).wi;
        },
        [&](Vec3 wi) { return phase.pdf(wo, wi); }, options);
    CHECK_MESSAGE(result.passed, "g = " << g << ": " << result.summary());
    CHECK(result.density_integral == doctest::Approx(1).epsilon(2e-3));
  }
}

TEST_CASE("HG agrees with its textbook form, has mean cosine g and points forward for g > 0") {
  Rng rng(1);
  for (const float g : kGs) {
    const HenyeyGreenstein phase{g};
    double sum = 0, sum2 = 0;
    constexpr int kCount = 100000;
    int different = 0;
    double worst = 0;
    for (int i = 0; i < kCount; ++i) {
      const Vec3 wo = random_direction(rng);
      const PhaseSample s = phase.sample(wo, {rng.uniform(), rng.uniform()});
      const double cosine = -(double{wo.x} * s.wi.x + double{wo.y} * s.wi.y + double{wo.z} * s.wi.z) /
                            std::sqrt(double{length_squared(wo)} * length_squared(s.wi));
      sum += cosine;
      sum2 += cosine * cosine;
      different += s.pdf != phase.pdf(wo, s.wi) ? 1 : 0;
      if (std::abs(g) < 0.95f) worst = std::max(worst, std::abs(s.pdf / textbook(g, cosine) - 1));
    }
    CHECK(different == 0);
    CHECK(worst < 1e-4);
    const double mean = sum / kCount, deviation = std::sqrt((sum2 / kCount - mean * mean) / kCount);
    CHECK(std::abs(mean - g) < 4 * deviation + 1e-6);
  }
}

TEST_CASE("HG is finite for every g in [-1, 1] and every random number") {
  Rng rng(2);
  for (const float g : {0.f, 1e-4f, -1e-4f, 1e-30f, .9f, -.9f, .99f, -.99f, .999f, -.999f, 1.f, -1.f})
    for (const float u : {0.f, 0x1p-24f, .5f, kOneMinusEpsilon})
      for (const float v : {0.f, .25f, kOneMinusEpsilon})
        for (int i = 0; i < 100; ++i) {
          const Vec3 wo = i < 6 ? Vec3{i == 0   ? 1.f
                                       : i == 1 ? -1.f
                                                : 0.f,
                                       i == 2   ? 1.f
                                       : i == 3 ? -1.f
                                                : 0.f,
                                       i == 4   ? 1.f
                                       : i == 5 ? -1.f
                                                : 0.f}
                                : random_direction(rng);
          const PhaseSample s = HenyeyGreenstein{g}.sample(wo, {u, v});
          CHECK(std::abs(length(s.wi) - 1) < 1e-5f);
          CHECK(std::isfinite(s.pdf));
          CHECK(s.pdf > 0);
          CHECK(std::isfinite(HenyeyGreenstein{g}.pdf(wo, wo)));
          CHECK(std::isfinite(HenyeyGreenstein{g}.pdf(wo, -wo)));
        }
}

TEST_CASE("a mixture samples its own density, per-channel weights average to the value") {
  PhaseMix mix;
  mix.add({1, 0.2f, 0}, 0.8f);
  mix.add({0.1f, 2, 0}, -0.5f);
  mix.add({0.3f, 0.3f, 0}, 0.8f);  // joins the first lobe
  mix.add({0, 0, 0}, 0.1f);        // is nothing
  mix.add({0.4f, 0.7f, 0}, 0.1f);
  CHECK(mix.lobe_count() == 3);

  const Vec3 wo = normalize({1, 2, -2});
  const Rgb beta{0.5f, 3, 1};
  const auto result = test::chi_squared_test(
      [&](const test::Uniform& random) -> std::optional<Vec3> {
        const float uc = random(), u = random();
        return mix.sample(wo, beta, uc, {u, random()})->wi;
      },
      [&](Vec3 wi) { return mix.pdf(wo, wi, beta); }, {.axis = wo});
  CHECK_MESSAGE(result.passed, result.summary());

  // sum p_i sigma_i / sum sigma_i integrates to 1 in channels that scatter.
  Rng rng(3);
  double r = 0, g = 0;
  int wrong = 0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const auto s = mix.sample(wo, beta, rng.uniform(), {rng.uniform(), rng.uniform()});
    const Rgb value = mix.eval(wo, s->wi);
    wrong += std::abs(s->weight.r * s->pdf / value.r - 1) < 1e-4f && s->weight.b == 0 ? 0 : 1;
    r += s->weight.r;
    g += s->weight.g;
  }
  CHECK(wrong == 0);
  CHECK(r / kCount == doctest::Approx(1).epsilon(0.02));
  CHECK(g / kCount == doctest::Approx(1).epsilon(0.02));
  CHECK_FALSE(mix.sample(wo, {0, 0, 1}, 0.5f, {0.5f, 0.5f}).has_value());
  CHECK_FALSE(PhaseMix{}.sample(wo, beta, 0.5f, {0.5f, 0.5f}).has_value());
}
