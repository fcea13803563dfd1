/// Lattices of few points.
#include "transport/pixel/fibonacci_lattice.h"

#include <doctest/doctest.h>

#include <vector>

#include "math/rng.h"
#include "support/chi_squared.h"

namespace tyndall {
namespace {

constexpr int kSide = 8, kShifts = 20'000;

std::size_t cell(Vec2 p) { return static_cast<std::size_t>(p.y * kSide) * kSide + static_cast<std::size_t>(p.x * kSide); }

TEST_CASE("moved evenly, a lattice covers the square evenly, and has a point in each part of each side") {
  for (const int count : {1, FibonacciLattice::kFew, FibonacciLattice::kMany}) {
    CAPTURE(count);
    Rng rng(3);
    int uneven = 0;  // by rounding, of points at the borders of parts
    const std::vector<int> even(static_cast<std::size_t>(count), 1);
    std::vector<double> counts(kSide * kSide);
    for (int k = 0; k < kShifts; ++k) {
      const FibonacciLattice lattice(count, {rng.uniform(), rng.uniform()});
      std::vector<int> columns(static_cast<std::size_t>(count)), rows(columns.size());
      for (int i = 0; i < count; ++i) {
        const Vec2 p = lattice[i];
        REQUIRE((p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1));
        ++columns[static_cast<std::size_t>(p.x * static_cast<float>(count))];
        ++rows[static_cast<std::size_t>(p.y * static_cast<float>(count))];
        counts[cell(p)] += 1.0 / count;  // of a lattice's points not one is independent of another: too even, never uneven
      }
      uneven += columns != even || rows != even;
    }
    CHECK(uneven < kShifts / 1000);
    CHECK(test::count_p_value(counts, std::vector<double>(kSide * kSide, 1.0 / (kSide * kSide)), kShifts) > 1e-3);
  }
}

}  // namespace
}  // namespace tyndall
