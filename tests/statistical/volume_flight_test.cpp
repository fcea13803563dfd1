/// Free flights: where they collide, what they carry and what they gather, against integration along the ray.
#include <doctest/doctest.h>

#include <array>
#include <string>

#include "support/chi_squared.h"
#include "support/flights.h"
#include "volume/homogeneous.h"
#include "volume/medium_data.h"

using namespace tyndall;
using test::check_flight, test::exact_flight, test::fly, test::kBins, test::kDiagonal, test::kT1;
using test::Exact, test::Flown, test::Moments;

TEST_CASE("grey media: collisions follow T sigma_t, weights are the albedo") {
  for (const float depth : {0.01f, 0.5f, 3.0f, 20.0f}) {
    const auto fog = test::homogeneous({Rgb{0.1f * depth}, Rgb{0.4f * depth}, 0}, Rgb{1.5f});
    const auto clumpy = test::clumpy({Rgb{0.2f * depth}, Rgb{0.5f * depth}, 0}, 8, Rgb{0.7f});
    const ParticipatingMedium *one[] = {&fog}, *two[] = {&clumpy}, *both[] = {&clumpy, &fog};
    const std::string at = " at " + std::to_string(depth);
    check_flight("fog" + at, one, Rgb{1.0f});
    check_flight("clumpy" + at, two, Rgb{1.0f});
    check_flight("both" + at, both, Rgb{1.0f});
  }
}

TEST_CASE("grey collisions fill equal parts of 1 - T alike (chi-squared)") {
  const auto clumpy = test::clumpy({Rgb{0.3f}, Rgb{0.9f}, 0}, 8);
  const ParticipatingMedium* media[] = {&clumpy};
  // Cumulative distribution on a fine lattice.
  constexpr int kSteps = 40000, kCount = 200000, kCells = 50;
  std::vector<double> cumulative{0};
  double depth = 0;
  for (int i = 0; i < kSteps; ++i) {
    depth += clumpy.at(kDiagonal.at((static_cast<float>(i) + 0.5f) * kT1 / kSteps)).sigma_t().r * kT1 / kSteps;
    cumulative.push_back(1 - std::exp(-depth));
  }
  std::vector<int> cells(kCells + 1);
  Rng rng(5);
  TrackingStats stats;
  for (int i = 0; i < kCount; ++i) {
    const Flight flight = free_flight(media, kDiagonal, 0, kT1, Rgb{1.0f}, rng.uniform(), rng, stats);
    if (!flight.collided) {
      ++cells[kCells];
      continue;
    }
    CHECK(flight.weight.r == doctest::Approx(0.75f));
    const double x = flight.t / kT1 * kSteps;
    const auto k = std::min<std::size_t>(kSteps - 1, static_cast<std::size_t>(x));
    const double u = (cumulative[k] + (cumulative[k + 1] - cumulative[k]) * (x - double(k))) / cumulative.back();
    ++cells[std::min<std::size_t>(kCells - 1, static_cast<std::size_t>(u * kCells))];
  }
  double statistic = 0;
  for (int i = 0; i <= kCells; ++i) {
    const double expected = i == kCells ? kCount * (1 - cumulative.back()) : kCount * cumulative.back() / kCells;
    statistic += (cells[static_cast<std::size_t>(i)] - expected) * (cells[static_cast<std::size_t>(i)] - expected) / expected;
  }
  CHECK(test::chi_squared_tail(statistic, kCells) > 1e-4);
}

