/// Checks that hold for every emissive surface, by its parametrisation over the unit square.
#pragma once

#include <doctest/doctest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "light/emitter_sample.h"
#include "math/rng.h"
#include "support/chi_squared.h"

namespace tyndall::test {

/// A point of the surface and its oriented area per du dv.
struct SurfacePoint {
  Vec3d x, dA;
};

struct EmitterUnderTest {
  std::string name;
  std::function<std::optional<EmitterSample>(Vec3 p, Vec2 u)> sample;
  std::function<float(Vec3 p, Vec3 hit)> pdf;
  std::function<std::optional<SurfacePoint>(double u, double v)> surface;  ///< by texture coordinates
  bool front_only = false;  ///< the far side, seen through the near one, is never sampled
};

/// From `p`: samples fall on the surface as the density says, the density integrates to 1, sample() and pdf() agree,
/// and the form factor toward `n` estimated by samples is that of quadrature.
inline void check_emitter(const EmitterUnderTest& e, Vec3 p, Vec3 n, int kCuts = 8, int kFine = 40) {
  CAPTURE(e.name);
  CAPTURE(p.x);
  CAPTURE(p.y);
  CAPTURE(p.z);
  constexpr int kSamples = 40'000;
  std::vector<double> expected(static_cast<std::size_t>(kCuts * kCuts)), counts(expected.size());
  double form_factor = 0, total = 0;
  for (int i = 0; i < kCuts * kFine; ++i)
    for (int j = 0; j < kCuts * kFine; ++j) {
      const double du = 1.0 / (kCuts * kFine);
      const auto s = e.surface((i + 0.5) * du, (j + 0.5) * du);
      if (!s) continue;
      const Vec3d d = s->x - Vec3d(p);
      const double d2 = dot(d, d);
      if (e.front_only && dot(s->dA, d) >= 0) continue;
      const double omega = std::abs(dot(s->dA, d)) / (d2 * std::sqrt(d2)) * du * du;
      const double mass = e.pdf(p, to_vec3(s->x)) * omega;
      expected[static_cast<std::size_t>((i / kFine) * kCuts + j / kFine)] += mass * kSamples;
      total += mass;
      form_factor += std::max(0.0, dot(Vec3d(n), d) / std::sqrt(d2)) * omega;
    }
  CHECK(total == doctest::Approx(1).epsilon(0.01));

  Rng rng(5);
  double sum = 0, sum2 = 0;
  for (int i = 0; i < kSamples; ++i) {
    const float ux = rng.uniform(), uy = rng.uniform();
    const auto s = e.sample(p, {ux, uy});
    if (!s) continue;
    REQUIRE(length(s->wi) == doctest::Approx(1).epsilon(1e-5));
    REQUIRE(length(s->ng) == doctest::Approx(1).epsilon(1e-5));
    REQUIRE(s->pdf > 0);
    const auto at = e.surface(s->uv.x, s->uv.y);
    if (at) {
      const Vec3 hit = to_vec3(at->x);
      const double scale = length(at->x - Vec3d(p));
      REQUIRE(s->distance == doctest::Approx(scale).epsilon(1e-3));
      REQUIRE(length(Vec3d(p) + Vec3d(s->wi) * s->distance - at->x) <= 2e-3 * scale);
      // Seen nearly edge-on the density changes faster than floats can tell points apart.
      if (std::abs(dot(Vec3d(s->ng), Vec3d(s->wi))) > 0.05) REQUIRE(e.pdf(p, hit) == doctest::Approx(s->pdf).epsilon(3e-3));
      REQUIRE(dot(normalize(at->dA), Vec3d(s->ng)) > 0.99);
    }
    const int i_cell = std::clamp(int(s->uv.x * kCuts), 0, kCuts - 1), j_cell = std::clamp(int(s->uv.y * kCuts), 0, kCuts - 1);
    counts[static_cast<std::size_t>(i_cell * kCuts + j_cell)] += 1;
    const double value = std::max(0.0f, dot(n, s->wi)) / s->pdf;
    sum += value;
    sum2 += value * value;
  }
  double statistic = 0, rest = 0, rest_expected = 0;
  int bins = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] >= 5) {
      statistic += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
      ++bins;
    } else {
      rest += counts[i];
      rest_expected += expected[i];
    }
  }
  if (rest_expected >= 5) statistic += (rest - rest_expected) * (rest - rest_expected) / rest_expected, ++bins;
  CHECK(rest <= rest_expected + 6 * std::sqrt(rest_expected + 1) + 20);
  if (bins > 1) CHECK(chi_squared_tail(statistic, bins - 1) > 1e-6);

  const double mean = sum / kSamples, error = std::sqrt(std::max(0.0, sum2 / kSamples - mean * mean) / kSamples);
  CHECK(std::abs(mean - form_factor) < 5 * error + 2e-3 * form_factor);
}

}  // namespace tyndall::test
