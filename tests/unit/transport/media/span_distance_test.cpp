/// Distances along a span: the density integrates to 1, samples follow it, and extremes stay sound.
#include "transport/media/span_distance.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "math/rng.h"
#include "support/chi_squared.h"
#include "support/relative.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

ParticipatingMedium homogeneous(float sigma_s) {
  std::vector<std::string> notes;
  Medium medium;
  medium.kind = HomogeneousMedium{};
  medium.optics.sigma_s = Rgb(sigma_s);
  medium.optics.sigma_a = Rgb(0.1f * sigma_s);
  return build_medium(medium, {}, notes);
}

/// Two intervals of a ray, the second denser, with a gap in between; or one without an end.
struct Case {
  std::vector<ParticipatingMedium> media;
  Span span;
};

Case two_intervals(float scale) {
  Case c;
  c.media.push_back(homogeneous(0.5f / scale));
  c.media.push_back(homogeneous(4 / scale));
  c.span.ray = {{0, 0, 0}, {0, 0, 1}};
  c.span.t_end = 9 * scale;
  for (std::size_t i = 0; i < 2; ++i) {
    SpanPart part{};
    part.t0 = (1 + 4 * static_cast<float>(i)) * scale;
    part.t1 = part.t0 + 3 * scale;
    part.media.push_back(&c.media[i]);
    part.box = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
    c.span.parts.push_back(part);
  }
  return c;
}

/// From 1 to `border` one medium, from there on without end another.
Case touching_intervals(float sigma_s, float border, float sigma_s_behind) {
  Case c;
  for (const float sigma : {sigma_s, sigma_s_behind}) c.media.push_back(homogeneous(sigma));
  c.span.ray = {{0, 0, 0}, {0, 0, 1}};
  c.span.t_end = kInfinity;
  for (std::size_t i = 0; i < 2; ++i) {
    SpanPart part{};
    part.t0 = i == 0 ? 1 : border;
    part.t1 = i == 0 ? border : kInfinity;
    part.media.push_back(&c.media[i]);
    part.box = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
    c.span.parts.push_back(part);
  }
  return c;
}

/// Nothing is seen of the fog behind, in numbers: the optical depth of the box is beyond what exp() holds.
Case box_before_endless_fog() { return touching_intervals(2, 101, 0.01f); }

Case one_interval(float length) {
  Case c = two_intervals(length / 3);
  c.span.parts.erase(c.span.parts.begin() + 1);
  c.span.parts[0].t0 = 0;
  c.span.parts[0].t1 = c.span.t_end = length;
  return c;
}

Case endless(float sigma_s) {
  Case c;
  c.media.push_back(homogeneous(sigma_s));
  c.span.ray = {{0, 0, 0}, {0, 0, 1}};
  c.span.t_end = kInfinity;
  SpanPart part{};
  part.t0 = 0;
  part.t1 = kInfinity;
  part.media.push_back(&c.media[0]);
  part.box = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  c.span.parts.push_back(part);
  return c;
}

/// Integral of the density over [a, b] by midpoints, which lie evenly in angle about distance c: there densities peak.
double integral(const DistanceSampler& sampler, double a, double b, double c) {
  constexpr int kPoints = 256;
  constexpr double kWidth = 1e-3;
  const double from = std::atan((a - c) / kWidth), step = (std::atan((b - c) / kWidth) - from) / kPoints;
  if (step < 1e-9) return 0;
  double sum = 0;
  for (int k = 0; k < kPoints; ++k) {
    const double tangent = std::tan(from + (k + 0.5) * step);
    sum += sampler.pdf(static_cast<float>(c + kWidth * tangent)) * kWidth * (1 + tangent * tangent) * step;
  }
  return sum;
}

