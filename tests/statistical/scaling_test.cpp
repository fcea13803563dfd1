/// The same world measured in other units: lengths times 2^k, coefficients of media over 2^k, intensities times 4^k,
/// radiance and irradiance as they are. Powers of two change no digit of a float, so that the picture must be the same
/// to the last bit.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>

#include "support/measure.h"
#include "tyndall/io.h"
#include "tyndall/render.h"

using namespace tyndall;

namespace {

/// Numbers of a scene text that carry a unit: @ before a length, ~ before 1/length, ^ before length^2. Each is written
/// out for a world 2^k times as large.
std::string in_units(const std::string& text, int k) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int power = text[i] == '@' ? k : text[i] == '~' ? -k : text[i] == '^' ? 2 * k : 0;
    if (text[i] != '@' && text[i] != '~' && text[i] != '^') {
      out += text[i];
      continue;
    }
    std::size_t used = 0;
    const double value = std::stod(text.substr(i + 1), &used);
    char number[64];
    std::snprintf(number, sizeof number, "%.17g", std::ldexp(value, power));
    out += number;
    i += used;
  }
  return out;
}

Image picture(const std::string& text, int k, int spp = 4) {
  Scene scene = read_scene_text(in_units(text, k), "scaled.pbrt").scene;
  RenderSettings settings = scene.settings;
  settings.spp = spp;
  settings.threads = 1;
  settings.aovs = {"P", "Z", "Zvol"};
  const Rendering r = render(build(std::move(scene), {.lights = {settings.lights}, .threads = 1}), settings);
  CHECK(r.report.non_finite + r.report.majorant_violations + r.report.caps_hit == 0);
  return r.image;
}

/// How many values of `scaled` are not, to the last bit, those of `unit`, or 2^k times them where they are lengths.
int differing(const Image& scaled, const Image& unit, int k) {
  int count = 0;
  for (const char* name : {"R", "G", "B", "A", "P.X", "P.Y", "P.Z", "Z", "Zvol"}) {
    const bool length = name[0] == 'P' || name[0] == 'Z';
    const auto &x = scaled.find(name)->values, &y = unit.find(name)->values;
    for (std::size_t i = 0; i < x.size(); ++i) count += x[i] == (length ? std::ldexp(y[i], k) : y[i]) ? 0 : 1;
  }
  return count;
}

void check_scales(const std::string& text) {
  const Image unit = picture(text, 0);
  std::string broken;
  for (int k = -40; k <= 40; k += test::nightly() ? 1 : 8) {
    const int count = differing(picture(text, k), unit, k);
    if (count > 0) broken += " 2^" + std::to_string(k) + ": " + std::to_string(count) + " values;";
  }
  CHECK(broken == "");
}

const std::string kHead = R"(
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
Integrator "volpath" "integer maxdepth" 4
LookAt @0 @1 @-4  @0 @0.5 @0  0 1 0
Camera "perspective" "float fov" 45
WorldBegin
)";

const std::string kRoom = R"(
Material "diffuse" "rgb reflectance" [0.5 0.4 0.3]
Shape "trianglemesh" "point3 P" [@-4 @0 @-4 @4 @0 @-4 @4 @0 @4 @-4 @0 @4] "integer indices" [0 1 2 0 2 3]
)";

}  // namespace

TEST_CASE("surfaces and lights of every kind: the same bits at any scale") {
  check_scales(kHead + kRoom + R"(
LightSource "point" "point3 from" [@1 @3 @-1] "rgb I" [^9 ^9 ^9]
LightSource "spot" "point3 from" [@-1 @3 @-1] "point3 to" [@0 @0 @0] "rgb I" [^5 ^4 ^9]
LightSource "distant" "point3 from" [0 1 0.5] "point3 to" [0 0 0] "rgb L" [0.2 0.1 0.3]
LightSource "infinite" "rgb L" [0.1 0.2 0.3]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [4 4 3]
  Shape "trianglemesh" "point3 P" [@-1 @2 @0 @1 @2 @0 @1 @2.5 @1 @-1 @2.5 @1] "integer indices" [0 1 2 0 2 3]
  Translate @0.5 @1.5 @0.5
  Shape "sphere" "float radius" @0.25
AttributeEnd
Material "coatedconductor"
Translate @0 @0.6 @0
Shape "sphere" "float radius" @0.5
Material "dielectric"
Translate @1.25 @0 @0
Shape "cylinder" "float radius" @0.25 "float zmin" @-0.5 "float zmax" @0.5
)");
}

