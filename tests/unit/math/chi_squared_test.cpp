#include "support/chi_squared.h"

#include <doctest/doctest.h>

#include "math/warp.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

std::optional<Vec3> draw_cosine(const Uniform& random) {
  const float u = random(), v = random();
  return square_to_cosine_hemisphere({u, v});
}

}  // namespace

TEST_CASE("the incomplete gamma function gives tabulated tails of the chi-squared distribution") {
  CHECK(chi_squared_tail(3.841458820694124, 1) == doctest::Approx(0.05).epsilon(1e-10));
  CHECK(chi_squared_tail(18.30703805327515, 10) == doctest::Approx(0.05).epsilon(1e-10));
  CHECK(chi_squared_tail(149.4492527790678, 100) == doctest::Approx(0.001).epsilon(1e-9));
  CHECK(chi_squared_tail(67.32756330547956, 100) == doctest::Approx(0.995).epsilon(1e-9));
  CHECK(upper_gamma(1, 2.5) == doctest::Approx(std::exp(-2.5)).epsilon(1e-13));
  CHECK(chi_squared_tail(0, 5) == 1);
}

TEST_CASE("Sidak's level of one test gives the level of the family") {
  CHECK(1 - std::pow(1 - sidak(1e-3, 50), 50) == doctest::Approx(1e-3).epsilon(1e-9));
}

TEST_CASE("the stated power is that of the noncentral chi-squared distribution") {
  // Two-sided z-test: one degree of freedom, level 0.05, power 0.8 needs (1.959964 + 0.841621)^2.
  CHECK(detectable_noncentrality(1, 0.05, 0.8) == doctest::Approx(7.848861).epsilon(1e-5));
}

TEST_CASE("quadrature finds the integral of wide, narrow and cut densities") {
  CHECK(integrate_over_sphere([](Vec3) { return 1.0; }) == doctest::Approx(4 * 3.14159265358979324).epsilon(1e-9));
  CHECK(integrate_over_sphere([](Vec3 w) { return cosine_hemisphere_pdf(w); }) == doctest::Approx(1).epsilon(1e-6));
  const Vec3 tilted = normalize(Vec3{1, 2, -1});
  const auto cap = [&](Vec3 w) { return dot(w, tilted) > 0.9f ? 1 / (2 * double(kPi) * 0.1) : 0; };
  CHECK(integrate_over_sphere(cap) == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("correct samplers fail as often as alpha says") {
  int rejected = 0;
  double mean_p = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto r = chi_squared_test(draw_cosine, [](Vec3 w) { return cosine_hemisphere_pdf(w); },
                                    {.samples = 20'000, .theta_bins = 12, .phi_bins = 16, .alpha = 0.1, .seed = seed});
    rejected += r.passed ? 0 : 1;
    mean_p += r.p_value / 100;
  }
  // Binomial(100, 0.1) lies in [1, 24] with probability 0.9999; the mean of 100 uniform p has deviation 0.029.
  CHECK(rejected >= 1);
  CHECK(rejected <= 24);
  CHECK(std::abs(mean_p - 0.5) < 4 * 0.029);
}

TEST_CASE("wrong samplers are found out") {
  const auto cosine = [](Vec3 w) { return double(cosine_hemisphere_pdf(w)); };

  SUBCASE("another distribution") {
    const auto uniform = [](const Uniform& random) -> std::optional<Vec3> {
      const float u = random(), v = random();
      return square_to_uniform_hemisphere({u, v});
    };
    CHECK_FALSE(chi_squared_test(uniform, cosine).passed);
  }
  SUBCASE("a deviation as small as the one it says it finds") {
    const auto r = chi_squared_test(draw_cosine, cosine);
    REQUIRE(r.passed);
    const double d = r.detectable_deviation;  // a factor 1 + d on one half of the azimuths, 1 - d on the other
    const auto lopsided = [&](Vec3 w) { return cosine(w) * (w.y > 0 ? 1 + d : 1 - d); };
    CHECK_FALSE(chi_squared_test(draw_cosine, lopsided).passed);
  }
  SUBCASE("samples that are lost") {
    const auto leaky = [](const Uniform& random) -> std::optional<Vec3> {
      if (random() < 0.02f) return std::nullopt;
      return draw_cosine(random);
    };
    CHECK_FALSE(chi_squared_test(leaky, cosine).passed);
    CHECK(chi_squared_test(leaky, [&](Vec3 w) { return 0.98 * cosine(w); }).passed);
  }
  SUBCASE("samples where the density is zero") {
    const auto stray = [](const Uniform& random) -> std::optional<Vec3> {
      auto w = draw_cosine(random);
      if (random() < 2e-5f) w->z = -w->z;
      return w;
    };
    const auto r = chi_squared_test(stray, cosine);
    CHECK(r.impossible > 0);
    CHECK_FALSE(r.passed);
  }
}
