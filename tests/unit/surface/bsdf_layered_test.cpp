/// Coated materials: the walk of sample() against the walk of eval(), furnaces, reciprocity.
#include <doctest/doctest.h>

#include <array>

#include "math/hash.h"
#include "math/warp.h"
#include "support/relative.h"
#include "unit/surface/bsdf_cases.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Coat kThin{.thickness = 0.01f};
constexpr Coat kMilky{.thickness = 0.6f, .albedo = {0.8f, 0.8f, 0.8f}, .g = 0.4f, .max_depth = 12};

struct LayeredCase {
  std::string name;
  Bsdf::Lobe lobe;
};

std::vector<LayeredCase> layered_cases() {
  return {{"diffuse, smooth coat", CoatedDiffuseLobe{glass(1.5f, 0, 0), {Rgb(0.7f)}, kThin}},
          {"diffuse, rough coat", CoatedDiffuseLobe{glass(1.5f, 0.45f, 0.45f), {Rgb(0.5f)}, kThin}},
          {"diffuse, milky rough coat", CoatedDiffuseLobe{glass(1.5f, 0.3f, 0.3f), {Rgb(0.7f)}, kMilky}},
          {"diffuse, milky smooth coat", CoatedDiffuseLobe{glass(1.5f, 0, 0), {Rgb(0.7f)}, kMilky}},
          {"metal, rough coat", CoatedConductorLobe{glass(1.5f, 0.32f, 0.32f), metal(0.45f, 0.45f), kThin}},
          {"metal, smooth coat", CoatedConductorLobe{glass(1.5f, 0, 0), metal(0.4f, 0.25f), kThin}},
          {"mirror, rough coat", CoatedConductorLobe{glass(1.4f, 0.4f, 0.4f), metal(0, 0), kThin}},
          {"diffuse, one bounce", CoatedDiffuseLobe{glass(1.5f, 0.45f, 0.45f), {Rgb(0.7f)}, {.max_depth = 1}}},
          {"diffuse, milky, three bounces",
           CoatedDiffuseLobe{glass(1.5f, 0.4f, 0.4f), {Rgb(0.7f)}, {.thickness = 1, .albedo = Rgb(0.9f), .max_depth = 3}}}};
}

/// The same lobe at another surface point: walks are independent between seeds.
Bsdf with_seed(Bsdf::Lobe lobe, std::uint64_t seed) {
  if (auto* l = std::get_if<CoatedDiffuseLobe>(&lobe)) l->coat.seed = seed;
  if (auto* l = std::get_if<CoatedConductorLobe>(&lobe)) l->coat.seed = seed;
  return {Frame{}, lobe};
}

/// Test functions of wi: power, a tilt, the horizon, and the neighbourhood of the mirror direction of wo.
std::array<double, 4> moments(Vec3 wo, Vec3 wi) {
  const Vec3 mirror{-wo.x, -wo.y, wo.z};
  return {1, 1 + 0.9 * wi.x, wi.z < 0.3f ? 1.0 : 0.0, dot(mirror, wi) > 0.9f ? 1.0 : 0.0};
}

}  // namespace

