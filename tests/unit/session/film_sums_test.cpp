#include "session/film_sums.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "math/rng.h"

using namespace tyndall;

namespace {

/// Terms as pixels get them: of either sign, over many magnitudes.
std::vector<float> terms(int count, int magnitudes, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<float> values;
  for (int i = 0; i < count; ++i) {
    const float size = std::exp2(static_cast<float>(magnitudes) * (rng.uniform() - 0.5f));
    values.push_back((rng.uniform() - 0.2f) * size);
  }
  return values;
}

FilmSums sum_of(std::span<const float> values) {
  FilmSums sums(1);
  for (const float v : values) sums.add(0, v);
  return sums;
}

}  // namespace

TEST_CASE("a film's sum is the same however its terms are grouped, and the exact one rounded") {
  // Doubles alone differ in the last bit for a third of these; __float128 has 113 bits.
  int doubles_differ = 0;
  for (int run = 0; run < 300; ++run) {
    const std::vector<float> all = terms(1024, 40, static_cast<std::uint64_t>(run));
    const FilmSums whole = sum_of(all);
    FilmSums joined(1);
    for (const std::size_t part : {7, 0, 3, 1, 2, 6, 5, 4}) {
      const FilmSums piece = sum_of(std::span(all).subspan(part * 128, 128));
      joined.add(0, piece.high()[0], piece.low()[0]);
    }
    __float128 exact = 0;
    for (const float v : all) exact += v;
    REQUIRE(joined.value(0) == whole.value(0));
    REQUIRE(whole.value(0) == static_cast<double>(exact));
    doubles_differ += std::accumulate(all.begin(), all.end(), 0.0) != static_cast<double>(exact);
  }
  CHECK(doubles_differ > 30);
}

TEST_CASE("parts of a film's sums are copied and cleared") {
  FilmSums sums(4), other(2);
  for (std::size_t i = 0; i < 4; ++i) sums.add(i, static_cast<float>(i + 1));
  sums.add(1, 1e-12f);
  other.copy(sums, 1, 2, 0);
  CHECK(other.value(0) == sums.value(1));
  CHECK(other.low()[0] == sums.low()[1]);
  sums.clear(1, 2);
  CHECK(sums.value(0) == 1);
  CHECK(sums.value(1) == 0);
  CHECK(sums.value(2) == 0);
  CHECK(sums.value(3) == 4);
}