TEST_CASE("chromatic media: every channel is right for any throughput, and weights stay bounded") {
  const auto fog = test::homogeneous({{0.1f, 0.0f, 0.6f}, {0.2f, 1.0f, 3.0f}, 0}, {1, 0.5f, 2});
  const auto clumpy = test::clumpy({{0.1f, 1.0f, 3.0f}, {0.8f, 0.2f, 1.0f}, 0.3f}, 9, {0.3f, 1, 2});
  const auto other = test::clumpy({{1.5f, 0.0f, 0.2f}, {0.0f, 0.0f, 2.0f}, -0.3f}, 10);
  const ParticipatingMedium *one[] = {&fog}, *two[] = {&clumpy}, *three[] = {&clumpy, &other, &fog};
  for (const Rgb beta : {Rgb{1.0f}, Rgb{1, 0.1f, 0.01f}, Rgb{0.02f, 0.5f, 1}, Rgb{0, 1, 0.3f}, Rgb{1e-30f, 3e-30f, 2e-30f}}) {
    check_flight("fog", one, beta);
    check_flight("clumpy", two, beta);
    check_flight("three", three, beta);
  }
}

TEST_CASE("media that do not scatter let paths through with a weight") {
  const auto fog = test::homogeneous({{0.1f, 1.0f, 3.0f}, {}, 0}, Rgb{1.0f});
  const auto clumpy = test::clumpy({{0.5f, 1.0f, 8.0f}, {}, 0}, 9, Rgb{1.0f});
  const ParticipatingMedium *one[] = {&fog}, *two[] = {&clumpy}, *both[] = {&fog, &clumpy};
  check_flight("fog", one, Rgb{1.0f});
  check_flight("clumpy", two, Rgb{1.0f});
  check_flight("both", both, Rgb{1.0f});

  // Little enough is left for roulette.
  const auto thick = test::clumpy({Rgb{10.0f}, {}, 0}, 9, Rgb{1.0f});
  const ParticipatingMedium* dense[] = {&thick};
  const double through = exact_flight(dense, kDiagonal, kT1).through[0];
  CHECK(through > 1e-4);
  CHECK(through < 1e-2);
  check_flight("thick", dense, Rgb{1.0f}, 200000);
}

TEST_CASE("emission that a gauge weighs, looked at once and more often") {
  /// Weights that vary along the ray.
  class Slope final : public EmissionGauge {
   public:
    Rgb counted(MediaView, Vec3 p, Rgb emission) const override { return emission * weight(p); }
    static float weight(Vec3 p) { return 0.5f + 0.4f * std::sin(3 * length(p - kDiagonal.o)); }
  };
  const auto fog = test::homogeneous({{0.2f, 1, 4}, {0.5f, 0.1f, 0}, 0}, Rgb{1.0f, 2.0f, 0.5f});
  const auto clumpy = test::clumpy({{0.2f, 1, 4}, {0.3f, 0.3f, 0.3f}, 0.9f}, 2, Rgb{1.0f});
  const ParticipatingMedium *one[] = {&fog}, *two[] = {&clumpy}, *both[] = {&fog, &clumpy};
  for (const MediaView media : {MediaView(one), MediaView(two), MediaView(both)}) {
    Rgb depth, exact;
    constexpr int kSteps = 40000;
    for (int i = 0; i < kSteps; ++i) {
      const float dt = kT1 / kSteps;
      const Vec3 p = kDiagonal.at((static_cast<float>(i) + 0.5f) * dt);
      Rgb sigma_t, emission;
      for (const ParticipatingMedium* medium : media) {
        const Coefficients c = medium->at(p);
        sigma_t += c.sigma_t();
        emission += c.sigma_a * c.Le;
      }
      depth += sigma_t * dt;
      exact += exp(depth * -1.0f) * emission * (Slope::weight(p) * dt);
    }
    for (const float density : {1.0f, 4.0f}) {
      Rng rng(8);
      TrackingStats stats;
      std::array<Moments, 3> counted;
      const Slope slope;
      for (int i = 0; i < 60000; ++i) {
        const Rgb e = emission_and_transmittance(media, kDiagonal, 0, kT1, {&slope, density}, rng, stats).emitted;
        for (int c = 0; c < 3; ++c) counted[static_cast<std::size_t>(c)].add(e[c]);
      }
      for (int c = 0; c < 3; ++c) CHECK(counted[static_cast<std::size_t>(c)].deviation(exact[c], 2e-3 * exact[c]) < 4);
    }
  }
}

