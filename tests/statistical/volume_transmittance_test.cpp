/// Estimators of transmittance against integration along the ray, and against each other.
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "math/hash.h"
#include "support/strategies.h"
#include "support/test_media.h"
#include "volume/ray_march.h"

using namespace tyndall;
using test::Moments;

namespace {

struct Line {
  std::string name;
  std::vector<const ParticipatingMedium*> media;
  Ray ray;
  float t0, t1;
};

const std::vector<TransmittanceStrategy> kStrategies = test::every_transmittance();

/// Largest deviation over channels in standard errors; events rarer than `slack` are beyond the sample.
double deviation(TransmittanceStrategy strategy, const Line& line, const test::LineIntegrals& exact, int count,
                 TrackingStats& stats) {
  std::array<Moments, 3> moments;
  Rng rng(17);
  for (int i = 0; i < count; ++i) {
    const Rgb T = transmittance({strategy}, line.media, line.ray, line.t0, line.t1, rng, stats);
    for (int c = 0; c < 3; ++c) moments[static_cast<std::size_t>(c)].add(T[c]);
  }
  double worst = 0;
  for (int c = 0; c < 3; ++c) {
    const double T = exact.transmittance(c);
    worst = std::max(worst, moments[static_cast<std::size_t>(c)].deviation(T, 2e-5 * T + 3.0 / count * 0.1));
  }
  return worst;
}

void check_all(const Line& line, int count) {
  const test::LineIntegrals exact = test::integrate_line(line.media, line.ray, line.t0, line.t1);
  TrackingStats stats;
  for (const TransmittanceStrategy strategy : kStrategies) {
    const double worst = deviation(strategy, line, exact, count, stats);
    CHECK_MESSAGE(worst < 4, line.name << ", " << name_of(strategy) << ": " << worst << " standard errors");
  }
  CHECK(stats.majorant_violations == 0);
  CHECK(stats.caps_hit == 0);
}

/// One piece of which `share` has sigma 4 and the rest 0, changing too fast for any comb to follow.
struct Stripes {
  double length, share = 0.25;
  float subtracted = 0;
  bool fresh = true;
  bool next() { return std::exchange(fresh, false); }
  double t() const { return 0; }
  double t_end() const { return length; }
  float rate() const { return 4; }
  Rgb control() const { return Rgb(subtracted); }
  Rgb excess_at(double t) const {
    const double u = static_cast<double>(hash(std::bit_cast<std::uint64_t>(t), 1) >> 11) * 0x1p-53;
    return Rgb((u < share ? 4.0f : 0.0f) - subtracted);
  }
  ExcessSum excess_at(const Teeth& teeth) const { return sum_of_each(*this, teeth); }
};

/// Two units of length, whose excess changes as fast as teeth follow each other.
struct Alternating {
  float amount, control_depth;
  bool fresh = true;
  bool next() { return std::exchange(fresh, false); }
  double t() const { return 0; }
  double t_end() const { return 2; }
  float rate() const { return 1; }
  Rgb control() const { return Rgb(control_depth / 2); }
  Rgb excess_at(double t) const { return Rgb(std::fmod(t, 0.5) < 0.25 ? amount : -amount); }
  ExcessSum excess_at(const Teeth& teeth) const { return sum_of_each(*this, teeth); }
};

using Of = kernel::RayMarch::Of;

/// Estimates of so many walks, red.
Moments marched(const Stripes& walk, int count, std::uint64_t seed, TrackingStats& stats, Of of = Of::transmittance) {
  Moments moments;
  Rng rng(seed);
  for (int i = 0; i < count; ++i) {
    Stripes one = walk;
    moments.add(kernel::ray_marching(one, of, 0.5f, rng, stats).r);
  }
  return moments;
}

const Ray kDiagonal{{-1.3f, -0.9f, -1.1f}, normalize({1.1f, 0.8f, 0.9f})};

}  // namespace

TEST_CASE("residual, ratio, delta tracking and ray marching agree with the integral for optical depths from 1e-6 to 50") {
  for (const float depth : {1e-6f, 1e-3f, 0.1f, 1.0f, 4.0f, 10.0f, 50.0f}) {
    const auto clumpy = test::clumpy({Rgb{0.3f * depth}, Rgb{0.4f * depth}, 0}, 3);
    const auto fog = test::homogeneous({Rgb{0.05f * depth}, Rgb{0.1f * depth}, 0});
    check_all({"clumpy at " + std::to_string(depth), {&clumpy}, kDiagonal, 0, 4}, 40000);
    check_all({"clumpy and fog at " + std::to_string(depth), {&clumpy, &fog}, kDiagonal, 0.2f, 3}, 20000);
  }
}

