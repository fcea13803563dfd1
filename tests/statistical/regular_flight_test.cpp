/// Flights by the optical depth itself: as free ones on average, and where one number says.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "support/chi_squared.h"
#include "support/flights.h"
#include "volume/regular_tracking.h"

using namespace tyndall;
using test::check_flight, test::kDiagonal, test::kT1;

namespace {

/// As many cells along the diagonal as no flight goes through one by one.
ParticipatingMedium finely_layered(const test::Optics& optics) {
  UniformGridMedium layers;
  layers.bounds = {{-1, -1, -1}, {1, 1, 1}};
  layers.nx = 2000;
  layers.ny = layers.nz = 1;
  Rng rng(4);
  for (int i = 0; i < layers.nx; ++i) layers.density.push_back(rng.uniform());
  Medium medium;
  medium.kind = layers;
  return test::built(medium, optics);
}

/// Optical depth of the red channel up to t.
double depth_to(MediaView media, double t) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (const ParticipatingMedium* medium : media)
      sum += double{medium->at(kDiagonal.at(static_cast<float>((i + 0.5) / kSteps * t))).sigma_t().r} * t / kSteps;
  return sum;
}

Flight fly(MediaView media, float t0, float t1, float u, std::uint64_t seed) {
  Rng rng(seed);
  TrackingStats stats;
  return regular_flight(media, kDiagonal, t0, t1, Rgb{1.0f}, u, rng, stats);
}

}  // namespace

// 51 comparisons of 60,000 flights a call, each to 4.5 standard errors: a bin of 5 % of the flights to 8 % of it.
TEST_CASE("regular flights: every channel is right, whatever they go through") {
  for (const float depth : {0.01f, 0.5f, 3.0f, 20.0f}) {
    const auto fog = test::homogeneous({Rgb{0.1f * depth}, Rgb{0.4f * depth}, 0}, Rgb{1.5f});
    const auto clumpy = test::clumpy({Rgb{0.2f * depth}, Rgb{0.5f * depth}, 0}, 8, Rgb{0.7f});
    const auto layers = finely_layered({Rgb{0.2f * depth}, Rgb{0.5f * depth}, 0});
    const ParticipatingMedium *one[] = {&clumpy}, *both[] = {&clumpy, &fog}, *fine[] = {&layers}, *all[] = {&layers, &clumpy};
    const std::string at = " at " + std::to_string(depth);
    check_flight("clumpy" + at, one, Rgb{1.0f}, 60000, regular_flight);
    check_flight("clumpy in fog" + at, both, Rgb{1.0f}, 60000, regular_flight);
    check_flight("more cells than are gone through" + at, fine, Rgb{1.0f}, 60000, regular_flight);
    check_flight("both" + at, all, Rgb{1.0f}, 60000, regular_flight);
  }
}

TEST_CASE("regular flights: colours, and media that do not scatter") {
  const auto fog = test::homogeneous({{0.1f, 0.0f, 0.6f}, {0.2f, 1.0f, 3.0f}, 0}, {1, 0.5f, 2});
  const auto clumpy = test::clumpy({{0.1f, 1.0f, 3.0f}, {0.8f, 0.2f, 1.0f}, 0.3f}, 9, {0.3f, 1, 2});
  const auto other = test::clumpy({{1.5f, 0.0f, 0.2f}, {0.0f, 0.0f, 2.0f}, -0.3f}, 10);
  const auto soot = test::clumpy({{0.5f, 1.0f, 8.0f}, {}, 0}, 9, Rgb{1.0f});
  const auto layers = finely_layered({{0.1f, 2.0f, 0.5f}, {1.0f, 0.3f, 0.4f}, 0});
  const auto noise = test::cloud({{0.1f, 0.2f, 0.3f}, {3.0f, 2.0f, 1.0f}, 0});
  const ParticipatingMedium *one[] = {&clumpy}, *three[] = {&clumpy, &other, &fog}, *dark[] = {&soot},
                            *mixed[] = {&soot, &clumpy}, *fine[] = {&layers}, *clouds[] = {&noise, &clumpy};
  for (const Rgb beta : {Rgb{1.0f}, Rgb{1, 0.1f, 0.01f}, Rgb{0, 1, 0.3f}, Rgb{1e-30f, 3e-30f, 2e-30f}}) {
    check_flight("clumpy", one, beta, 60000, regular_flight);
    check_flight("three", three, beta, 60000, regular_flight);
    check_flight("soot", dark, beta, 60000, regular_flight);
    check_flight("soot and smoke", mixed, beta, 60000, regular_flight);
    check_flight("more cells than are gone through", fine, beta, 60000, regular_flight);
    check_flight("procedural", clouds, beta, 60000, regular_flight);
  }
}