TEST_CASE("furnace: an emitting slab of albedo 0 and Le = 1 gives 1 - T, with light of 1 behind it 1") {
  const auto fog = test::homogeneous({{0.2f, 1, 4}, {}, 0}, Rgb{1.0f});
  const auto clumpy = test::clumpy({{0.2f, 1, 4}, {}, 0.9f}, 2, Rgb{1.0f});
  const ParticipatingMedium *one[] = {&fog}, *two[] = {&clumpy}, *both[] = {&fog, &clumpy};
  for (const MediaView media : {MediaView(one), MediaView(two), MediaView(both)}) {
    const test::LineIntegrals exact = test::integrate_line(media, kDiagonal, 0, kT1);
    Rng rng(6);
    TrackingStats stats;
    std::array<Moments, 3> emitted, furnaces, segments;
    for (int i = 0; i < 40000; ++i) {
      const Flight flight = free_flight(media, kDiagonal, 0, kT1, Rgb{1.0f}, rng.uniform(), rng, stats);
      const EmissionTransmittance segment = emission_and_transmittance(media, kDiagonal, 0, kT1, {}, rng, stats);
      for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        emitted[channel].add(segment.emitted[c]);
        furnaces[channel].add(segment.emitted[c] + (flight.collided ? 0.0f : flight.weight[c]));
        segments[channel].add(segment.emitted[c] + segment.transmittance[c]);
      }
    }
    for (int c = 0; c < 3; ++c) {
      const auto channel = static_cast<std::size_t>(c);
      CHECK(emitted[channel].deviation(1 - exact.transmittance(c), 1e-4) < 4);
      CHECK(furnaces[channel].deviation(1, 1e-5) < 4);
      CHECK(segments[channel].deviation(1, 1e-5) < 4);
      CHECK(std::abs(furnaces[channel].mean() - 1) < 0.02);
    }
  }
}

TEST_CASE("look-ups above the majorant are counted and stay unbiased") {
  const auto clumpy = test::clumpy({Rgb{0.3f}, Rgb{0.9f, 0.5f, 0.7f}, 0}, 8);
  const BrickGrid& grid = clumpy.data().density.grid;
  // Spoil the maxima of the hierarchy: walk it and lower each.
  std::vector<std::pair<std::uint32_t, int>> nodes{{grid.root(), grid.root_level()}};
  while (!nodes.empty()) {
    const auto [node, level] = nodes.back();
    nodes.pop_back();
    const_cast<ValueRange&>(grid.ranges(node)[0]).max *= 0.6f;
    for (int i = 0; i < std::popcount(grid.node(node).mask); ++i)
      nodes.emplace_back(grid.node(node).first + static_cast<std::uint32_t>(i), level - 1);
  }
  const ParticipatingMedium* media[] = {&clumpy};
  const Exact exact = exact_flight(media, kDiagonal, kT1);
  const Flown flown = fly(media, kDiagonal, kT1, Rgb{1.0f}, 100000);
  CHECK(flown.stats.majorant_violations > 0);
  for (int c = 0; c < 3; ++c) CHECK(flown.through[static_cast<std::size_t>(c)].deviation(exact.through[c], 1e-4) < 4);
}

