/// Numeric kernels of src/transport against their promises, at their worst.
#include <span>

#include "support/adversarial.h"
#include "transport/techniques/mis.h"
#include "transport/techniques/resampling.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// A density: zero, ordinary, or as extreme as floats are.
float density(Adversary& any) { return any.below(8) == 0 ? 0.0f : any.positive(120); }

struct Weighted {
  float weight;
};

}  // namespace

TEST_CASE("kernels: weights of multiple importance sampling sum to 1") {
  check_kernel("two techniques", [](Adversary& any) {
    const float a = density(any), b = density(any);
    if (a == 0 && b == 0) return Fault();
    const float wa = mis_weight(a, b), wb = mis_weight(b, a);
    return holds(wa >= 0 && wb >= 0 && std::abs(wa + wb - 1) < 1e-6f, a, b, wa, wb);
  });
  check_kernel("three techniques", [](Adversary& any) {
    const float a = density(any), b = density(any), c = density(any);
    if (a == 0 && b == 0 && c == 0) return Fault();
    const float wa = mis_weight(a, b, c), wb = mis_weight(b, c, a), wc = mis_weight(c, a, b);
    return holds(wa >= 0 && wb >= 0 && wc >= 0 && std::abs(wa + wb + wc - 1) < 1e-6f, a, b, c, wa + wb + wc);
  });
}

TEST_CASE("kernels: resampling") {
  check_kernel("survivors", [](Adversary& any) {
    std::array<Weighted, 6> weights{};
    const auto n = 1 + any.below(6);
    const bool ties = any.below(4) == 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      weights[i].weight = ties ? std::exp2(-static_cast<float>(any.below(8) < 7 ? any.below(3) : 53)) : any.positive(60);
    }
    const std::span<const Weighted> candidates(weights.data(), n);
    const int count = static_cast<int>(any.below(4));
    const Survivors survivors = resample(candidates, count, any.unit());
    const std::size_t expected = count == 0 || n <= static_cast<std::uint32_t>(count) ? n : static_cast<std::size_t>(count);
    if (survivors.size() != expected) return holds(false, n, count, survivors.size());
    double least = kInfinity;
    for (const Survivor& s : survivors) {
      if (s.index >= n || !(s.scale >= 1)) return holds(false, n, count, s.index, s.scale);
      least = std::min(least, double(s.scale) * weights[s.index].weight);
    }
    // Those that were not sure to survive stand for the same weight c each, the others have no less, and the sum of
    // min(1, weight / c) is their number.
    bool drawn = false;
    for (const Survivor& s : survivors) {
      if (s.scale == 1) continue;
      drawn = true;
      const double scaled = double(s.scale) * weights[s.index].weight;
      if (!(scaled <= least * (1 + 1e-6))) return holds(false, n, count, scaled, least);
    }
    double expected_count = 0;
    for (const Weighted& w : candidates) expected_count += std::min(1.0, w.weight / least);
    if (drawn && !(std::abs(expected_count - count) <= 1e-5)) return holds(false, n, count, expected_count);
    for (std::size_t i = 1; i < survivors.size(); ++i) {
      if (survivors[i].index <= survivors[i - 1].index) return holds(false, n, count, i);
    }
    return Fault();
  });
}