TEST_CASE("regular flights: one number alone says where they end") {
  const auto fog = test::homogeneous({Rgb{0.05f}, Rgb{0.1f}, 0});
  const auto clumpy = test::clumpy({Rgb{0.3f}, Rgb{0.9f}, 0}, 8);
  const ParticipatingMedium *one[] = {&clumpy}, *both[] = {&clumpy, &fog};
  // Of the fog alone, pieces of little depth go by other numbers.
  constexpr double kByChance = 0.02;
  for (const MediaView media : {MediaView(one), MediaView(both)}) {
    double worst = 0;
    for (float u = 0.01f; u < 1; u += 0.02f) {
      const Flight flight = fly(media, 0, kInfinity, u, 1);
      const double goal = -std::log1p(-double{u});
      if (flight.collided) worst = std::max(worst, std::abs(depth_to(media, flight.t) - goal));
      if (!flight.collided) CHECK(depth_to(media, kT1) < goal + kByChance);
      if (media.size() == 2) CHECK(flight.collided);
    }
    CHECK(worst < (media.size() == 1 ? 1e-5 : kByChance));
  }
}

TEST_CASE("regular flights: two parts of a ray are flown as one") {
  const auto clumpy = test::clumpy({Rgb{0.3f}, Rgb{2.0f}, 0}, 8);
  const auto fog = test::homogeneous({Rgb{0.3f}, Rgb{0.2f}, 0});
  const ParticipatingMedium *one[] = {&clumpy}, *both[] = {&clumpy, &fog}, *even[] = {&fog};
  for (const MediaView media : {MediaView(one), MediaView(both), MediaView(even)}) {
    int passed = 0;
    for (float u = 0.01f; u < 1; u += 0.01f) {
      const Flight whole = fly(media, 0, kT1, u, 1), first = fly(media, 0, 1.6f, u, 1);
      if (first.collided) continue;
      const Flight second = fly(media, 1.6f, kT1, first.u_next, 1);
      ++passed;
      CHECK(second.collided == whole.collided);
      CHECK(second.t == doctest::Approx(whole.t).epsilon(2e-3));
    }
    CHECK(passed > 20);
  }
}

TEST_CASE("what flights that pass leave of their number is uniform (chi-squared)") {
  constexpr int kCells = 20, kCount = 100000;
  const auto fog = test::homogeneous({{0.1f, 0.0f, 0.6f}, {0.2f, 0.5f, 0.3f}, 0});
  const auto clumpy = test::clumpy({{0.1f, 0.4f, 0.3f}, {0.5f, 0.2f, 0.1f}, 0}, 8);
  const auto soot = test::clumpy({{0.5f, 1.0f, 2.0f}, {}, 0}, 9);
  const ParticipatingMedium *one[] = {&fog}, *two[] = {&clumpy}, *both[] = {&clumpy, &fog}, *dark[] = {&soot};
  for (const MediaView media : {MediaView(one), MediaView(two), MediaView(both), MediaView(dark)}) {
    for (const auto flies : {free_flight, regular_flight}) {
      Rng rng(3);
      TrackingStats stats;
      std::vector<int> cells(kCells);
      int passed = 0;
      for (int i = 0; i < kCount; ++i) {
        const Flight flight = flies(media, kDiagonal, 0, kT1, Rgb{1.0f}, rng.uniform(), rng, stats);
        if (flight.collided) continue;
        ++passed;
        ++cells[static_cast<std::size_t>(flight.u_next * kCells)];
      }
      double statistic = 0;
      const double expected = static_cast<double>(passed) / kCells;
      for (const int count : cells) statistic += (count - expected) * (count - expected) / expected;
      CHECK(passed > kCount / 10);
      CHECK(test::chi_squared_tail(statistic, kCells - 1) > 1e-4);
    }
  }
}
