#include "volume/aureole.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/chi_squared.h"
#include "volume/phase/lobe_product.h"

namespace tyndall {
namespace {

const Vec3 kSun = normalize({0.3f, 0.9f, -0.2f}), kOther = normalize({-0.8f, 0.1f, 0.5f});

Aureole cloud(float g, float depth) {
  Aureole aureole({g, 0.99f}, 0.5f);
  aureole.add({kSun, 10, 0.9999f, depth});
  return aureole;
}

/// Two suns, one of them spread widely, behind different amounts of a medium.
Aureole between_two_suns() {
  Aureole aureole = cloud(0.8f, 3);
  aureole.add({kOther, 5, 0.9f, 0.7f});
  return aureole;
}

struct Mixed {
  Phase forward = HenyeyGreenstein{0.8f}, back = HenyeyGreenstein{-0.3f}, drops = Mie(12);
  PhaseMix phase;
  Mixed() {
    phase.add({3, 2, 1}, forward);
    phase.add({1, 1, 2}, back);
    phase.add({0.5f, 1, 1}, drops);
  }
};

double integral(const test::DirectionDensity& f, Vec3 axis) {
  return test::integrate_over_sphere(f, {.axis = axis, .theta_power = 3});
}

TEST_CASE("an aureole holds the light of its sun that was scattered, and even light") {
  for (const float depth : {0.01f, 0.3f, 3.0f, 20.0f, 60.0f}) {
    const double all = integral([aureole = cloud(0.85f, depth)](Vec3 w) { return aureole.radiance(w); }, kSun);
    const double g = 0.85, scattered = std::exp(-0.01 * depth) - std::exp(-depth);
    // docs/methods.md: what came from elsewhere, 1/4 and albedo^(1 / (1 - g)) of the sun, and what was scattered.
    CHECK(all == doctest::Approx(0.5 + 10 * (0.25 + std::pow(0.99, 1 / (1 - g)) + scattered)).epsilon(2e-3));
  }
}

TEST_CASE("what is scattered once is the phase function around the sun") {
  const Aureole thin = cloud(0.6f, 1e-3f);
  const HenyeyGreenstein phase{0.6f * 0.9999f};
  const auto shaped = [&](Vec3 w) {
    return thin.radiance(w) - thin.radiance(-kSun) + 10 * 1e-3 * 0.99 * phase.pdf(kSun, kSun);
  };
  for (const Vec3 w : {kSun, kOther, Vec3{1, 0, 0}})
    CHECK(shaped(w) == doctest::Approx(10 * 1e-3 * 0.99 * phase.pdf(-kSun, w)).epsilon(2e-2));
}

TEST_CASE("a path that can be scattered once more seeks what was scattered once") {
  Aureole all({0.85f, 0.99f}, 0), once({0.85f, 0.99f, 1}, 0);
  all.add({kSun, 10, 1, 3}), once.add({kSun, 10, 1, 3});
  const HenyeyGreenstein phase{0.85f};
  const double chance = 3 * 0.99 * std::exp(-3.0);
  const double even = once.radiance(-kSun) - 10 * chance * phase.pdf(kSun, kSun);
  for (const Vec3 w : {kSun, kOther, normalize(kSun + Vec3{0.3f, 0, 0})}) {
    CHECK(once.radiance(w) == doctest::Approx(even + 10 * chance * phase.pdf(-kSun, w)).epsilon(1e-4));
    CHECK(all.radiance(w) > once.radiance(w));
  }
}

TEST_CASE("the more doubt, the more a direction is the phase function's") {
  const Mixed mixed;
  const Vec3 wo = normalize(Vec3{1, -1, 1});
  float last = kInfinity;
  for (const float doubt : {1.0f, 10.0f, 100.0f, 1000.0f}) {
    Aureole aureole({0.85f, 0.99f}, 0.5f, doubt);
    aureole.add({kSun, 10, 0.9999f, 2});
    const float off = std::abs(aureole.pdf_ratio(mixed.phase, wo, kSun, Rgb(1)) - 1);
    CHECK(off < last);
    last = off;
  }
  CHECK(last < 0.1f);
}

TEST_CASE("the more often light was scattered, the less of its direction is left") {
  float last = 1e30f;
  for (const float depth : {1.0f, 2.0f, 4.0f, 8.0f, 16.0f, 32.0f}) {
    const Aureole aureole = cloud(0.85f, depth);
    const float contrast = aureole.radiance(kSun) / aureole.radiance(-kSun);
    CHECK(contrast < last);
    CHECK(contrast >= 1);
    last = contrast;
  }
}

TEST_CASE("nothing shows where light is scattered evenly, everywhere, or not at all") {
  CHECK(cloud(0.85f, 3).shows());
  CHECK_FALSE(cloud(0.1f, 3).shows());
  CHECK_FALSE(cloud(-0.8f, 3).shows());
  CHECK_FALSE(cloud(0.85f, 1e-4f).shows());
  CHECK_FALSE(cloud(0.5f, 79).shows());
  CHECK_FALSE(Aureole({0.9f, 0.9f}, 1).shows());
  CHECK_FALSE(cloud(0.85f, std::nanf("")).shows());
}

TEST_CASE("what a collision scatters of an aureole is their product's integral") {
  const Mixed mixed;
  const Aureole aureole = between_two_suns();
  for (const Vec3 wo : {-kSun, kSun, -kOther, normalize(Vec3{1, -1, 1})})
    for (const Rgb beta : {Rgb(1), Rgb{1, 0, 0}, Rgb{0, -0.2f, 3}}) {
      const auto product = [&](Vec3 w) { return double{aureole.radiance(w)} * mixed.phase.pdf(wo, w, beta); };
      CHECK(aureole.scattered(mixed.phase, wo, beta) == doctest::Approx(integral(product, -wo)).epsilon(5e-3));
    }
}

TEST_CASE("directions are drawn by the product of an aureole and the phase function") {
  const Mixed mixed;
  const Aureole aureole = between_two_suns();
  for (const Vec3 wo : {-kSun, kSun, -kOther, normalize(Vec3{1, -1, 1})})
    for (const Rgb beta : {Rgb(1), Rgb{0, 0, 2}}) {
      Rng rng(7);
      const float scattered = aureole.scattered(mixed.phase, wo, beta);
      const auto result = test::chi_squared_test(
          [&](const test::Uniform&) -> std::optional<Vec3> { return aureole.sample(mixed.phase, wo, beta, rng); },
          [&](Vec3 w) { return aureole.radiance(w) * mixed.phase.pdf(wo, w, beta) / scattered; },
          {.axis = kSun, .theta_power = 2, .alpha = test::sidak(1e-3, 8)});
      CHECK_MESSAGE(result.passed, result.summary());
    }
}

TEST_CASE("products of phase functions and lobes are drawn exactly, however narrow and far apart") {
  const Phase phases[] = {HenyeyGreenstein{0.85f}, HenyeyGreenstein{-0.6f}, Rayleigh{}, Draine(0.6f, 4), Mie(12)};
  for (const Phase& phase : phases)
    for (const float bundled : {0.2f, 0.9f, 0.97f})
      for (const Vec3 wo : {-kSun, kSun, kOther}) {
        Rng rng(11);
        const HenyeyGreenstein lobe{bundled};
        const auto product = [&](Vec3 w) { return double{pdf(phase, wo, w)} * lobe.pdf(-kSun, w); };
        const test::ChiSquaredOptions bins{.samples = 50'000, .axis = kSun, .theta_power = 3, .alpha = test::sidak(1e-3, 45)};
        const double all = test::integrate_over_sphere(product, bins);
        const auto result = test::chi_squared_test(
            [&](const test::Uniform&) -> std::optional<Vec3> {
              return sample_product(phase, wo, {kSun, bundled}, rng);
            },
            [&](Vec3 w) { return product(w) / all; }, bins);
        CHECK_MESSAGE(result.passed, result.summary());
      }
}

}  // namespace
}  // namespace tyndall
