#include "math/warp.h"

#include <doctest/doctest.h>

#include "math/rng.h"
#include "support/chi_squared.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

const double kAlpha = sidak(1e-3, 9);

template <typename Warp>
DirectionSampler sampler(const Warp& warp) {
  return [=](const Uniform& random) -> std::optional<Vec3> {
    const float u = random(), v = random();
    return warp(Vec2{u, v});
  };
}

}  // namespace

TEST_CASE("hemispheres and the sphere follow their densities") {
  const auto test = [](auto warp, auto pdf) {
    const auto r = chi_squared_test(sampler(warp), [&](Vec3 w) { return pdf(w); }, {.alpha = kAlpha});
    CHECK_MESSAGE(r.passed, r.summary());
    CHECK(r.density_integral == doctest::Approx(1).epsilon(2e-4));
  };
  test(square_to_uniform_hemisphere, uniform_hemisphere_pdf);
  test(square_to_cosine_hemisphere, cosine_hemisphere_pdf);
  test(square_to_uniform_sphere, uniform_sphere_pdf);
}

TEST_CASE("cones of every width follow their densities") {
  for (const float h : {1e-6f, 1e-3f, 0.3f, 1.0f, 1.9f}) {
    CAPTURE(h);
    // Gather the bins so that about a third of them lie in the cone.
    const double share = std::acos(1 - std::min(1.0, double(h))) / double(kPi);
    const auto r = chi_squared_test(sampler([h](Vec2 u) { return square_to_uniform_cone(u, h); }),
                                    [h](Vec3 w) { return uniform_cone_pdf(w, h); },
                                    {.theta_bins = 32, .theta_power = std::max(1.0, -std::log(share)), .alpha = kAlpha});
    CHECK_MESSAGE(r.passed, r.summary());
  }
}

TEST_CASE("the concentric disk covers the disk evenly") {
  // Rings and sectors of equal area.
  constexpr int n = 200'000, cells = 64;
  std::array<int, cells> counts{};
  Rng rng(3);
  for (int i = 0; i < n; ++i) {
    const float u = rng.uniform(), v = rng.uniform();
    const Vec2 p = square_to_concentric_disk({u, v});
    const float r2 = p.x * p.x + p.y * p.y;
    const float turn = std::atan2(p.y, p.x) / (2 * kPi) + 0.5f;
    counts[std::size_t(std::min(7.0f, r2 * 8)) * 8 + std::size_t(std::min(7.0f, turn * 8))]++;
    REQUIRE(concentric_disk_pdf(p * 0.999999f) == kInvPi);
  }
  double statistic = 0;
  for (const int c : counts) statistic += (c - n / cells) * (c - n / cells) / (double(n) / cells);
  CHECK(chi_squared_tail(statistic, cells - 1) > kAlpha);
  CHECK(concentric_disk_pdf({0.8f, 0.7f}) == 0);
}

TEST_CASE("warps give unit vectors on their side at the corners of the square") {
  for (const float x : {0.0f, 0.5f, kOneMinusEpsilon})
    for (const float y : {0.0f, 0.5f, kOneMinusEpsilon}) {
      for (const Vec3 w :
           {square_to_uniform_hemisphere({x, y}), square_to_cosine_hemisphere({x, y}), square_to_uniform_cone({x, y}, 1e-7f)}) {
        CHECK(length(w) == doctest::Approx(1).epsilon(1e-6));
        CHECK(w.z >= 0);
      }
      CHECK(length(square_to_uniform_sphere({x, y})) == doctest::Approx(1).epsilon(1e-6));
    }
}

TEST_CASE("directions of a narrow cone keep their digits") {
  const float h = 1e-8f;  // half angle 1.4e-4: the cosine alone would round to 1
  const Vec3 w = square_to_uniform_cone({0.25f, 0}, h);
  CHECK(w.x == doctest::Approx(std::sqrt(2 * 0.25 * double(h))).epsilon(1e-6));
  CHECK(uniform_cone_pdf(w, h) > 0);
  CHECK(uniform_cone_pdf(normalize(Vec3{2e-4f, 0, 1}), h) == 0);
}
