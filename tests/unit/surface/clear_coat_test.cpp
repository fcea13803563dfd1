/// Clear coats in closed form against the walks of coats.
#include <doctest/doctest.h>

#include <array>
#include <deque>
#include <tuple>

#include "math/warp.h"
#include "support/chi_squared.h"
#include "support/relative.h"
#include "surface/fresnel.h"
#include "unit/surface/bsdf_cases.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

struct ClearCoatCase {
  DielectricLobe top;
  Coat coat;
};

const ClearCoatCase kSmooth{glass(1.5f, 0, 0), {.thickness = 0.01f}},
    kBubble{glass(0.7f, 0, 0), {.thickness = 0.1f, .max_depth = 6}},
    kRough{glass(1.5f, 0.3f, 0.3f), {.thickness = 0.05f, .max_depth = 12}};
const ClearCoatCase kCases[] = {kSmooth,
                                {glass(1.5f, 0, 0), {.thickness = 0.4f, .max_depth = 100}},
                                {glass(2.5f, 0, 0), {.thickness = 0.02f, .max_depth = 5}},
                                {glass(1.1f, 0, 0), {.thickness = 0.5f, .max_depth = 1}},
                                kBubble,
                                {glass(1.0f, 0, 0), {.thickness = 0.2f, .max_depth = 3}},
                                {glass(1.5f, 0, 0), {.thickness = 0.01f, .max_depth = 0}},
                                kRough,
                                {glass(1.5f, 0.05f, 0.05f), {.thickness = 0.01f}},
                                {glass(2.5f, 1, 1), {.thickness = 0.02f, .max_depth = 5}}};
constexpr Rgb kPaint{0.2f, 0.6f, 0.95f};

/// A walk, independent for each seed.
Bsdf walk(const ClearCoatCase& c, std::uint64_t seed) {
  Coat coat = c.coat;
  coat.seed = seed;
  return {Frame{}, CoatedDiffuseLobe{c.top, {kPaint}, coat}};
}

Bsdf closed(const ClearCoatCase& c) {
  static std::deque<CoatShares> kept;  // lobes refer to them
  return {Frame{}, ClearCoatLobe(c.top, kPaint, c.coat, kept.emplace_back(coat_shares(c.top, c.coat.thickness)))};
}

}  // namespace

TEST_CASE("shares of light in a clear coat are their integrals") {
  for (const float eta : {0.3f, 0.7f, 1.0f, 1.1f, 1.5f, 2.5f})
    for (const float t : {0.0f, 0.001f, 0.01f, 0.1f, 1.0f, 5.0f}) {
      constexpr int n = 200'000;
      double back = 0, out = 0;
      for (int i = 0; i < n; ++i) {
        const double c = (i + 0.5) / n, reflected = double{fresnel_dielectric(float(c), 1 / eta)};
        back += 2 * c * reflected * std::exp(-2 * double{t} / c) / n;
        out += 2 * c * (1 - reflected) * std::exp(-double{t} / c) / n * double{eta} * double{eta};
      }
      CAPTURE(eta);
      CAPTURE(t);
      const CoatShares shares = coat_shares(glass(eta, 0, 0), t);
      // Quadrature of 8 points is off by 7e-6 at most here; float Fresnel terms and the sum above by less.
      CHECK(std::abs(shares.back - back) < 2e-5);
      CHECK(std::abs(shares.out - out) < 2e-5);
    }
}

TEST_CASE("shares of light in a rough clear coat are means over its facets") {
  for (const auto& [eta, alpha, t] :
       {std::tuple{1.5f, 0.3f, 0.05f}, {1.5f, 0.05f, 0.01f}, {2.5f, 1.0f, 0.02f}, {1.1f, 0.5f, 0.3f}}) {
    const DielectricLobe top = glass(eta, alpha, alpha);
    const CoatShares shares = coat_shares(top, t);
    TestRandom random(5);
    const auto sent = [&, t = t](Vec3 wo, LobeMode::Sides sides) {
      const auto s = top.sample(wo, 0, random.pair(), {LobeMode::Transport::importance, sides});
      return s ? double{s->weight.r} * std::exp(-double{t} / std::abs(double{s->wi.z})) : 0.0;
    };
    Estimate back, out;
    for (int i = 0; i < 1'000'000; ++i) {
      const Vec3 w = square_to_cosine_hemisphere(random.pair());
      back.add(std::exp(-double{t} / double{w.z}) * sent(-w, LobeMode::Sides::reflection));
      out.add(sent(w, LobeMode::Sides::transmission));
    }
    CAPTURE(eta);
    CAPTURE(alpha);
    // 4.5 standard errors (together 3e-4 of each) and what quadrature is off by. Power: 0.3 % of light is found.
    CHECK(std::abs(shares.back - back.mean()) < 4.5 * back.error() + 2e-4);
    CHECK(std::abs(shares.out - out.mean()) < 4.5 * out.error() + 5e-4);
    CHECK(6.5 * std::max(back.error(), out.error()) < 3e-3);
  }
}

