/// Reflectance and transmittance of slabs with Henyey-Greenstein scattering, by adding-doubling [van de Hulst 1980 is
/// its anchor], and the six cases of DISORT's first test [van de Hulst's table 12].
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>

#include "support/agreement.h"
#include "support/scene_text.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

// All slabs lie in -tau < z < 0 with sigma_t = 1 and 400 mean free paths from edge to edge. Light that enters by the
// sides needs 200 mean free paths to the middle; diffuse light in a slab of thickness tau dies out as
// exp(-pi x / (tau + 1.4 l)), l = 1 / (1 - g) the transport length: 1e-8 at the worst here (tau = 16, g = 0.85).
std::string slab(double tau, double g, Rgb albedo) {
  return homogeneous("m", {.sigma_a = Rgb(1.0f) - albedo, .sigma_s = albedo, .g = float(g)}) +
         medium_box("m", "", {{-200, -200, -float(tau)}, {200, 200, 0}});
}

/// A camera just above the slab that looks down at an angle of cosine mu.
std::string eye_above(double mu) {
  const double s = std::sqrt(1 - mu * mu), distance = 0.05 / mu;
  return view({.eye = {-float(s * distance), 0, float(mu * distance)}, .look = {0, 0, 0}, .max_depth = 100'000});
}

/// A black plane right beneath the slab. Sky L = 1 above: the radiance is the reflectance of a beam along the view.
std::string black_below(double tau) { return diffuse_plane(-float(tau) - 0.001f, 3000, 0); }

/// By reciprocity.
std::string reflectance(double mu, double tau, double g, Rgb albedo) {
  return eye_above(mu) + environment(1) + slab(tau, g, albedo) + black_below(tau);
}
/// A black plane above slab and camera; sky L = 1 from below: the total transmittance of a beam along the view.
std::string transmittance(double mu, double tau, double g, Rgb albedo) {
  return eye_above(mu) + environment(1) + slab(tau, g, albedo) + diffuse_plane(0.1f, 3000, 0);
}

std::string label(const char* what, double g, double tau) {
  std::array<char, 80> text;
  std::snprintf(text.data(), text.size(), "%s g=%g tau=%g", what, g, tau);
  return text.data();
}

/// Albedos .9, .99 and 1 are the channels of one medium.
struct Slab {
  double g, tau;
  std::array<double, 3> r, t;
};
constexpr std::array<Slab, 10> kSlabs{{
    {0.75, 2, {.09739, .15440, .16318}, {.66096, .81604, 1 - .16318}},
    {0.75, 8, {.16297, .43305, .50642}, {.13061, .41634, 1 - .50642}},
    {0.85, 4, {.08129, .17284, .19092}, {.49308, .76618, 1 - .19092}},
    {0, 1, {.26741, .33292, .34133}, {.59163, .65098, 1 - .34133}},
    {0, 4, {.40814, .64505, .69093}, {.12852, .27548, 1 - .69093}},
    {0, 0.5, {.16904, .19892, .20251}, {.76538, .79405, 1 - .20251}},
    {0, 16, {.41495, .75126, .90363}, {.00024, .02960, 1 - .90363}},
    {0.75, 4, {.14157, .28432, .31164}, {.39732, .64651, 1 - .31164}},
    {0.85, 2, {.05277, .08580, .09102}, {.72659, .88796, 1 - .09102}},
    {0.85, 16, {.10378, .41773, .55721}, {.03169, .30611, 1 - .55721}},
}};
constexpr std::size_t kPerCommit = 4;

// What the printed values leave open.
constexpr Agreement kFourDigits{.rounding = 5e-5}, kFiveDigits{.rounding = 5e-6};

Expected expected(const std::array<double, 3>& values) {
  Expected e;
  for (int k = 0; k < 3; ++k) {
    if (values[k] > 0.001) e[k] = values[k];  // fewer digits than d asks for
  }
  return e;
}

}  // namespace

TEST_CASE("slabs at normal incidence") {
  constexpr Rgb kAlbedos{0.9f, 0.99f, 1};
  const std::size_t count = nightly() ? kSlabs.size() : kPerCommit;
  for (std::size_t i = 0; i < count; ++i) {
    const Slab& s = kSlabs[i];
    check_agrees(label("slab R", s.g, s.tau), reflectance(1, s.tau, s.g, kAlbedos), expected(s.r), kFiveDigits);
    check_agrees(label("slab T", s.g, s.tau), transmittance(1, s.tau, s.g, kAlbedos), expected(s.t), kFiveDigits);
  }
}

TEST_CASE("a grey slab at normal incidence") {
  check_agrees(label("grey slab R", 0, 2), reflectance(1, 2, 0, Rgb(0.9f)), grey(.36165), kFiveDigits);
  check_agrees(label("grey slab T", 0, 2), transmittance(1, 2, 0, Rgb(0.9f)), grey(.35650), kFiveDigits);
}

// DISORT's test 1: isotropic scattering; a beam of flux pi at mu0 = 0.1, or a uniform sky of radiance 1. Cases 1 and 2
// (4 and 5) differ in the albedo only, 0.2 and 1: two channels of one medium. The third channel is idle.
namespace {

constexpr double kMu0 = 0.1;

std::string beam(double mu, double tau, Rgb albedo) {
  const auto s = float(std::sqrt(1 - kMu0 * kMu0));
  return eye_above(mu) + distant_light({s, 0, -float(kMu0)}, kPi / float(kMu0)) + slab(tau, 0, albedo) + black_below(tau);
}

}  // namespace

TEST_CASE("DISORT 1 and 2: beam on a thin slab") {
  constexpr Rgb kAlbedos{0.2f, 1, 0.2f};
  check_agrees("DISORT 1,2 radiance up mu=.1", beam(.1, .03125, kAlbedos), {.11777066, .6229, std::nullopt}, kFourDigits);
  check_agrees("DISORT 1,2 radiance up mu=.5", beam(.5, .03125, kAlbedos), {.02641704, .1398, std::nullopt}, kFourDigits);
  check_agrees("DISORT 1,2 radiance up mu=1", beam(1, .03125, kAlbedos), {.01340413, .0709, std::nullopt}, kFourDigits);
  check_agrees("DISORT 1,2 flux up / pi", reflectance(kMu0, .03125, 0, kAlbedos),
               {.0799451 / kPi, .4229218 / kPi, std::nullopt});
  check_agrees("DISORT 1,2 flux down / pi", transmittance(kMu0, .03125, 0, kAlbedos),
               {(2.29844 + .07941108) / kPi, 2.718671 / kPi, std::nullopt});
}

TEST_CASE("DISORT 3: uniform sky on a thin slab") {
  check_agrees("DISORT 3 radiance up mu=.1", reflectance(.1, .03125, 0, Rgb(0.99f)), grey(.1332), kFourDigits);
  if (!nightly()) return;  // darker, and so noisier
  check_agrees("DISORT 3 radiance up mu=.5", reflectance(.5, .03125, 0, Rgb(0.99f)), grey(.0300), kFourDigits);
  check_agrees("DISORT 3 radiance up mu=1", reflectance(1, .03125, 0, Rgb(0.99f)), grey(.0152), kFourDigits);
}

TEST_CASE("DISORT 4 and 5: beam on a thick slab") {
  constexpr Rgb kAlbedos{0.2f, 1, 0.2f};
  check_agrees("DISORT 4,5 radiance up mu=.1", beam(.1, 32, kAlbedos), {.262972, 1.93321, std::nullopt});
  check_agrees("DISORT 4 radiance up mu=.5", beam(.5, 32, Rgb(0.2f)), grey(.0906967));
  check_agrees("DISORT 4 radiance up mu=1", beam(1, 32, Rgb(0.2f)), grey(.0502853));
  if (!nightly()) return;  // light that comes from deep below takes hundreds of collisions
  check_agrees("DISORT 5 radiance up mu=.5", beam(.5, 32, Rgb(1.0f)), grey(1.02732));
  check_agrees("DISORT 5 radiance up mu=1", beam(1, 32, Rgb(1.0f)), grey(.797199));
}

TEST_CASE("DISORT 4 and 5: fluxes of a beam on a thick slab") {
  constexpr Rgb kAlbedos{0.2f, 1, 0.2f};
  check_agrees("DISORT 4,5 flux up / pi", reflectance(kMu0, 32, 0, kAlbedos), {.259686 / kPi, 3.07390 / kPi, std::nullopt});
  check_vanishes("DISORT 4 flux down / pi", transmittance(kMu0, 32, 0, Rgb(0.2f)), 1e-6);
  if (nightly()) check_agrees("DISORT 5 flux down / pi", transmittance(kMu0, 32, 0, Rgb(1.0f)), grey(.0676954 / kPi));
}

TEST_CASE("DISORT 6: uniform sky on a thick slab") {
  check_agrees("DISORT 6 radiance up mu=.1", reflectance(.1, 32, 0, Rgb(0.99f)), grey(.87751));
  check_agrees("DISORT 6 radiance up mu=.5", reflectance(.5, 32, 0, Rgb(0.99f)), grey(.815136));
  check_agrees("DISORT 6 radiance up mu=1", reflectance(1, 32, 0, Rgb(0.99f)), grey(.752715));
}