TEST_CASE("media, homogeneous and of grids, with an instance: the same bits at any scale") {
  check_scales(kHead + kRoom + R"(
LightSource "point" "point3 from" [@1 @3 @-1] "rgb I" [^9 ^9 ^9]
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [~1 ~1.5 ~2] "rgb sigma_a" [~0.25 ~0.25 ~0.5] "float g" 0.5
MakeNamedMedium "grid" "string type" "uniformgrid" "integer nx" 3 "integer ny" 3 "integer nz" 3
  "point3 p0" [@-0.5 @-0.5 @-0.5] "point3 p1" [@0.5 @0.5 @0.5] "rgb sigma_s" [~4 ~4 ~5] "rgb sigma_a" [~1 ~1 ~1]
  "float density" [0 1 2 1 0.5 1 2 1 0 0 1 2 1 0.5 1 2 1 0 0 1 2 1 0.5 1 2 1 0]
MakeNamedMedium "colours" "string type" "rgbgrid" "integer nx" 2 "integer ny" 1 "integer nz" 1 "float scale" ~2
  "point3 p0" [@-2 @0 @-1] "point3 p1" [@-1 @1 @0] "rgb sigma_s" [1 2 1 2 1 1] "rgb sigma_a" [0.5 0 0.5 0 0.5 1]
ObjectBegin "ball"
  MediumInterface "fog" ""
  Material "interface"
  Shape "sphere" "float radius" @0.5
ObjectEnd
AttributeBegin
  Translate @-0.75 @0.75 @0
  Rotate 30 0 1 0
  ObjectInstance "ball"
AttributeEnd
AttributeBegin
  MediumInterface "grid" ""
  Material "interface"
  Shape "sphere" "float radius" @0.875
AttributeEnd
AttributeBegin
  MediumInterface "colours" ""
  Material "interface"
  Translate @-1.5 @0.5 @-0.5
  Shape "sphere" "float radius" @0.5
AttributeEnd
)");
}

TEST_CASE("a world far from the origin: the same picture but for noise") {
  const std::string near = kHead + kRoom + R"(
LightSource "point" "point3 from" [@1 @3 @-1] "rgb I" [^9 ^9 ^9]
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [~1 ~1.5 ~2] "rgb sigma_a" [~0.25 ~0.25 ~0.5] "float g" 0.5
AttributeBegin
  MediumInterface "fog" ""
  Material "interface"
  Translate @0 @0.75 @0
  Shape "sphere" "float radius" @0.5
AttributeEnd
)";
  // Through transforms, which are composed in double precision.
  std::string far = near;
  const std::string move = "Translate 1000000 -1000000 3000000\n", back = "Translate -1000000 1000000 -3000000\n";
  far.insert(far.find("Camera"), back);  // world to camera: moves the camera by the opposite
  far.insert(far.find("WorldBegin") + 11, move);
  const Image a = picture(near, 0, 256), b = picture(far, 0, 256);
  double sum = 0, difference = 0;
  for (const char* name : {"R", "G", "B"}) {
    const auto &x = a.find(name)->values, &y = b.find(name)->values;
    for (std::size_t i = 0; i < x.size(); ++i) {
      sum += x[i];
      difference += std::abs(static_cast<double>(x[i]) - y[i]);
    }
  }
  CHECK(difference < 1e-3 * sum);  // equal samples: only rounding is left
}