TEST_CASE("the mean weight of samples is the integral of the mean value") {
  for (const LayeredCase& c : layered_cases())
    for (const Vec3 wo : {polar(15, 40), polar(65, 0)}) {
      std::array<Estimate, 4> sampled, integrated;
      TestRandom random(21);
      for (std::uint64_t n = 0; n < 150'000; ++n) {
        const Bsdf bsdf = with_seed(c.lobe, n);

        const auto s = bsdf.sample(wo, random(), random.pair());
        const bool counts = s && !s->specular;
        const auto m = counts ? moments(wo, s->wi) : std::array<double, 4>{};
        for (std::size_t i = 0; i < 4; ++i) sampled[i].add(counts ? m[i] * double(s->weight.g) : 0.0);

        const Vec3 wi = square_to_cosine_hemisphere(random.pair());
        const double value = double(bsdf.eval(wo, wi).g / cosine_hemisphere_pdf(wi));
        const auto e = moments(wo, wi);
        for (std::size_t i = 0; i < 4; ++i) integrated[i].add(e[i] * value);
      }
      for (std::size_t i = 0; i < 4; ++i) {
        CAPTURE(c.name);
        CAPTURE(wo.z);
        CAPTURE(i);
        const double error = std::hypot(sampled[i].error(), integrated[i].error());
        const double difference = sampled[i].mean() - integrated[i].mean();
        // 4.5 standard errors: 72 comparisons fail together with probability 5e-4.
        CHECK_MESSAGE(std::abs(difference) < 4.5 * error, sampled[i].mean(), " against ", integrated[i].mean(), " +- ", error);
        // Power: a difference of 6.5 errors, here below 10 % of the whole, is found with probability 0.98.
        CHECK(6.5 * error < 0.10 * sampled[0].mean());
      }
    }
}

TEST_CASE("furnaces: nothing is gained, and a white coat without loss gives everything back") {
  TestRandom random(31);
  const auto power = [&](const Bsdf::Lobe& lobe, Vec3 wo) {
    Estimate estimate;
    for (std::uint64_t n = 0; n < 40'000; ++n) {
      const auto s = with_seed(lobe, n).sample(wo, random(), random.pair());
      estimate.add(s ? double(s->weight.g) : 0.0);
    }
    return estimate;
  };
  const ConductorLobe white{.ggx = Ggx(0.3f, 0.3f), .eta = Rgb(1.0f), .k = conductor_k(Rgb(1.0f))};
  for (const Vec3 wo : {polar(0, 0), polar(60, 10), polar(85, 200), polar(120, 30)}) {
    CAPTURE(wo.z);
    for (const float a : {0.0f, 0.1f, 0.5f}) {
      const Coat milk{.thickness = 2, .albedo = Rgb(1.0f), .g = 0.5f, .max_depth = 1000};
      for (const Bsdf::Lobe& lobe : {Bsdf::Lobe(CoatedDiffuseLobe{glass(1.5f, a, a), {Rgb(1.0f)}, milk}),
                                     Bsdf::Lobe(CoatedDiffuseLobe{glass(1.5f, a, a), {Rgb(1.0f)}, kThin}),
                                     Bsdf::Lobe(CoatedConductorLobe{glass(1.5f, a, a), white, milk})}) {
        const Estimate p = power(lobe, wo);
        CHECK(p.mean() < 1 + 4.5 * p.error());
      }
    }
    for (const Coat& coat : {Coat{.thickness = 1e-20f, .max_depth = 1000},
                             Coat{.thickness = 2, .albedo = Rgb(1.0f), .g = 0.5f, .max_depth = 1000}}) {
      const Estimate p = power(CoatedDiffuseLobe{glass(1.5f, 0, 0), {Rgb(1.0f)}, coat}, wo);
      CHECK(std::abs(p.mean() - 1) < 4.5 * p.error() + 1e-4);
      CHECK(6.5 * p.error() < 0.05);
    }
  }
}

TEST_CASE("coated surfaces are reciprocal in the mean") {
  for (const LayeredCase& c : layered_cases()) {
    const Vec3 a = polar(25, 10), b = polar(60, 150);
    Estimate forth, back;
    for (std::uint64_t n = 0; n < 100'000; ++n) {
      forth.add(double(with_seed(c.lobe, n).eval(a, b).g / b.z));
      back.add(double(with_seed(c.lobe, n + 1'000'000).eval(b, a).g / a.z));
    }
    CAPTURE(c.name);
    const double error = std::hypot(forth.error(), back.error());
    CHECK(std::abs(forth.mean() - back.mean()) < 4.5 * error);
    CHECK(6.5 * error < 0.12 * forth.mean());
  }
}

