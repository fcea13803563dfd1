#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "transport/techniques/mis.h"

using namespace tyndall;

namespace {

/// Densities from none over denormal ones to what is beyond all floats; squares of most are not floats.
constexpr std::array<float, 11> kDensities{0, 1e-45f, 1e-39f, 1e-30f, 1e-10f, 0.5f, 1, 1e10f, 1e30f, 3e38f, kInfinity};

double squared(float x) { return double{x} * x; }

/// Of a in a + b; as a float that may be denormal.
doctest::Approx share(double a, double b) { return doctest::Approx(a / (a + b)).scale(1e-35); }

bool is_share(float w) { return w >= 0 && w <= 1; }

}  // namespace

TEST_CASE("MIS weights of two techniques are shares of one, however small or large their densities") {
  for (const float a : kDensities) {
    for (const float b : kDensities) {
      CAPTURE(a);
      CAPTURE(b);
      const float w = mis_weight(a, b);
      CHECK(is_share(w));
      if (a == 0 && b == 0) continue;
      CHECK(w + mis_weight(b, a) == doctest::Approx(1));
      if (a < kInfinity && b < kInfinity) CHECK(w == share(squared(a), squared(b)));
    }
  }
}

TEST_CASE("MIS weights of three techniques are shares of one") {
  for (const float a : kDensities) {
    for (const float b : kDensities) {
      for (const float c : kDensities) {
        CAPTURE(a);
        CAPTURE(b);
        CAPTURE(c);
        const float w = mis_weight(a, b, c);
        CHECK(is_share(w));
        const bool finite = a < kInfinity && b < kInfinity && c < kInfinity;
        if (!finite || (a == 0 && b == 0 && c == 0)) continue;
        CHECK(w == share(squared(a), squared(b) + squared(c)));
        CHECK(w + mis_weight(b, c, a) + mis_weight(c, a, b) == doctest::Approx(1));
      }
    }
  }
}