TEST_CASE("a clear coat's value is the mean of walks") {
  for (const ClearCoatCase& c : kCases)
    for (const auto& [o, i] : {std::pair{polar(20, 0), polar(50, 70)}, std::pair{polar(80, 0), polar(10, 30)}}) {
      CAPTURE(c.top.eta);
      CAPTURE(c.top.ggx.alpha_x());
      CAPTURE(c.coat.thickness);
      std::array<Estimate, 3> value;
      for (std::uint64_t n = 0; n < 20'000; ++n) {
        const Rgb f = walk(c, n).eval(o, i);
        for (int k = 0; k < 3; ++k) value[std::size_t(k)].add(double(f[k]));
      }
      const Rgb expected = closed(c).eval(o, i);
      for (int k = 0; k < 3; ++k) {
        const Estimate& e = value[std::size_t(k)];
        // 4.5 standard errors: 60 comparisons fail together with probability 5e-4.
        CHECK(std::abs(e.mean() - double(expected[k])) <= 4.5 * e.error() + 2e-5 * e.mean());
        // Power: a difference of 6.5 errors, here below 4 % but where rare walks are long, is found with probability 0.98.
        CHECK(6.5 * e.error() <= (k < 2 ? 0.04 : 0.1) * e.mean());
      }
    }
}

TEST_CASE("a clear coat's samples bring what walks bring, mirrored and even") {
  for (const ClearCoatCase& c : kCases)
    for (const Vec3 wo : {polar(15, 40), polar(75, 0), polar(120, 0)}) {
      std::array<Estimate, 2> mirrored, even;
      const Bsdf bsdf = closed(c);
      TestRandom random(23);
      for (std::uint64_t n = 0; n < 120'000; ++n) {
        const float uc = random();
        const Vec2 u = random.pair();
        for (const std::size_t at : {0, 1}) {
          const auto s = (at == 0 ? bsdf : walk(c, n)).sample(wo, uc, u);
          mirrored[at].add(s && s->specular ? double(s->weight.g) : 0);
          even[at].add(s && !s->specular ? double(s->weight.g) : 0);
          if (s) CHECK(s->wi.z * wo.z > 0);
        }
      }
      CAPTURE(c.top.eta);
      CAPTURE(c.top.ggx.alpha_x());
      CAPTURE(wo.z);
      const auto agree = [](const std::array<Estimate, 2>& e) {
        // 4.5 standard errors: 60 comparisons fail together with probability 5e-4.
        return std::abs(e[0].mean() - e[1].mean()) <= 4.5 * std::hypot(e[0].error(), e[1].error());
      };
      // One step more is allowed to walks that are sampled: where depth bounds them, the last may only leave.
      CHECK(agree(mirrored));
      CHECK(agree(even));
      // Power: a difference of 6.5 errors, here below 10 %, is found with probability 0.98.
      const double error = std::hypot(even[0].error() + mirrored[0].error(), even[1].error() + mirrored[1].error());
      CHECK(6.5 * error <= 0.1 * (even[0].mean() + mirrored[0].mean()));
      if (!c.top.is_specular()) continue;
      const double albedo = double{bsdf.albedo(wo).g};
      CHECK(std::abs(even[0].mean() + mirrored[0].mean() - albedo) <= 4.5 * (even[0].error() + mirrored[0].error()) + 2e-5);
    }
}