TEST_CASE("MIS with the stand-in density is unbiased") {
  // A bright patch, found from a uniform hemisphere and from BSDF samples, each weighted with pdf().
  const auto light = [](Vec3 w) { return dot(w, polar(50, 180)) > 0.95f ? 10.0 : 0.2; };
  const Vec3 wo = polar(45, 0);
  for (const LayeredCase& c : layered_cases()) {
    TestRandom random(41);
    Estimate plain, combined;
    for (std::uint64_t n = 0; n < 100'000; ++n) {
      const Bsdf bsdf = with_seed(c.lobe, n);
      const Vec3 wi = square_to_uniform_hemisphere(random.pair());
      const double p = double(uniform_hemisphere_pdf(wi));
      const double value = light(wi) * double(bsdf.eval(wo, wi).g) / p;
      plain.add(value);
      double sum = value * p / (p + double(bsdf.pdf(wo, wi)));
      if (const auto s = bsdf.sample(wo, random(), random.pair()); s && !s->specular)
        sum += light(s->wi) * double(s->weight.g) * double(s->pdf) / (double(s->pdf) + p);
      combined.add(sum);
    }
    CAPTURE(c.name);
    const double error = std::hypot(plain.error(), combined.error());
    CHECK(std::abs(plain.mean() - combined.mean()) < 4.5 * error);
    CHECK(combined.error() < 1.1 * plain.error());
    CHECK(6.5 * error < 0.15 * plain.mean());
  }
}

TEST_CASE("the stand-in density is positive where there is light and near one in sum") {
  TestRandom random(51);
  for (const LayeredCase& c : layered_cases())
    for (const Vec3 wo : {polar(10, 0), polar(70, 20)}) {
      const Bsdf bsdf = with_seed(c.lobe, 1);
      Estimate smooth, integral;
      for (int n = 0; n < 20'000; ++n) {
        const auto s = bsdf.sample(wo, random(), random.pair());
        smooth.add(s && !s->specular ? 1 : 0);
        if (s && !s->specular) CHECK(s->pdf == test::relative(bsdf.pdf(wo, s->wi)).epsilon(1e-3));
        const Vec3 wi = square_to_cosine_hemisphere(random.pair());
        CHECK(bsdf.pdf(wo, wi) > 0);
        integral.add(double(bsdf.pdf(wo, wi) / cosine_hemisphere_pdf(wi)));
      }
      CAPTURE(c.name);
      CHECK(integral.mean() < 1.05);
      CHECK(integral.mean() > 0.7 * smooth.mean());
    }
}

TEST_CASE("coated surfaces repeat themselves, are opaque and alike from both sides") {
  for (const LayeredCase& c : layered_cases()) {
    const Bsdf bsdf = with_seed(c.lobe, 77);
    const Vec3 a = polar(25, 10), b = polar(60, 150);
    CAPTURE(c.name);
    CHECK(bsdf.eval(a, b) == bsdf.eval(a, b));
    CHECK(bsdf.eval(-a, -b) == bsdf.eval(a, b));
    CHECK(bsdf.pdf(-a, -b) == bsdf.pdf(a, b));
    CHECK(is_black(bsdf.eval(a, -b)));
    CHECK_FALSE(bsdf.transmits());
    const auto above = bsdf.sample(a, 0.9f, {0.3f, 0.6f}), below = bsdf.sample(-a, 0.9f, {0.3f, 0.6f});
    REQUIRE(above.has_value() == below.has_value());
    if (above) CHECK(above->wi == -below->wi);
  }
  CHECK_FALSE(Bsdf({}, CoatedConductorLobe{glass(1.5f, 0, 0), metal(0, 0), kThin}).has_smooth());
  CHECK(Bsdf({}, CoatedConductorLobe{glass(1.5f, 0, 0), metal(0, 0), kMilky}).has_smooth());
}
