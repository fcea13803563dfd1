/// Lights behind panes: what shadow rays see through them, against closed forms and against paths that pass them.
#include <doctest/doctest.h>

#include <cmath>

#include "support/agreement.h"
#include "support/scene_text.h"
#include "support/strategies.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

std::string sheet(const std::string& material, float z) {
  const std::string at = number(z);
  return block("Material " + material + "\nShape \"bilinearmesh\" \"point3 P\" [-5 -5 " + at + "  5 -5 " + at + "  -5 5 " + at +
               "  5 5 " + at + "]\n");
}

/// A small emitter far before a wall that the camera sees beside it: radiance 50 from a square of half-side 0.02, 3 away.
std::string lit_wall(int max_depth) { return view({.eye = {0.4f, 0, 1}, .look = {0.4f, 0, 3}, .max_depth = max_depth}); }
constexpr double kReflectance = 0.6;

std::string wall() {
  return block(
      "Material \"diffuse\" \"rgb reflectance\" [0.6 0.6 0.6]\nReverseOrientation\n"
      "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 3  1 -1 3  -1 1 3  1 1 3]\n");
}

std::string small_emitter() {
  return block(
      "AreaLightSource \"diffuse\" \"rgb L\" [50 50 50] \"bool twosided\" true\nMaterial \"diffuse\" \"rgb reflectance\" [0 0 "
      "0]\n"
      "Shape \"bilinearmesh\" \"point3 P\" [-0.02 -0.02 0  0.02 -0.02 0  -0.02 0.02 0  0.02 0.02 0]\n");
}

/// Share of a pane of index `eta` that lets light through at `cosine`, all orders of reflection in it summed.
double passes(double eta, double cosine) {
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
  const double s = (cosine - eta * inside) / (cosine + eta * inside), p = (eta * cosine - inside) / (eta * cosine + inside);
  const double once = 0.5 * (s * s + p * p);
  return (1 - once) / (1 + once);
}

/// Of the emitter at the wall, 0.4 beside its axis and 3 away, without its size: (0.02 / 3)^2 of the value.
double unblocked() {
  const double d2 = 9 + 0.16, cosine2 = 9 / d2;
  return kReflectance / 3.14159265358979 * 50 * 0.0016 * cosine2 / d2;
}

}  // namespace

TEST_CASE("what lies behind panes is lit through them, by closed forms") {
  const double cosine = 3 / std::sqrt(9.16);
  const std::string bare = wall() + small_emitter(), pane = sheet("\"thindielectric\" \"float eta\" 2", 0.7f);
  const Agreement how{.d = 0.002, .rounding = 1e-4 * unblocked()};
  check_agrees("no pane", lit_wall(1) + bare, grey(unblocked()), how);
  check_agrees("a pane", lit_wall(2) + bare + pane, grey(unblocked() * passes(2, cosine)), how);
  const std::string second = sheet("\"thindielectric\" \"float eta\" 1.3", 0.5f);
  check_agrees("two panes", lit_wall(3) + bare + pane + second, grey(unblocked() * passes(2, cosine) * passes(1.3, cosine)),
               how);
  const std::string half =
      "MakeNamedMaterial \"w\" \"string type\" \"diffuse\" \"rgb reflectance\" [0 0 0]\n"
      "MakeNamedMaterial \"t\" \"string type\" \"thindielectric\" \"float eta\" 2\n";
  check_agrees("a pane, half of it painted black",
               lit_wall(2) + half + bare + sheet("\"mix\" \"string materials\" [\"w\" \"t\"] \"float amount\" 0.25", 0.7f),
               grey(0.25 * unblocked() * passes(2, cosine)), {.d = 0.005, .rounding = how.rounding});
  const std::string smoke = homogeneous("m", {.sigma_a = Rgb(0.3f)}) + medium_box("m", "", {{-4, -4, 0.2f}, {4, 4, 2.2f}});
  check_agrees("a pane in what absorbs", lit_wall(2) + bare + pane + smoke,
               grey(unblocked() * passes(2, cosine) * std::exp(-0.3 * 2 / cosine) * std::exp(-0.3 * 1.2)), how);
}

// A bounce is what each pane counts, and points are not seen through any, as in pbrt.
TEST_CASE("panes count as bounces, and points are dark behind them") {
  const std::string pane = sheet("\"thindielectric\" \"float eta\" 2", 0.7f);
  check_vanishes("too few bounces", lit_wall(1) + wall() + small_emitter() + pane, 1e-6);
  check_vanishes("a point", lit_wall(9) + wall() + point_light({0, 0, 0}, 9) + pane, 1e-6);
}

TEST_CASE("F1: a white plane among panes, under a sky and in a box of lights") {
  const std::string plane = view({.eye = {0.1f, 0.2f, 2}, .look = {0.1f, 0.2f, 0}, .max_depth = 300}) +
                            diffuse_plane(0.1f, 0.5f, 1) + sheet("\"thindielectric\" \"float eta\" 1.8", 0.8f) +
                            sheet("\"thindielectric\"", 1.3f);
  const std::string lights = block(
      "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true\nMaterial \"diffuse\" \"rgb reflectance\" [0 0 "
      "0]\n" +
      box_mesh({{-7, -8, -9}, {10, 9, 8}}));
  const std::string smoke =
      homogeneous("m", {.sigma_s = {0.4f, 0.2f, 0.6f}, .g = 0.5f}) + medium_box("m", "", {{-4, -4, -4}, {4, 4, 4}});
  const Agreement how{.d = nightly() ? 0.002 : 0.01};
  check_agrees("F1 behind panes, sky", plane + environment(1), {1.0, 1.0, 1.0}, how);
  check_agrees("F1 behind panes, lights", plane + lights, {1.0, 1.0, 1.0}, how);
  check_agrees("F1 behind panes in smoke, sky", plane + smoke + environment(1), {1.0, 1.0, 1.0}, how);
  check_agrees("F1 behind panes in smoke, lights", plane + smoke + lights, {1.0, 1.0, 1.0}, how);
}