TEST_CASE("the even part of a clear coat follows its density, the mirror its probability") {
  const double alpha = sidak(1e-3, 9);
  for (const ClearCoatCase& c : {kSmooth, kBubble, kRough})
    for (const Vec3 wo : {polar(10, 30), polar(43, 200), polar(150, -60)}) {
      const Bsdf bsdf = closed(c);
      const auto sample = [&](const Uniform& random) -> std::optional<Vec3> {
        const float uc = random(), u = random(), v = random();
        const auto s = bsdf.sample(wo, uc, {u, v});
        return s && !s->specular ? std::optional(s->wi) : std::nullopt;
      };
      const auto density = [&](Vec3 wi) { return double{bsdf.pdf(wo, wi)}; };
      const auto r = chi_squared_test(sample, density, {.samples = 100'000, .axis = {0, 0, 1}, .alpha = alpha});
      CHECK_MESSAGE(r.passed, r.summary());
      // Power: an rms deviation of the bins of this size is found with probability 0.99.
      CHECK(r.detectable_deviation < 0.06);
      if (!c.top.is_specular()) continue;
      const auto mirror = bsdf.sample(wo, 0, {0.5f, 0.5f});
      REQUIRE(mirror);
      CHECK(mirror->specular);
      CHECK(double{mirror->pdf} + r.density_integral == doctest::Approx(1).epsilon(1e-3));
      CHECK(mirror->weight.g * mirror->pdf == test::relative(fresnel_dielectric(std::abs(wo.z), c.top.eta)).epsilon(1e-5));
    }
}

TEST_CASE("a clear coat's weights, values and densities agree") {
  TestRandom random(7);
  for (const ClearCoatCase& c : kCases) {
    const Bsdf bsdf = closed(c);
    for (int n = 0; n < 4000; ++n) {
      const Vec3 wo = random.direction();
      const auto s = bsdf.sample(wo, random(), random.pair());
      if (!s || s->specular) continue;
      CHECK(s->pdf == test::relative(bsdf.pdf(wo, s->wi)).epsilon(1e-3));
      const Rgb value = bsdf.eval(wo, s->wi);
      // Turning to world space and back blurs directions near the horizon.
      for (int i = 0; i < 3; ++i) CHECK(s->weight[i] * s->pdf == test::relative(value[i]).epsilon(5e-3));
      CHECK(bsdf.eval(s->wi, wo).g * std::abs(s->wi.z) == test::relative(value.g * std::abs(wo.z)).epsilon(1e-3));
    }
  }
}

TEST_CASE("a white coat without loss gives everything back") {
  for (const float eta : {0.7f, 1.0f, 1.5f, 2.5f})
    for (const Vec3 wo : {polar(0, 0), polar(60, 10), polar(89, 200), polar(120, 30)}) {
      const DielectricLobe top = glass(eta, 0, 0);
      const CoatShares shares = coat_shares(top, 0);
      const ClearCoatLobe lobe(top, Rgb(1.0f), {.thickness = 0, .max_depth = 100'000}, shares);
      CAPTURE(eta);
      CHECK(double{lobe.albedo(wo).g} == doctest::Approx(1).epsilon(1e-5));
    }
}

TEST_CASE("what separable surfaces scatter depends on either direction by a factor") {
  std::vector<Bsdf> separable = {make(DiffuseLobe{kPaint}), make(DiffuseTransmissionLobe{kPaint, {0.3f, 0.1f, 0.2f}})};
  for (const ClearCoatCase& c : kCases) {
    const Bsdf coat = closed(c);
    CHECK(coat.separable() == (c.top.is_specular() && c.coat.max_depth > 0));
    if (coat.separable()) separable.push_back(coat);
  }
  CHECK_FALSE(make(metal(0.3f, 0.3f)).separable());
  TestRandom random(5);
  for (const Bsdf& bsdf : separable) {
    for (int i = 0; i < 200; ++i) {
      Vec3 wo = square_to_uniform_sphere(random.pair()), other = square_to_uniform_sphere(random.pair());
      const Vec3 wi = square_to_uniform_sphere(random.pair());
      if (dot(wo, bsdf.normal()) * dot(other, bsdf.normal()) < 0) other = -other;
      const Rgb a = bsdf.eval(wo, wi) * bsdf.separable_part(other).factor,
                b = bsdf.eval(other, wi) * bsdf.separable_part(wo).factor;
      CHECK(max_component(absolute(a - b)) <= 1e-5f * max_component(a));
    }
  }
}