/// The same evenly in distance.
double integral(const DistanceSampler& sampler, double a, double b) {
  constexpr int kPoints = 256;
  double sum = 0;
  for (int k = 0; k < kPoints; ++k)
    sum += sampler.pdf(static_cast<float>(a + (b - a) * (k + 0.5) / kPoints)) * (b - a) / kPoints;
  return sum;
}

/// Samples against the density: in each of the profile's bins cut into four, the share of samples is its integral.
/// `peak`: where the ray passes the light so closely that the density peaks; not a number: nowhere. The density may jump where
/// the `lit` part ends.
void check_sampler(const SpanProfile& profile, const DistanceSampler& sampler, float peak, RayPart lit, int seed) {
  constexpr int kCuts = 4, kDraws = 100'000;
  const auto edges = profile.edges();
  const float last = edges.back() < kInfinity ? edges.back() : edges[profile.bins() - 1] * 4 + 4 * profile.reach();
  std::vector<float> bounds;
  for (std::size_t i = 0; i < profile.bins(); ++i) {
    const float end = std::min(edges[i + 1], last);
    for (int k = 0; k < kCuts; ++k) bounds.push_back(edges[i] + (end - edges[i]) * static_cast<float>(k) / kCuts);
  }
  bounds.push_back(last);
  for (const double end : {lit.begin, lit.end}) {
    const auto t = static_cast<float>(end);
    if (t > bounds.front() && t < last) bounds.insert(std::lower_bound(bounds.begin(), bounds.end(), t), t);
  }
  std::vector<double> expected(bounds.size(), 0), observed(bounds.size(), 0);  // the last: beyond
  double sum = 0;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    expected[i] =
        std::isnan(peak) ? integral(sampler, bounds[i], bounds[i + 1]) : integral(sampler, bounds[i], bounds[i + 1], peak);
    sum += expected[i];
  }
  expected.back() = std::max(1 - sum, 0.0);
  if (edges.back() < kInfinity) CHECK(sum == doctest::Approx(1).epsilon(2e-3));
  Rng rng(static_cast<std::uint64_t>(seed));
  for (int i = 0; i < kDraws; ++i) {
    const DistanceSample s = sampler.sample(rng.uniform());
    REQUIRE(s.pdf > 0);
    REQUIRE(std::isfinite(s.t));
    REQUIRE(s.t >= profile.begin());
    REQUIRE(s.t <= profile.end());
    CHECK(sampler.pdf(s.t) == test::relative(s.pdf).epsilon(1e-4));
    const auto next = std::upper_bound(bounds.begin(), bounds.end(), s.t);
    ++observed[std::min<std::size_t>(static_cast<std::size_t>(std::max<std::ptrdiff_t>(next - bounds.begin() - 1, 0)),
                                     observed.size() - 1)];
  }
  double statistic = 0, pool_e = 0, pool_o = 0;
  int cells = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    pool_e += kDraws * expected[i];
    pool_o += observed[i];
    if (pool_e < 20) continue;
    statistic += (pool_o - pool_e) * (pool_o - pool_e) / pool_e;
    ++cells;
    pool_e = pool_o = 0;
  }
  CHECK(pool_o <= pool_e + 6 * std::sqrt(pool_e + 1) + 1);
  REQUIRE(cells > 1);
  CHECK(chi_squared_tail(statistic, cells - 1) > sidak(1e-3, 60));
}

}  // namespace

TEST_CASE("out of media it is twice as far as to their nearer end on the span") {
  const auto check = [](const Case& c, bool enters, bool leaves) {
    const SpanProfile profile = *SpanProfile::of(c.span);
    const SegmentProfile coarse = profile.coarse(0);
    const std::size_t group = profile.bins() / SegmentProfile::kBins;
    for (std::size_t j = 0; j < SegmentProfile::kBins; ++j) {
      const double depth = -std::log(double{profile.transmittance(profile.edges()[j * group + group / 2])});
      const double ahead = profile.optical_depth() - depth, nearer = enters && leaves ? std::min(depth, ahead)
                                                                     : enters         ? depth
                                                                                      : ahead;
      const double expected = enters || leaves ? 2 * nearer : std::max(depth, ahead);
      CHECK(coarse.escape[j] == test::relative(expected).epsilon(1e-4));
    }
  };
  Case c = two_intervals(1);
  check(c, true, true);
  c.span.t_end = 8;  // a surface in the medium
  check(c, true, false);
  c.span.parts[0].t0 = 0;  // the ray's origin in it
  check(c, false, false);
  c.span.t_end = 9;
  check(c, false, true);
  for (const float escape : SpanProfile::of(endless(1).span)->coarse(0).escape) CHECK(escape == kInfinity);
}

