#include "math/distribution.h"

#include <doctest/doctest.h>

#include <numeric>

#include "math/rng.h"
#include "support/chi_squared.h"
#include "support/relative.h"

namespace tyndall {
namespace {

std::vector<double> random_weights(std::size_t n, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<double> weights(n);
  for (double& w : weights) w = rng.uniform() < 0.2f ? 0 : std::exp(8 * rng.uniform_wide());
  return weights;
}

TEST_CASE("an alias table draws indices with their stated probability") {
  for (const std::size_t n : {1u, 2u, 3u, 17u, 1000u}) {
    std::vector<double> weights = random_weights(n, n);
    weights.back() = 1;
    const AliasTable table(weights);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    CHECK(table.total() == doctest::Approx(total));
    std::vector<double> counts(n), pmf(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      pmf[i] = table.pmf(i);
      CHECK(pmf[i] == test::relative(weights[i] / total));
    }
    Rng rng(7 + n);
    constexpr int kDraws = 400'000;
    for (int i = 0; i < kDraws; ++i) {
      const auto s = table.sample(rng.uniform_wide());
      REQUIRE(s.pmf > 0);
      REQUIRE(s.pmf == table.pmf(s.index));
      counts[s.index] += 1;
    }
    if (n > 1) CHECK(test::count_p_value(counts, pmf, kDraws) > 1e-4);
  }
}

TEST_CASE("an alias table partitions the unit interval exactly") {
  // The share of u that leads to each index, by a fine regular grid over every slot.
  const std::vector<double> weights{5, 0, 1, 2, 0, 8};
  const AliasTable table(weights);
  std::vector<double> share(weights.size());
  constexpr int kSteps = 600'000;
  for (int i = 0; i < kSteps; ++i) share[table.sample((i + 0.5) / kSteps).index] += 1.0 / kSteps;
  for (std::uint32_t i = 0; i < weights.size(); ++i) CHECK(share[i] == doctest::Approx(table.pmf(i)).epsilon(1e-5));
}

TEST_CASE("odd weights are harmless") {
  const AliasTable zero(std::vector<double>{0, 0, 0, 0});
  CHECK(zero.total() == 0);
  CHECK(zero.pmf(2) == 0.25);
  const AliasTable odd(std::vector<double>{std::nan(""), -1, 1e308, 1e308, double(kInfinity), 1e-300});
  CHECK(odd.pmf(0) == 0);
  CHECK(odd.pmf(1) == 0);
  CHECK(odd.pmf(4) == 0);
  CHECK(odd.pmf(2) == doctest::Approx(0.5));
  for (const double u : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0x1.fffffffffffffp-1}) CHECK(odd.sample(u).pmf > 0);
  CHECK(AliasTable().empty());
}

TEST_CASE("a piecewise constant density integrates to one and inverts its distribution function") {
  const std::vector<float> weights{0, 3, 1, 0, 0, 4, 0};
  const PiecewiseConstant1D d(weights);
  double integral = 0;
  for (int i = 0; i < 7; ++i) integral += d.pdf((i + 0.5f) / 7) / 7;
  CHECK(integral == doctest::Approx(1));
  float previous = -1;
  for (int i = 0; i <= 1000; ++i) {
    const auto s = d.sample(std::min(i / 1000.0f, kOneMinusEpsilon));
    REQUIRE(s.x >= previous);
    REQUIRE(s.x < 1);
    REQUIRE(s.pdf > 0);
    REQUIRE(s.pdf == d.pdf(s.x));
    REQUIRE(s.cell == static_cast<std::uint32_t>(s.x * 7));
    previous = s.x;
  }
  CHECK(d.sample(0.375f).x == doctest::Approx(2 / 7.0));  // three of eight parts lie in cell 1
}

TEST_CASE("a piecewise constant density without weight is uniform") {
  const PiecewiseConstant1D d(std::vector<float>(5, 0.0f));
  CHECK(d.total() == 0);
  CHECK(d.pdf(0.9f) == 1);
  CHECK(d.sample(0.3f).x == doctest::Approx(0.3f));
}

TEST_CASE("a two-dimensional density draws cells with their probability, and evaluates what it draws") {
  constexpr int kWidth = 13, kHeight = 7;
  const std::vector<double> random = random_weights(kWidth * kHeight, 3);
  const std::vector<float> weights(random.begin(), random.end());
  const PiecewiseConstant2D d(kWidth, kHeight, weights);
  const double total = std::accumulate(random.begin(), random.end(), 0.0);
  CHECK(d.total() == doctest::Approx(total));

  std::vector<double> counts(weights.size()), pmf(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) pmf[i] = random[i] / total;
  Rng rng(5);
  constexpr int kDraws = 400'000;
  for (int i = 0; i < kDraws; ++i) {
    const float ux = rng.uniform(), uy = rng.uniform();
    const auto s = d.sample({ux, uy});
    REQUIRE(s.pdf == d.pdf(s.p));
    REQUIRE(s.pdf == test::relative(pmf[s.y * kWidth + s.x] * kWidth * kHeight).epsilon(1e-4));
    counts[s.y * kWidth + s.x] += 1;
  }
  CHECK(test::count_p_value(counts, pmf, kDraws) > 1e-4);
}

TEST_CASE("tables of any size, with runs of zeros, are inverted as by search from the start") {
  Rng rng(11);
  for (std::size_t size = 1; size <= 60; ++size) {
    std::vector<float> weights(size);
    for (float& w : weights) w = rng.uniform() < 0.5f ? 0.0f : rng.uniform();
    weights[rng.next() % size] = 100;
    const PiecewiseConstant1D table(weights);
    std::vector<float> edges{0};
    double running = 0;
    for (const float w : weights) edges.push_back(static_cast<float>(std::min((running += w) / table.total(), 1.0)));
    for (int i = 0; i < 400; ++i) {
      const float edge = edges[rng.next() % edges.size()];
      const float u = std::clamp(i % 4 == 0   ? rng.uniform()
                                 : i % 4 == 1 ? edge
                                              : std::nextafter(edge, i % 4 == 2 ? 0.0f : 1.0f),
                                 0.0f, 0x1.fffffep-1f);
      std::size_t cell = 0;
      for (std::size_t k = 0; k < size; ++k) {
        if (edges[k] <= u && weights[k] > 0) cell = k;
      }
      if (weights[cell] > 0) REQUIRE(table.sample(u).cell == cell);
    }
  }
}

}  // namespace
}  // namespace tyndall