TEST_CASE("two media of half the density are one, and a constant grid is a homogeneous medium") {
  const test::Optics whole{{0.2f, 0.4f, 0.6f}, {1.0f, 0.8f, 0.5f}, 0.4f},
      half{whole.sigma_a * 0.5f, whole.sigma_s * 0.5f, 0.4f};
  const auto one = test::clumpy(whole, 4), first = test::clumpy(half, 4), second = test::clumpy(half, 4);
  const auto fog = test::homogeneous(whole), thin = test::homogeneous(half);
  // Filled cells reach half a cell beyond the ray's ends.
  const auto constant = test::grid({8, -8, 8}, whole, [](int) { return 1.0f; });
  const ParticipatingMedium *a[] = {&one}, *b[] = {&first, &second}, *c[] = {&fog}, *d[] = {&thin, &thin}, *e[] = {&constant};
  const Flown flown[] = {fly(a, kDiagonal, kT1, Rgb{1.0f}, 60000), fly(b, kDiagonal, kT1, Rgb{1.0f}, 60000),
                         fly(c, kDiagonal, kT1, Rgb{1.0f}, 60000), fly(d, kDiagonal, kT1, Rgb{1.0f}, 60000),
                         fly(e, kDiagonal, kT1, Rgb{1.0f}, 60000)};
  const auto same = [](const Flown& x, const Flown& y) {
    double worst = 0;
    for (std::size_t channel = 0; channel < 3; ++channel)
      for (std::size_t bin = 0; bin < kBins; ++bin) {
        const Moments &m = x.scattered[bin][channel], &n = y.scattered[bin][channel];
        if (m.mean() > 0 && n.mean() > 0)
          worst = std::max(worst, std::abs(m.mean() - n.mean()) / std::hypot(m.standard_error(), n.standard_error()));
      }
    return worst;
  };
  CHECK(same(flown[0], flown[1]) < 4.5);
  CHECK(same(flown[2], flown[3]) < 4.5);
  CHECK(same(flown[2], flown[4]) < 4.5);
}

TEST_CASE("the constant grid of majorant equal to its density gives nothing that is not finite") {
  const auto constant = test::grid(
      {8, -8, 8}, {{0.7f, 0.1f, 1e-3f}, {0.3f, 0.9f, 1.0f}, 0}, [](int) { return 1.0f; }, Rgb{1.0f});
  const auto rounded = test::grid({8, -8, 8}, {{0.7f, 0.1f, 1e-3f}, {0.3f, 0.9f, 1.0f}, 0},
                                  [](int i) { return 1.0f + 1e-7f * static_cast<float>(i % 3); });
  const ParticipatingMedium *a[] = {&constant}, *b[] = {&rounded}, *both[] = {&constant, &rounded};
  Rng rng(7);
  TrackingStats stats;
  int bad = 0;
  for (const MediaView media : {MediaView(a), MediaView(b), MediaView(both)})
    for (int i = 0; i < 300000; ++i) {
      const Flight flight =
          free_flight(media, kDiagonal, 0, kT1, Rgb{1, 0.5f, 0.2f}, i % 100 ? rng.uniform() : kOneMinusEpsilon, rng, stats);
      bad += is_finite(flight.weight) && std::isfinite(flight.t) ? 0 : 1;
    }
  CHECK(bad == 0);
  CHECK(stats.majorant_violations == 0);
}

TEST_CASE("homogeneous flights pass as often as passage_of() says") {
  const auto coloured = test::homogeneous({Rgb{0.1f, 0, 0.4f}, Rgb{0.05f, 0.7f, 0.3f}, 0});
  const auto grey = test::homogeneous({Rgb{0.2f}, Rgb{0.3f}, 0});
  const auto absorbing = test::homogeneous({Rgb{0.3f, 0.1f, 2}, Rgb{}, 0});
  const ParticipatingMedium *one[] = {&coloured}, *two[] = {&coloured, &grey}, *none[] = {&absorbing};
  constexpr int kCount = 200000;
  for (const MediaView media : {MediaView(one), MediaView(two), MediaView(none)}) {
    for (const Rgb beta : {Rgb{1.0f}, Rgb{3, 0.1f, 0}, Rgb{0, 0, 0.2f}}) {
      const UniformPassage passage = passage_of(media, 1.7, beta);
      Rng rng(11);
      TrackingStats stats;
      int passed = 0;
      for (int i = 0; i < kCount; ++i)
        passed += !free_flight(media, kDiagonal, 0.3f, 2, beta, rng.uniform(), rng, stats).collided;
      // Nine comparisons, each within 4.5 standard errors: off by 0.5 % of the probability at most.
      const double p = passage.probability, error = std::sqrt(p * (1 - p) / kCount);
      CHECK(std::abs(static_cast<double>(passed) / kCount - p) <= 4.5 * error);
      CHECK(passage.transmittance == sum_of(media).transmittance(1.7));
    }
  }
}
