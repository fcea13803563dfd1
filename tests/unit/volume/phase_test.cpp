#include "volume/phase/phase.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/rng.h"
#include "support/chi_squared.h"
#include "volume/phase/phase_mix.h"

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

TEST_CASE("phase functions are finite at their ends and for every random number") {
  Rng rng(2);
  std::vector<Phase> phases{Rayleigh{}};
  for (const float g : {0.f, 1e-4f, -1e-4f, 1e-30f, .9f, -.9f, .99f, -.99f, .999f, -.999f, 1.f, -1.f}) {
    phases.push_back(HenyeyGreenstein{g});
    for (const float alpha : {0.f, 1e-30f, 1.f, 250.f}) phases.push_back(Draine(g, alpha));
  }
  for (const float d : {0.01f, 0.1f, 0.11f, 1.f, 1.49f, 1.5f, 4.99f, 5.f, 50.f}) phases.push_back(Mie(d));
  std::vector<Vec3> directions{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 94; ++i) directions.push_back(random_direction(rng));
  for (const Phase& phase : phases) {
    int unsound = 0;
    for (const float u : {0.f, 0x1p-24f, .5f, kOneMinusEpsilon}) {
      for (const float v : {0.f, .25f, kOneMinusEpsilon}) {
        for (const Vec3 wo : directions) {
          const PhaseSample s = sample(phase, wo, {u, v});
          const bool sound = std::abs(length(s.wi) - 1) < 1e-5f && std::isfinite(s.pdf) && s.pdf > 0;
          unsound += sound && std::isfinite(pdf(phase, wo, wo)) && std::isfinite(pdf(phase, wo, -wo)) ? 0 : 1;
        }
      }
    }
    CHECK_MESSAGE(unsound == 0, "kind " << phase.index() << ", mean cosine " << mean_cosine(phase));
  }
}

namespace {

/// Of `f` over the cosine, weighted by the density: Gauss's rule of two points in steps that are finer forward.
template <typename F>
double over_cosines(const Phase& phase, const F& f) {
  constexpr int kSteps = 200'000;
  double sum = 0;
  double low = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const double high = 2 * std::pow(static_cast<double>(i) / kSteps, 4);  // 1 - cos
    for (const double at : {0.2113248654051871, 0.7886751345948129}) {
      const double x = low + at * (high - low), sine = std::sqrt(x * (2 - x));
      const Vec3 wo{0, 0, -1}, wi{static_cast<float>(sine), 0, static_cast<float>(1 - x)};
      sum += 0.5 * (high - low) * 2 * 3.14159265358979323846 * pdf(phase, wo, wi) * f(1 - x);
    }
    low = high;
  }
  return sum;
}

const Phase kOthers[] = {Rayleigh{},
                         Draine(0, 3),
                         Draine(0.4f, 0),
                         Draine(0.4f, 1),
                         Draine(-0.7f, 1),
                         Draine(0.9f, 250),
                         Draine(2e-4f, 50),
                         Draine(-0.02f, 250),
                         Mie(0.05f),
                         Mie(0.3f),
                         Mie(1.2f),
                         Mie(3),
                         Mie(5),
                         Mie(10),
                         Mie(50)};

}  // namespace

TEST_CASE("samples of every phase function follow its density") {
  const Vec3 wo = normalize({0.3f, -0.5f, 0.8f});
  for (const Phase& phase : kOthers) {
    test::ChiSquaredOptions options;
    const float c = mean_cosine(phase);
    options.axis = c >= 0 ? -wo : wo;
    options.theta_power = std::abs(c) > 0.8f ? 4 : std::abs(c) > 0.4f ? 2 : 1;
    options.alpha = test::sidak(1e-3, std::size(kOthers));
    const auto result = test::chi_squared_test(
        [&](const test::Uniform& random) -> std::optional<Vec3> {
          const float u = random();
          return sample(phase, wo, {u, random()}).wi;
        },
        [&](Vec3 wi) { return pdf(phase, wo, wi); }, options);
    CHECK_MESSAGE(result.passed, "kind " << phase.index() << ", mean cosine " << c << ": " << result.summary());
  }
}

TEST_CASE("phase functions integrate to 1, and their mean cosine is the one they state") {
  for (const Phase& phase : kOthers) {
    CAPTURE(phase.index());
    CHECK(over_cosines(phase, [](double) { return 1.0; }) == doctest::Approx(1).epsilon(1e-4));
    CHECK(over_cosines(phase, [](double c) { return c; }) == doctest::Approx(mean_cosine(phase)).epsilon(2e-4));
  }
}

TEST_CASE("Draine's is HG for alpha = 0, Rayleigh's for g = 0 and alpha = 1; Mie's means are the published fit's") {
  Rng rng(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 wo = random_direction(rng), wi = random_direction(rng);
    CHECK(Draine(0.6f, 0).pdf(wo, wi) == HenyeyGreenstein{0.6f}.pdf(wo, wi));
    CHECK(Draine(0, 1).pdf(wo, wi) == doctest::Approx(Rayleigh{}.pdf(wo, wi)).epsilon(1e-6));
  }
  // Mean cosines of the fit, integrated by others.
  for (const auto& [diameter, mean] : {std::pair{5.0f, 0.843}, {10.0f, 0.864}, {20.0f, 0.879}, {50.0f, 0.891}})
    CHECK(Mie(diameter).mean_cosine() == doctest::Approx(mean).epsilon(6e-4));
  CHECK(Phase(Mie(5)) == Phase(Mie(5)));
  CHECK_FALSE(Phase(Mie(5)) == Phase(Mie(6)));
  CHECK_FALSE(Phase(Draine(0, 1)) == Phase(Rayleigh{}));
}

TEST_CASE("a mixture samples its own density, per-channel weights average to the value") {
  PhaseMix mix;
  const Phase forward = HenyeyGreenstein{0.8f}, same = HenyeyGreenstein{0.8f}, back = HenyeyGreenstein{-0.5f},
              even = Rayleigh{}, other = Draine(0.1f, 2);
  mix.add({1, 0.2f, 0}, forward);
  mix.add({0.1f, 2, 0}, back);
  mix.add({0.3f, 0.3f, 0}, same);  // joins the first lobe
  mix.add({0, 0, 0}, even);        // is nothing
  mix.add({0.4f, 0.7f, 0}, other);
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