TEST_CASE("a profile is of what scatters: not of clear intervals, nor of fog without coefficients") {
  Case c = touching_intervals(0.5f, 4, 0);
  const auto profile = SpanProfile::of(c.span);
  REQUIRE(profile);
  CHECK(profile->begin() == 1);
  CHECK(profile->end() == 4);
  for (const float edge : profile->edges()) CHECK(std::isfinite(edge));
  c.span.parts.erase(c.span.parts.begin());
  CHECK_FALSE(SpanProfile::of(c.span));
  CHECK_FALSE(SpanProfile::of(endless(1e-40f).span));
  CHECK(SpanProfile::of(endless(1e-15f).span));
}

TEST_CASE("distances toward lights follow their density") {
  const std::vector<LightPlace> places{{Vec3(0.3f, 0, 2), 0},
                                       {Vec3(0, 0.01f, 6), 0},
                                       {Vec3(40, 0, 3), 0.5f},
                                       {Vec3(0, 0, 5.5f), 0},
                                       {Vec3(2, 1, -30), 0},
                                       {std::nullopt, 0},
                                       // Flat ones that face along the ray, against it, both sides; a beam across it.
                                       {.center = Vec3(0.5f, 0, 2.2f), .radius = 0.1f, .normal = {-0.6f, 0, 0.8f}},
                                       {.center = Vec3(0.5f, 1, 7.1f), .radius = 0.1f, .normal = {0, -0.6f, -0.8f}},
                                       {.center = Vec3(0.5f, 0, 2), .normal = {0.6f, 0, 0.8f}, .two_sided = true},
                                       {.center = Vec3(3, 0, 0), .beam = DirectionCone::around({-0.6f, 0, 0.8f}, 0.2f)}};
  int seed = 0;
  using Bins = SpanProfile::Bins;
  for (const auto& [make, bins] : {std::pair{+[] { return two_intervals(1); }, Bins::many},
                                   {+[] { return endless(0.7f); }, Bins::many},
                                   {+[] { return two_intervals(1); }, Bins::few},
                                   {+[] { return box_before_endless_fog(); }, Bins::many},
                                   {+[] { return box_before_endless_fog(); }, Bins::few}}) {
    const Case c = make();
    const auto profile = SpanProfile::of(c.span, bins);
    REQUIRE(profile);
    REQUIRE(profile->bins() == static_cast<std::size_t>(bins));
    for (const LightPlace& place : places) {
      CAPTURE(seed);
      const bool on_ray = place.center && std::hypot(place.center->x, place.center->y) < 0.05f;
      const float peak = on_ray ? place.center->z : std::numeric_limits<float>::quiet_NaN();
      check_sampler(*profile, DistanceSampler(*profile, c.span.ray, place, DistanceSampler::Weights{0.6f}), peak,
                    lit_part(place, c.span.ray), ++seed);
      const RayPart all = lit_part({}, c.span.ray);
      if (place.center) check_sampler(*profile, DistanceSampler(*profile, c.span.ray, place, std::nullopt), peak, all, ++seed);
    }
  }
}

