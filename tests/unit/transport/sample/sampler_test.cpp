#include "transport/sample/sampler.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <vector>

using namespace tyndall;

namespace {

/// Whether each elementary interval of area 1/n, n = 2^log_n, holds exactly one of the n points: a (0, log_n, 2)-net.
bool is_net(const std::vector<Vec2>& points, int log_n) {
  for (int a = 0; a <= log_n; ++a) {
    const int columns = 1 << a, rows = 1 << (log_n - a);
    std::set<int> cells;
    for (const Vec2 p : points) cells.insert(static_cast<int>(p.y * rows) * columns + static_cast<int>(p.x * columns));
    if (cells.size() != points.size()) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("each half of a pixel's samples is a Sobol net in every pair of dimensions") {
  for (int replicate = 0; replicate < 2; ++replicate) {
    for (int pair = 0; pair < 8; ++pair) {
      std::vector<Vec2> points;
      for (int i = 0; i < 64; ++i) {
        Sampler sampler({.seed = 3, .x = 5, .y = 7, .sample = 2 * i + replicate});
        Vec2 p;
        for (int k = 0; k <= pair; ++k) p = sampler.next_2d();
        points.push_back(p);
      }
      CHECK(is_net(points, 6));
    }
  }
}

TEST_CASE("single dimensions are stratified, wide ones with 53 bits") {
  std::set<int> narrow, wide;
  std::set<double> low_bits;
  for (int i = 0; i < 256; ++i) {
    Sampler sampler({.seed = 1, .x = 0, .y = 0, .sample = 2 * i});
    narrow.insert(static_cast<int>(sampler.next_1d() * 256));
    const double u = sampler.next_wide();
    CHECK(u >= 0);
    CHECK(u < 1);
    wide.insert(static_cast<int>(u * 256));
    low_bits.insert(u * 0x1p32 - static_cast<double>(static_cast<std::uint64_t>(u * 0x1p32)));
  }
  CHECK(narrow.size() == 256);
  CHECK(wide.size() == 256);
  CHECK(low_bits.size() == 256);
}

TEST_CASE("the two replicates, pixels, seeds and dimensions are uncorrelated") {
  // 4096 pairs: the correlation of independent uniforms has standard deviation 1/64; 4.5 of them are allowed.
  const auto correlation = [](auto first, auto second) {
    double sum = 0;
    for (int i = 0; i < 4096; ++i) {
      Sampler a(first(i)), b(second(i));
      sum += (a.next_1d() - 0.5) * (b.next_1d() - 0.5) * 12;
    }
    return sum / 4096;
  };
  const auto key = [](int x, int y, int sample, std::uint64_t seed) { return SampleKey{seed, x, y, sample}; };
  const double limit = 4.5 / 64;
  CHECK(std::abs(correlation([&](int i) { return key(i, 0, 0, 0); }, [&](int i) { return key(i, 0, 1, 0); })) < limit);
  CHECK(std::abs(correlation([&](int i) { return key(i, 0, 0, 0); }, [&](int i) { return key(i + 1, 0, 0, 0); })) < limit);
  CHECK(std::abs(correlation([&](int i) { return key(i, 0, 0, 0); }, [&](int i) { return key(0, i, 0, 0); })) < limit);
  CHECK(std::abs(correlation([&](int i) { return key(i, 2, 0, 0); }, [&](int i) { return key(i, 2, 0, 1); })) < limit);
}

TEST_CASE("the dimensions of one sample are uncorrelated: no number comes twice") {
  constexpr int kDimensions = 40, kKeys = 1024;
  std::vector<std::vector<double>> numbers(kDimensions);
  for (int i = 0; i < kKeys; ++i) {
    Sampler sampler(SampleKey{.seed = 4, .x = i, .y = 1, .sample = 3});
    for (int d = 0; d < kDimensions; ++d) {
      const Vec2 pair = sampler.next_2d();
      const double u = d % 4 == 1 ? sampler.next_wide() : d % 4 == 2 ? sampler.next_1d() : d % 4 == 3 ? pair.y : pair.x;
      numbers[static_cast<std::size_t>(d)].push_back(u - 0.5);
    }
  }
  // 780 pairs: 5 standard deviations of 1/32 are passed by chance once in 2,000 times.
  for (std::size_t a = 0; a < kDimensions; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      double sum = 0;
      for (std::size_t i = 0; i < kKeys; ++i) sum += numbers[a][i] * numbers[b][i] * 12;
      CHECK_MESSAGE(std::abs(sum / kKeys) < 5.0 / 32, a, " and ", b);
    }
  }
}

TEST_CASE("what a step draws does not depend on how many numbers the steps before it drew") {
  Sampler a({9, 1, 2, 3}), b({9, 1, 2, 3});
  a.next_2d();
  a.begin_step(4);
  for (int i = 0; i < 1000; ++i) b.next_1d();
  b.begin_step(4);
  const float first = a.next_1d();
  CHECK(first == b.next_1d());
  CHECK(a.next_1d() == b.next_1d());
  a.begin_step(5);
  CHECK(first != a.next_1d());
}

TEST_CASE("a stream depends on its key alone") {
  Sampler a({9, 1, 2, 3}), b({9, 1, 2, 3});
  for (int i = 0; i < 10; ++i) CHECK(a.next_1d() == b.next_1d());
  CHECK(a.stream().next() == b.stream().next());
}
