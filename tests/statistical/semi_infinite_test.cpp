/// A half-space of isotropic scatterers under a uniform sky: emergent radiance 1 - H(mu) sqrt(1 - w).
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>

#include "support/agreement.h"
#include "support/scene_text.h"
#include "support/transport_oracles.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

/// Printed H(mu) for mu = 0.2, 0.5, 1.
struct Row {
  double w;
  std::array<double, 3> values;
};
constexpr std::array<double, 3> kMu{0.2, 0.5, 1};
constexpr std::array<Row, 5> kTable{{{0.5, {1.1134614, 1.1877351, 1.2512596}},
                                     {0.8, {1.2286388, 1.4132626, 1.5982195}},
                                     {0.9, {1.2914337, 1.5560338, 1.8500985}},
                                     {0.99, {1.3997672, 1.8486010, 2.4727928}},
                                     {0.999, {1.4344159, 1.9586875, 2.7560725}}}};

/// The slab z < 0, a "half-space" of 300 mean free paths by 1000 x 1000, sigma_t = 1, seen from above. The intensity
/// of w = 0.99 falls as exp(-t / 5.8), that of 0.999 as exp(-t / 18): what comes from below or from the sides is
/// less than 1e-7.
std::string half_space(double mu, Rgb albedo) {
  const auto s = float(std::sqrt(1 - mu * mu)), c = float(mu);
  return view({.eye = {-s, 0, c}, .look = {0, 0, 0}, .max_depth = 100'000}) + environment(1) +
         homogeneous("m", {.sigma_a = Rgb(1.0f) - albedo, .sigma_s = albedo}) +
         medium_box("m", "", {{-500, -500, -300}, {500, 500, 0}});
}

double emergent(double w, double mu) { return 1 - chandrasekhar_h(w, mu) * std::sqrt(1 - w); }

std::string label(const char* what, double mu) {
  std::array<char, 80> text;
  std::snprintf(text.data(), text.size(), "half-space w=%s mu=%g", what, mu);
  return text.data();
}

}  // namespace

TEST_CASE("the quadrature agrees with the printed H function") {
  for (const Row& row : kTable) {
    for (std::size_t i = 0; i < kMu.size(); ++i) {
      CAPTURE(row.w);
      CAPTURE(kMu[i]);
      CHECK(std::abs(chandrasekhar_h(row.w, kMu[i]) - row.values[i]) < 1e-6);
    }
  }
}

TEST_CASE("half-space, three albedos in the channels of one medium") {
  for (const double mu : {0.2, 0.5, 1.0}) {
    check_agrees(label(".5,.9,.99", mu), half_space(mu, {0.5f, 0.9f, 0.99f}),
                 {emergent(0.5, mu), emergent(0.9, mu), emergent(0.99, mu)});
  }
}

TEST_CASE("half-space, grey") {
  check_agrees(label(".8", 0.7), half_space(0.7, Rgb(0.8f)), grey(emergent(0.8, 0.7)));
  if (nightly()) check_agrees(label(".999", 0.4), half_space(0.4, Rgb(0.999f)), grey(emergent(0.999, 0.4)));
}