TEST_CASE("what lies behind a box that nothing gets through keeps its place") {
  const Case c = box_before_endless_fog();
  for (const auto bins : {SpanProfile::Bins::few, SpanProfile::Bins::many}) {
    const auto profile = SpanProfile::of(c.span, bins);
    REQUIRE(profile);
    CHECK(profile->finite_end() > profile->edges()[profile->bins() - 1]);
    for (const std::optional<Vec3> place :
         {std::optional(Vec3(1, 0, 700)), std::optional(Vec3(1, 0, 50)), std::optional<Vec3>()}) {
      const DistanceSampler sampler(*profile, c.span.ray, {place, 0}, DistanceSampler::Weights{0});
      for (const float t : {2.0f, 90.0f, 300.0f, 1200.0f, 3000.0f}) CHECK(sampler.pdf(t) > 0);
    }
  }
}

TEST_CASE("distances toward a flat light go by the cosine at it, and none is where no light arrives") {
  // Against an even light of the same place, in a clear medium: the squared weight of cos / r^2, which is 1 at best.
  const Case c = one_interval(6);
  const auto profile = SpanProfile::of(c.span);
  REQUIRE(profile);
  Rng rng(11);
  double flat_mean = 0, even_mean = 0;
  constexpr int kLights = 300;
  for (int i = 0; i < kLights; ++i) {
    const float z = 2 * rng.uniform() - 1, phi = 2 * kPi * rng.uniform(), rho = std::sqrt(1 - z * z);
    const Vec3 n{rho * std::cos(phi), rho * std::sin(phi), z};
    const LightPlace even{.center = Vec3(1, 0, 6 * rng.uniform())}, flat{.center = even.center, .normal = n};
    const auto emitted = [&](float t) { return std::max(dot(n, Vec3(0, 0, t) - *even.center), 0.0f); };
    const auto squared_weight = [&](const DistanceSampler& sampler) {
      double sum = 0, squares = 0;
      constexpr int kSteps = 2000;
      for (int k = 0; k < kSteps; ++k) {
        const float t = 6 * (static_cast<float>(k) + 0.5f) / kSteps, r2 = length_squared(Vec3(0, 0, t) - *even.center);
        const double f = emitted(t) / (r2 * std::sqrt(r2)) * profile->scatterings()[profile->bin_at(t)], pdf = sampler.pdf(t);
        REQUIRE((f < 1e-4 || pdf > 0));
        if (!(pdf > 0)) continue;
        sum += f;
        squares += f * f / pdf;
      }
      return sum > 0 ? squares * kSteps / 6 / (sum * sum) : 0.0;
    };
    const double faced = squared_weight(DistanceSampler(*profile, c.span.ray, flat, DistanceSampler::Weights{0}));
    const double unfaced = squared_weight(DistanceSampler(*profile, c.span.ray, even, DistanceSampler::Weights{0}));
    CHECK(faced <= 1.5);
    flat_mean += faced / kLights;
    even_mean += unfaced / kLights;
  }
  CHECK(flat_mean < 1.12);
  CHECK(even_mean > 1.8);

  const LightPlace away{.center = Vec3(1, 0, 8), .normal = {0, 0, 1}};
  const DistanceSampler none(*profile, c.span.ray, away, DistanceSampler::Weights{0});
  for (const float u : {0.0f, 0.5f, 0.999f}) CHECK(none.sample(u).pdf == 0);
  for (const float t : {0.0f, 3.0f, 6.0f}) CHECK(none.pdf(t) == 0);
}

TEST_CASE("a beam far along a fog without end is found") {
  const Case c = endless(1);
  const auto profile = SpanProfile::of(c.span);
  REQUIRE(profile);
  const LightPlace spot{.center = Vec3(5, 0, 100), .beam = DirectionCone::around({-1, 0, 0}, 0.1f)};
  const DistanceSampler sampler(*profile, c.span.ray, spot, DistanceSampler::Weights{0});
  for (const float u : {0.0f, 0.3f, 0.999f}) {
    const DistanceSample s = sampler.sample(u);
    CHECK(s.pdf > 0);
    CHECK(std::abs(s.t - 100) < 0.6f);
    CHECK(sampler.pdf(s.t) == test::relative(s.pdf).epsilon(1e-4));
  }
}

