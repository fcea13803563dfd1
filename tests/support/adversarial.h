/// Properties of numeric kernels over many random cases, half of them where arithmetic breaks: zeros, ends of ranges,
/// subnormals, the nearly equal, the huge.
///
///     check_kernel("frame around a normal", [](Adversary& any) {
///       const Vec3 n = any.direction();
///       const Frame f = Frame::around(n);
///       return holds(std::abs(dot(f.x, n)) < 1e-6f, n);
///     });
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

#include "math/rng.h"
#include "support/sanitized.h"
#include "tyndall/math.h"

namespace tyndall::test {

/// Inputs of one case. The first half of the cases is ordinary, the second nasty.
class Adversary {
 public:
  Adversary(std::uint64_t seed, bool nasty) : rng_(seed), nasty_(nasty) {}

  /// In [0, 1): the ends and their neighbours often.
  float unit() {
    constexpr std::array<float, 8> kEdges{0, 0x1p-24f, 0x1p-32f, 0x1p-100f, 0.25f, 0.5f, 0.75f, kOneMinusEpsilon};
    return strange() ? pick(kEdges) : rng_.uniform();
  }
  Vec2 square() {
    const float x = unit();
    return {x, unit()};
  }
  /// In [low, high], the ends and what lies next to them often.
  float between(float low, float high) {
    if (!strange()) return std::clamp(low + (high - low) * rng_.uniform(), low, high);
    switch (rng_.next() % 4) {
      case 0:
        return low;
      case 1:
        return high;
      case 2:
        return std::clamp(std::nextafter(low, high), low, high);
      default:
        return std::clamp(std::nextafter(high, low), low, high);
    }
  }
  /// Positive, over 2^-exponent .. 2^exponent.
  float positive(float exponent) {
    return std::exp2((2 * rng_.uniform() - 1) * (strange() ? exponent : std::min(exponent, 4.0f)));
  }
  /// Either sign; now and then zero, or so small that it is subnormal.
  float real(float exponent) {
    const float sign = rng_.next() & 1 ? 1.0f : -1.0f;
    if (strange() && rng_.next() % 4 == 0) return sign * (rng_.next() & 1 ? 0.0f : std::numeric_limits<float>::denorm_min());
    return sign * positive(exponent);
  }
  Vec3 vector(float exponent) {
    const float x = real(exponent), y = real(exponent);
    return {x, y, real(exponent)};
  }
  /// Unit to rounding: along axes, and a little off them, often.
  Vec3 direction() {
    for (;;) {
      Vec3 v{2 * rng_.uniform() - 1, 2 * rng_.uniform() - 1, 2 * rng_.uniform() - 1};
      if (strange()) {
        const int axis = static_cast<int>(rng_.next() % 3);
        const float off = rng_.next() & 1 ? 0.0f : std::exp2(-30 * rng_.uniform());
        const float sign = rng_.next() & 1 ? 1.0f : -1.0f;
        v = v * off;
        v[axis] = sign;
      }
      const double l = std::sqrt(double(v.x) * v.x + double(v.y) * v.y + double(v.z) * v.z);
      if (l > 1e-3) return {static_cast<float>(v.x / l), static_cast<float>(v.y / l), static_cast<float>(v.z / l)};
    }
  }
  /// Above the plane z = 0, often barely.
  Vec3 upper_direction() {
    Vec3 w = direction();
    w.z = std::max(std::abs(w.z), strange() ? 1e-20f : 1e-3f);
    return normalize(w);
  }
  bool chance() { return rng_.next() & 1; }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(rng_.next() % n); }

 private:
  template <typename Values>
  float pick(const Values& values) {
    return values[rng_.next() % values.size()];
  }
  bool strange() { return nasty_ && rng_.next() % 2 == 0; }

  Rng rng_;
  bool nasty_;
};

/// What is wrong with a case; nothing: it holds.
using Fault = std::optional<std::string>;

inline void write(std::ostream& out, Vec2 v) { out << "(" << v.x << ", " << v.y << ")"; }
inline void write(std::ostream& out, Vec3 v) { out << "(" << v.x << ", " << v.y << ", " << v.z << ")"; }
template <typename T>
void write(std::ostream& out, const T& v) {
  out << v;
}
template <typename... Values>
Fault holds(bool condition, const Values&... values) {
  if (condition) return std::nullopt;
  std::ostringstream out;
  out.precision(9);
  ((out << " ", write(out, values)), ...);
  return out.str();
}

/// 10^6 cases per commit, 10^8 nightly, 10^5 with sanitizers.
inline std::uint64_t kernel_cases() {
  const char* nightly = std::getenv("TYNDALL_NIGHTLY");
  return nightly != nullptr && std::string(nightly) == "1" ? 100'000'000 : fewer(1'000'000);
}

/// `property`: of an Adversary, gives a Fault.
template <typename Property>
void check_kernel(const std::string& name, const Property& property) {
  CAPTURE(name);
  const std::uint64_t cases = kernel_cases();
  std::uint64_t wrong = 0;
  Fault first;
  for (std::uint64_t i = 0; i < cases; ++i) {
    Adversary any(i * 0x9e3779b97f4a7c15 + 1, i % 2 == 1);
    if (const Fault fault = property(any)) {
      if (wrong++ == 0) first = "case " + std::to_string(i) + ":" + *fault;
    }
  }
  INFO(first.value_or(""));
  CHECK(wrong == 0);
}

}  // namespace tyndall::test