TEST_CASE("channels and overlapping, rotated and stretched media are estimated without bias") {
  const auto red = test::clumpy({{0.1f, 1.0f, 3.0f}, {0.4f, 0.2f, 1.0f}, 0.3f}, 5);
  const Transform turned = Transform::rotate(40, 1, 1, 0) * Transform::scale(0.8, -0.5, 1.2);
  const auto blue = test::clumpy({{2.0f, 0.3f, 0.0f}, {0.0f, 0.2f, 0.0f}, -0.3f}, 6, {}, turned);
  const auto fog = test::homogeneous({{0.0f, 0.1f, 0.3f}, {0.0f, 0.0f, 0.2f}, 0});
  check_all({"one", {&red}, kDiagonal, 0, 4}, 60000);
  check_all({"two", {&red, &blue}, kDiagonal, 0, 4}, 60000);
  check_all({"three", {&red, &blue, &fog}, kDiagonal, 0, 4}, 60000);
  check_all({"one twice", {&red, &red}, kDiagonal, 0, 4}, 60000);
}

TEST_CASE("the inverse of the transmittance agrees with the integral, however much its optical depths scatter") {
  const auto red = test::clumpy({{0.1f, 1.0f, 3.0f}, {0.4f, 0.2f, 1.0f}, 0.3f}, 5);
  const auto fog = test::homogeneous({{0.0f, 0.1f, 0.3f}, {0.0f, 0.0f, 0.2f}, 0});
  for (const auto& media : std::vector<std::vector<const ParticipatingMedium*>>{{&red}, {&red, &fog}, {&fog}}) {
    const test::LineIntegrals exact = test::integrate_line(media, kDiagonal, 0, 3);
    std::array<Moments, 3> moments;
    TrackingStats stats;
    Rng rng(19);
    for (int i = 0; i < 60'000; ++i) {
      const Rgb inverse = inverse_transmittance(0.5f, media, kDiagonal, 0, 3, rng, stats);
      for (int c = 0; c < 3; ++c) moments[static_cast<std::size_t>(c)].add(inverse[c]);
    }
    for (int c = 0; c < 3; ++c) {
      const double expected = 1 / exact.transmittance(c);
      CHECK(moments[static_cast<std::size_t>(c)].deviation(expected, 2e-5 * expected) < 4);
      CHECK(moments[static_cast<std::size_t>(c)].standard_error() < 0.01 * expected);
    }
    CHECK(stats.majorant_violations == 0);
  }
  for (const double length : {0.25, 1.0, 2.0}) {
    TrackingStats stats;
    const Moments moments = marched({length}, 1'000'000, 3, stats, Of::inverse);
    CHECK(moments.deviation(std::exp(length)) < 4);
    CHECK(moments.standard_error() < 0.02 * std::exp(length));  // 0.0102 at 2; 0.06 where corrections are rare
  }
}

TEST_CASE("homogeneous media are exact, at any depth and to infinity") {
  TrackingStats stats;
  Rng rng(1);
  for (const float sigma : {0.0f, 1e-30f, 1e-6f, 1.0f, 1e6f})
    for (const float length : {1e-6f, 1.0f, 1e6f, kInfinity}) {
      const auto fog = test::homogeneous({{sigma, 0, sigma / 2}, {0, 0, sigma / 2}, 0});
      const ParticipatingMedium* media[] = {&fog};
      const Rgb T = transmittance({TransmittanceStrategy::ratio}, media, kDiagonal, 0, length, rng, stats);
      const double expected = sigma == 0 ? 1 : std::exp(-double{sigma} * length);
      CHECK(T.r == doctest::Approx(expected));
      CHECK(T.g == 1);
      CHECK(T.b == T.r);
    }
  CHECK(stats.lookups == 0);
}

TEST_CASE("a constant grid is as exact as a homogeneous medium under residual tracking, but for its faces") {
  const auto constant = test::grid({32, -1, 1}, {Rgb{1.0f}, Rgb{9.0f}, 0}, [](int) { return 1.0f; });
  const ParticipatingMedium* media[] = {&constant};
  Rng rng(2);
  TrackingStats stats;
  // Through bricks that the fading outermost layer does not reach, and too dense to be lumped with those it does.
  const Ray ray{{-0.96f, 0.1f, 0.2f}, {1, 0, 0}};
  for (int i = 0; i < 100; ++i)
    CHECK(transmittance({TransmittanceStrategy::residual}, media, ray, 0, 1.46f, rng, stats).g ==
          doctest::Approx(std::exp(-10 * 1.46)).epsilon(1e-5));
  CHECK(stats.lookups == 0);
}

TEST_CASE("ray marching corrects what its optical depths scatter by, however much") {
  for (const double length : {0.25, 1.0, 2.0}) {
    TrackingStats stats;
    const Moments moments = marched({length}, 1'000'000, 3, stats);
    const double worst = moments.deviation(std::exp(-length));
    CHECK_MESSAGE(worst < 4, length << ": " << worst << " standard errors");
    CHECK(moments.standard_error() < 0.01 * std::exp(-length));
    CHECK(stats.majorant_violations == 0);
  }
}

