/// Media at the ends of what numbers hold, against closed forms: optical depths to 10^6, albedos 0 and 1, g near 1, many
/// media in one place.
#include <doctest/doctest.h>

#include <cmath>

#include "support/agreement.h"
#include "support/scene_text.h"
#include "support/transport_oracles.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};
constexpr int kMany = 64;

Bounds3 cube(float half) { return {{-half, -half, -half}, {half, half, half}}; }

/// Along +z, a little off the axis, before a sky of radiance L.
std::string along_z(float z, float L = 1, const std::string& media = "", const std::string& medium = "") {
  return view({.eye = {0.13f, 0.07f, z},
               .look = {0.13f, 0.07f, z + 1},
               .resolution = 8,
               .max_depth = 100'000,
               .before_camera = media,
               .medium = medium}) +
         environment(L);
}

double henyey_greenstein(double g, double cosine) {
  return (1 - g * g) / (4 * 3.14159265358979323846 * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// "name0" .. "name63", the first of them absorbing sigma(0), and so on.
template <typename Sigma>
std::string absorbers(const Sigma& sigma) {
  std::string text;
  for (int i = 0; i < kMany; ++i) text += homogeneous("m" + std::to_string(i), {.sigma_a = Rgb(sigma(i))});
  return text;
}

}  // namespace

TEST_CASE("optical depths from 0 to 10^6: what comes through, and what volume emission adds") {
  constexpr std::array<Rgb, 4> kDepths{{{0, 1e-6f, 1e-3f}, {0.1f, 1, 10}, {20, 50, 80}, {1e2f, 1e4f, 1e6f}}};
  for (const Rgb& tau : kDepths) {
    const std::string name = "tau " + number(tau.r) + " " + number(tau.g) + " " + number(tau.b);
    Expected through, emitted;
    for (int k = 0; k < 3; ++k) {
      if (tau[k] <= 80) through[k] = std::exp(-double{tau[k]});
      if (tau[k] > 0) emitted[k] = -std::expm1(-double{tau[k]});
    }
    const Rgb sigma_a = tau * 0.5f;
    check_agrees(name + ", through", along_z(-3) + homogeneous("m", {.sigma_a = sigma_a}) + medium_box("m", "", kBox), through);
    check_agrees(name + ", glow",
                 along_z(-3, 0) + homogeneous("m", {.sigma_a = sigma_a, .Le = Rgb(1.0f)}) + medium_box("m", "", kBox), emitted);
  }
  check_vanishes("tau 10^6, through", along_z(-3) + homogeneous("m", {.sigma_a = Rgb(5e5f)}) + medium_box("m", "", kBox),
                 1e-30);
}

/// The face z = 1 of a box of optical depth `tau`, seen at cosine mu.
std::string dense_box(double tau, double mu, Rgb albedo, const std::string& light) {
  const auto s = float(std::sqrt(1 - mu * mu)), c = float(mu), sigma_t = float(tau / 2);
  return view({.eye = {-s, 0, 1 + c}, .look = {0, 0, 1}, .max_depth = 100'000}) + light +
         homogeneous("m", {.sigma_a = (Rgb(1.0f) - albedo) * sigma_t, .sigma_s = albedo * sigma_t}) + medium_box("m", "", kBox);
}

// Collisions must neither be thrown across the boundary that they are next to nor be kept away from it: both took most of
// the light once. At 10^6 a mean free path is 16 steps of the floats that positions are made of, which costs a little.
TEST_CASE("optical depths to 10^6: half-spaces under a sky, and under a sun") {
  const float albedo = 0.8f;
  const Variant at_collisions{.media = MediaStrategy::vertex};
  for (const double tau : {1e2, 1e4, 1e6}) {
    for (const double mu : {0.3, 1.0}) {
      if (mu == 1 && !nightly()) continue;
      const double h = chandrasekhar_h(albedo, mu);
      const double sky = 1 - h * std::sqrt(1 - albedo);
      const double sun = albedo / (4 * 3.14159265358979323846) * h * chandrasekhar_h(albedo, 1) / (mu + 1);
      const double rounded = tau > 1e5 ? 0.015 : 0;
      const double d = nightly() ? 0.003 : 0.02;
      const std::string name = "half-space, tau=" + number(tau) + " mu=" + number(mu);
      check_agrees(name + ", sky", dense_box(tau, mu, Rgb(albedo), environment(1)), grey(sky),
                   {.d = d, .rounding = rounded * sky});
      check_agrees(name + ", sun", dense_box(tau, mu, Rgb(albedo), distant_light({0, 0, -1}, 1)), grey(sun),
                   {.d = d, .rounding = rounded * sun, .variant = at_collisions});
    }
  }
}

TEST_CASE("albedo 1 in uniform light: nothing is lost, however often it is scattered and wherever to") {
  const View outside{
      .eye = {2.2f, 1.8f, -2.6f}, .look = {0, 0, 0}, .fov_degrees = 35, .resolution = 16, .max_depth = 1'000'000};
  for (const float g : {-0.999f, 0.0f, 0.999f}) {
    for (const float depth : {1e-3f, 10.0f, 100.0f}) {
      check_agrees(
          "albedo 1, tau=" + number(depth) + " g=" + number(g),
          view(outside) + environment(1) + homogeneous("m", {.sigma_s = Rgb(depth / 2), .g = g}) + medium_box("m", "", kBox),
          grey(1));
    }
  }
}

TEST_CASE("g = +-0.999: scattered once by a slab, straight on, straight back and within and beside the lobe") {
  constexpr double kTau = 2, kAlbedo = 0.8;
  for (const double g : {0.999, -0.999}) {
    for (const double degrees : {0.0, 0.03, 1.0, 60.0}) {
      const double a = degrees * 3.14159265358979323846 / 180, mu = std::cos(a);
      const Coefficients fog{.sigma_a = Rgb(1 - float(kAlbedo)), .sigma_s = Rgb(float(kAlbedo)), .g = float(g)};
      const std::string slab = homogeneous("m", fog) + medium_box("m", "", {{-200, -200, -1}, {200, 200, 1}});
      const std::string camera = view({.eye = {0.13f, 0.07f, -2}, .look = {0.13f, 0.07f, 0}, .max_depth = 1});
      const std::string title = "g=" + number(g) + ", " + number(degrees) + " degrees ";
      // From the camera's side: E mu / (1 + mu) (1 - exp(-tau (1 + 1 / mu))).
      const double back = kAlbedo * henyey_greenstein(fog.g, -mu) * -std::expm1(-kTau * (1 + 1 / mu)) * mu / (1 + mu);
      check_agrees(title + "back", camera + distant_light({float(std::sin(a)), 0, float(mu)}, 1) + slab, grey(back));
      // From behind: the light's segment is tau - t long where the view's is t.
      const double k = 1 - 1 / mu, lengths = std::abs(k) < 1e-9 ? kTau : std::expm1(-k * kTau) / -k;
      const double on = kAlbedo * henyey_greenstein(fog.g, mu) * std::exp(-kTau / mu) * lengths;
      check_agrees(title + "on", camera + distant_light({float(std::sin(a)), 0, -float(mu)}, 1) + slab, grey(on));
    }
  }
}

TEST_CASE("64 media in one place are one") {
  const auto share = [](int i) { return float(i + 1) / (kMany * (kMany + 1) / 2); };  // they add up to 1
  std::string boxes, shells;
  for (int i = 0; i < kMany; ++i) {
    boxes += medium_box("m" + std::to_string(i), "", kBox);
    shells += medium_box("m" + std::to_string(i), "", cube(1 + 0.01f * float(i)));
  }
  double within = 0, through = 0;
  for (int i = 0; i < kMany; ++i) {
    through += 2 * share(i) * (1 + 0.01 * i);
    within += share(i) * (1 + 0.01 * i);
  }
  const std::string media = absorbers(share);
  check_agrees("64 equal boxes", along_z(-3) + media + boxes, grey(std::exp(-2.0)));
  check_agrees("64 equal boxes, from within", along_z(0) + media + boxes, grey(std::exp(-1.0)));
  check_agrees("64 overlapping boxes", along_z(-3) + media + shells, grey(std::exp(-through)));
  check_agrees("64 overlapping boxes, from within", along_z(0) + media + shells, grey(std::exp(-within)));
}

TEST_CASE("64 nested media, each in the place of the one around it") {
  const auto sigma = [](int i) { return 0.02f * float(1 + i % 5); };  // from outside in
  for (const bool round : {false, true}) {
    std::string shells;
    double within = 0;
    for (int i = 0; i < kMany; ++i) {
      const auto edge = [&](int k) { return k == kMany ? 0.0f : 1 - 0.013f * float(k); };
      const std::string outer = i == 0 ? "" : "m" + std::to_string(i - 1), inner = "m" + std::to_string(i);
      const std::string ball = block("Material \"interface\"\nMediumInterface \"" + inner + "\" \"" + outer +
                                     "\"\nShape \"sphere\" \"float radius\" " + number(edge(i)) + "\n");
      shells += round ? ball : medium_box(inner, outer, cube(edge(i)));
      const auto half = [&](int k) {
        return !round || k == kMany ? double{edge(k)} : std::sqrt(double{edge(k)} * edge(k) - 0.13 * 0.13 - 0.07 * 0.07);
      };
      within += sigma(i) * (half(i) - half(i + 1));
    }
    const std::string name = round ? "64 nested balls" : "64 nested boxes";
    check_agrees(name, along_z(-3) + absorbers(sigma) + shells, grey(std::exp(-2 * within)));
    check_agrees(name + ", from within", along_z(0) + absorbers(sigma) + shells, grey(std::exp(-within)));
    check_agrees(name + ", from within, declared", along_z(0, 1, absorbers(sigma), "m63") + shells, grey(std::exp(-within)));
  }
}

TEST_CASE("64 scattering media in one place make one medium's picture") {
  const std::string front =
      view({.eye = {2.2f, 1.8f, -2.6f}, .look = {0, 0, 0}, .fov_degrees = 40, .resolution = 16, .max_depth = 4}) +
      point_light({0.5f, 2, -1}, 5) + environment(0.2f);
  const Coefficients whole{.sigma_a = Rgb(0.1f), .sigma_s = {1, 0.5f, 2}, .g = 0.4f};
  std::string parts;
  for (int i = 0; i < kMany; ++i) {
    const std::string name = "m" + std::to_string(i);
    parts += homogeneous(name, {.sigma_a = whole.sigma_a / kMany, .sigma_s = whole.sigma_s / kMany, .g = whole.g}) +
             medium_box(name, "", kBox);
  }
  check_same("64 scattering media",
             {{"one", front + homogeneous("m", whole) + medium_box("m", "", kBox)}, {"64", front + parts}},
             {.d = nightly() ? 0.003 : 0.04});
}
