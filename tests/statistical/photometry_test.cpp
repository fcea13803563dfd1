/// Photometric files against closed forms: on a surface, and scattered once in fog.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "support/agreement.h"
#include "support/scene_text.h"
#include "support/scratch.h"
#include "support/transport_oracles.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr double kRight = 1.57079632679489662, kAgree = 0.005;

/// A profile as a file, and what it says: W/sr by the angles from straight down and from +x to +z, in radians.
struct Luminaire {
  std::string name, file;
  std::function<double(double, double)> I;
};

/// Of type C, in candela by degrees.
std::string ies(const std::vector<int>& vertical, const std::vector<int>& horizontal,
                const std::function<double(int, int)>& candela) {
  std::string text = "IESNA:LM-63-2002\nTILT=NONE\n2 -1 683 " + std::to_string(vertical.size()) + " " +
                     std::to_string(horizontal.size()) + " 1 2 0 0 0 1 1 10\n";
  for (const auto* angles : {&vertical, &horizontal})
    for (const int degrees : *angles) text += std::to_string(degrees) + "\n";
  for (const int h : horizontal)
    for (const int v : vertical) text += number(candela(v, h)) + "\n";
  return text;
}

/// Linear between 0, 45, 90 and 180 degrees down to up, and between 0, 90 and 180 around; in right angles.
double broken(double v, double h) { return (v < 0.5 ? 1 + 2 * v : v < 1 ? 3 - 2 * v : 2 - v) * (h < 1 ? 1 + h : 3 * h - 1); }

std::vector<Luminaire> luminaires() {
  std::vector<int> every_two;
  for (int v = 0; v <= 90; v += 2) every_two.push_back(v);
  return {{"even", ies({0, 180}, {0}, [](int, int) { return 1; }), [](double, double) { return 1.0; }},
          {"cosine", ies(every_two, {0}, [](int v, int) { return std::cos(v * kRight / 90); }),
           [](double theta, double) { return std::max(std::cos(theta), 0.0); }},
          {"table", ies({0, 45, 90, 180}, {0, 90, 180}, [](int v, int h) { return broken(v / 90.0, h / 90.0); }),
           [](double theta, double phi) { return broken(theta / kRight, std::abs(phi) / kRight); }}};
}

std::string luminaire_at(Vec3 p, const std::string& path) {
  return block("Translate " + number(p.x) + " " + number(p.y) + " " + number(p.z) +
               "\nLightSource \"goniometric\" \"string filename\" \"" + path + "\"");
}

}  // namespace

TEST_CASE("photometric lights on a surface") {
  const Scratch folder;
  for (const Luminaire& l : luminaires()) {
    const std::string path = folder / (l.name + ".ies");
    write_bytes(path, l.file);
    for (const Vec3 light : {Vec3{0.3f, 0.5f, 0.2f}, Vec3{-0.6f, 0.8f, -0.4f}}) {
      const double x = -light.x, y = -light.y, z = 1 - light.z, r = std::sqrt(x * x + y * y + z * z);
      const double E = l.I(std::acos(-y / r), std::atan2(z, x)) * z / (r * r * r);
      const double L = E * 0.5 / (2 * kRight);
      // Without noise the table shows: linear between every two degrees it is up to 1.5e-4 below the cosine.
      check_agrees(
          "surface, " + l.name,
          view({.eye = {0, 0, 0}, .look = {0, 0, 1}, .max_depth = 1}) + luminaire_at(light, path) + diffuse_plane(1, 1, 0.5f),
          grey(L), {.d = kAgree, .rounding = 2e-4 * L});
    }
  }
}

// Along the ray t = d + h tan(a): the light sees it under the angle |a| from straight down, ahead of it or behind.
TEST_CASE("photometric lights in fog") {
  const Scratch folder;
  const double sigma_t = 0.5, h = 0.7, d = 1.2;
  for (const Luminaire& l : luminaires()) {
    const std::string path = folder / (l.name + ".ies");
    write_bytes(path, l.file);
    const auto f = [&](double a) {
      return l.I(std::abs(a), a < 0 ? -kRight : kRight) * std::exp(-sigma_t * (d + h * std::tan(a) + h / std::cos(a)));
    };
    const double expected =
        (integrate(f, -std::atan2(d, h), 0, 400) + integrate(f, 0, kRight, 800)) / (8 * kRight * h) * 0.8 * sigma_t;
    const std::string fog = homogeneous("fog", {.sigma_a = Rgb(0.1f), .sigma_s = Rgb(0.4f)});
    check_agrees("fog, " + l.name,
                 view({.eye = {0, 0, 0}, .look = {0, 0, 1}, .max_depth = 1, .before_camera = fog, .medium = "fog"}) +
                     luminaire_at({0, float(h), float(d)}, path),
                 grey(expected), {.d = kAgree});
  }
}