// A comb reads `amount` everywhere or -amount, by where its first tooth is, of a control of so much in all. Roulette on what
// one comb has found would weigh that much in what the other has not. Deviations of one estimate over the transmittance, which
// a quarter of a million of them tell to a tenth: 8, 84 and 168; were it on the first comb 17, 370 and 887.
TEST_CASE("roulette of a march gives no comb the weight of what another has found") {
  struct Case {
    float amount, control;
    double most;
  };
  for (const auto& [amount, control, most] : {Case{0.5f, 6, 12}, Case{1, 6, 150}, Case{1, 8, 350}}) {
    constexpr int kCount = 250'000;
    TrackingStats stats;
    Moments moments;
    Rng rng(9);
    for (int i = 0; i < kCount; ++i) {
      Alternating walk{amount, control};
      moments.add(kernel::ray_marching(walk, Of::transmittance, 0.5f, rng, stats).r);
    }
    const double T = std::exp(-double{control});
    CHECK(moments.deviation(T) < 4);
    CHECK(moments.standard_error() * std::sqrt(double{kCount}) < most * T);
  }
}

TEST_CASE("ray marching of one piece stops where nothing is left, at any depth and whatever is subtracted") {
  for (const double length : {0.0, 0.1, 1.0, 4.0, 10.0, 100.0, 1e4, 1e6})
    for (const float subtracted : {0.0f, 1.0f, 3.0f}) {
      constexpr int kCount = 100'000;
      TrackingStats stats;
      const Moments moments = marched({length, 0.25, subtracted}, kCount, 5, stats);
      const double T = std::exp(-length), worst = moments.deviation(T, 0.3 / kCount);
      CHECK_MESSAGE(worst < 4, length << ", subtracted " << subtracted << ": " << worst << " standard errors");
      // 37 teeth reach a depth of 4.6 on the average, 16 more lose all but exp(-2), and a comb in eleven corrects.
      CHECK(static_cast<double>(stats.lookups) < 75.0 * kCount);
      CHECK(stats.caps_hit == 0);
    }
}

TEST_CASE("ray marching does not give up light for a control that turns out to be too much") {
  for (const double length : {10.0, 100.0, 1000.0}) {
    TrackingStats stats;
    const Moments moments = marched({length, 0, 4}, 20'000, 6, stats);
    CHECK(moments.deviation(1) < 4);
    CHECK(moments.standard_error() < 0.01);
  }
}

TEST_CASE("a march that would never end is given up and counted") {
  Stripes walk{1e17, 0, 0};
  Rng rng(7);
  TrackingStats stats;
  CHECK(is_black(kernel::ray_marching(walk, Of::transmittance, 0.5f, rng, stats)));
  CHECK(stats.caps_hit == 1);
  CHECK(stats.lookups == kernel::kMaxLookups);
}

TEST_CASE("ray marching finds the gaps of a thick cloud, and makes few look-ups where there is none") {
  const auto cloud = test::cloud({Rgb{100.0f}, Rgb{900.0f}, 0});
  const ParticipatingMedium* media[] = {&cloud};
  constexpr int kRays = 400, kRepeats = 10;
  Rng rng(8);
  TrackingStats stats;
  Moments errors;
  for (int i = 0; i < kRays; ++i) {
    const Ray ray{{-2.1f, 0.55f + 0.4f * rng.uniform(), 4 * rng.uniform() - 2}, {1, 0, 0}};
    const float t1 = 0.2f + rng.uniform();
    const double T = test::integrate_line(media, ray, 0, t1, 2000).transmittance(1);
    for (int k = 0; k < kRepeats; ++k)
      errors.add(transmittance({TransmittanceStrategy::raymarch}, media, ray, 0, t1, rng, stats).g - T);
  }
  CHECK(errors.deviation(0, 1e-4) < 4);
  CHECK(errors.standard_error() < 0.002);
  CHECK(static_cast<double>(stats.lookups) < 600.0 * kRays * kRepeats);
}

TEST_CASE("ray marching varies least, then residual, ratio and delta tracking") {
  const auto clumpy = test::clumpy({Rgb{0.6f}, Rgb{0.8f}, 0}, 3);
  const ParticipatingMedium* media[] = {&clumpy};
  double errors[4];
  for (int s = 0; s < 4; ++s) {
    Moments moments;
    Rng rng(4);
    TrackingStats stats;
    for (int i = 0; i < 20000; ++i) moments.add(transmittance({kStrategies[s], 0.25f}, media, kDiagonal, 0, 4, rng, stats).g);
    errors[s] = moments.standard_error();
  }
  CHECK(errors[3] < 0.75 * errors[0]);
  CHECK(errors[0] < errors[1]);
  CHECK(errors[1] < errors[2]);
}