TEST_CASE("distances stay sound at every scale") {
  for (int k = -30; k <= 30; k += 5) {
    CAPTURE(k);
    const float scale = std::ldexp(1.0f, k);
    const Case c = two_intervals(scale);
    const auto profile = SpanProfile::of(c.span);
    REQUIRE(profile);
    Rng rng(7);
    for (int i = 0; i < 2000; ++i) {
      const float size = std::ldexp(scale, static_cast<int>(40 * rng.uniform()) - 20);
      LightPlace place{Vec3(rng.uniform() - 0.5f, rng.uniform() - 0.5f, rng.uniform() - 0.5f) * size, 0};
      const Vec3 axis = normalize(Vec3{rng.uniform() - 0.5f, rng.uniform() - 0.5f, rng.uniform() - 0.5f});
      if (i % 3 == 1) place.normal = axis;
      if (i % 3 == 2) place.beam = DirectionCone::around(axis, 2 * rng.uniform());
      const DistanceSampler sampler(*profile, c.span.ray, place, DistanceSampler::Weights{0.9f});
      const DistanceSample s = sampler.sample(rng.uniform());
      REQUIRE(std::isfinite(s.t));
      REQUIRE((s.pdf > 0 || i % 3 > 0));
      if (s.pdf == 0) continue;  // no light there
      REQUIRE(sampler.pdf(s.t) == test::relative(s.pdf).epsilon(1e-3));
      REQUIRE(std::isfinite(s.pdf));
      REQUIRE(s.t >= profile->begin());
      REQUIRE(s.t <= profile->end());
    }
  }
}

TEST_CASE("the equi-angular density keeps its digits for short segments far away and long ones close by") {
  for (const float length : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f}) {
    const Case c = one_interval(length);
    const auto profile = SpanProfile::of(c.span);
    REQUIRE(profile);
    for (const float off : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f}) {
      for (const float along : {-3.0f, 0.0f, 0.4f, 7.0f}) {
        const float closest = along * std::max(length, 0.1f * off);
        if (off < 1e-4f * std::abs(closest)) continue;  // the light is then taken to be farther off
        CAPTURE(length);
        CAPTURE(off);
        CAPTURE(closest);
        const DistanceSampler sampler(*profile, c.span.ray, {Vec3(off, 0, closest), 0}, std::nullopt);
        const long double D = off, a = -static_cast<long double>(closest), b = static_cast<long double>(length) - closest;
        const long double angle = std::atan2(D * (b - a), D * D + a * b);
        for (const float share : {0.01f, 0.5f, 0.99f}) {
          const float t = share * length;
          const long double from = static_cast<long double>(t) - closest;
          const auto expected = static_cast<double>(D / (angle * (D * D + from * from)));
          CHECK(sampler.pdf(t) / expected == doctest::Approx(1).epsilon(1e-4));
        }
      }
    }
  }
}

TEST_CASE("the profile of a homogeneous medium is exact at its edges") {
  const Case c = endless(0.7f);
  const auto profile = SpanProfile::of(c.span);
  REQUIRE(profile);
  for (float t = 0; t < 20; t += 0.37f) CHECK(profile->transmittance(t) == test::relative(std::exp(-0.77f * t)).epsilon(1e-4));
  CHECK(profile->scattered() == doctest::Approx(0.7f / 0.77f).epsilon(1e-3));
}

TEST_CASE("a span that does not scatter has no profile") {
  Case c = endless(0.7f);
  c.media.clear();
  c.media.push_back(homogeneous(0));
  c.span.parts[0].media.clear();
  c.span.parts[0].media.push_back(&c.media[0]);
  CHECK(!SpanProfile::of(c.span));
}
