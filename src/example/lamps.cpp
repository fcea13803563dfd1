#include "example/lamps.h"

#include <cmath>

#include "math/frame.h"
#include "math/warp.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

Rgb with_mean_one(Rgb c) { return c / mean(c); }

void add_triangle(TriangleMesh& mesh, const Lamp& lamp, float area, float spin) {
  // A circle of radius r holds an equilateral triangle of area 3 sqrt(3) / 4 r^2.
  const float r = std::sqrt(area * 4 / (3 * std::sqrt(3.0f)));
  const Frame frame = Frame::around(lamp.normal);
  for (int k = 0; k < 3; ++k) {
    const float angle = spin + static_cast<float>(k) * 2 * kPi / 3;
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(lamp.position + frame.to_world({r * std::cos(angle), r * std::sin(angle), 0}));
  }
}

}  // namespace

void shade_from(Vec3 eye, std::vector<Lamp>& lamps) {
  for (Lamp& lamp : lamps) {
    if (dot(lamp.normal, eye - lamp.position) > 0) lamp.normal = -lamp.normal;
  }
}

Rng stream(std::uint64_t seed, std::uint64_t purpose) { return Rng(hash(seed, purpose)); }

float normal_deviate(Rng& rng) {  // [Box and Muller 1958]
  const double radius = std::sqrt(-2 * std::log(1 - rng.uniform_wide()));
  return static_cast<float>(radius * std::cos(2 * double(kPi) * rng.uniform_wide()));
}

Vec3 unit_vector(Rng& rng) {
  const float u = rng.uniform();
  return square_to_uniform_sphere({u, rng.uniform()});
}

std::vector<float> log_normal_shares(std::size_t n, float sigma, Rng& rng) {
  std::vector<double> weights(n);
  double sum = 0;
  for (double& w : weights) sum += w = std::exp(double(sigma) * normal_deviate(rng));
  std::vector<float> shares(n);
  for (std::size_t i = 0; i < n; ++i) shares[i] = static_cast<float>(weights[i] / sum);
  return shares;
}

Rgb hue_color(float hue) {
  const auto channel = [&](float offset) { return 0.5f + 0.5f * std::cos(2 * kPi * (hue - offset)); };
  return Rgb(channel(0), channel(1 / 3.0f), channel(2 / 3.0f)) * 0.985f + Rgb(0.015f);
}

void share_power(std::vector<Lamp>& lamps, float sigma, Rng& rng) {
  const std::vector<float> shares = log_normal_shares(lamps.size(), sigma, rng);
  for (std::size_t i = 0; i < lamps.size(); ++i) lamps[i].share = shares[i];
}

void add_emission(PbrtText& text, Rgb radiance) {
  text << "  Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n";
  text << "  AreaLightSource \"diffuse\" \"rgb L\" [" << radiance << "]\n";
}

void add_triangle_lamps(std::span<const Lamp> lamps, const LampSet& set, Rng& rng, PbrtText& text,
                        std::vector<ExampleFile>& files) {
  std::vector<TriangleMesh> meshes(set.palette.size());
  for (const Lamp& lamp : lamps)
    add_triangle(meshes[static_cast<std::size_t>(lamp.color)], lamp, lamp.share * set.area, 2 * kPi * rng.uniform());

  const float radiance = set.power / (kPi * set.area);  // a Lambertian emitter of area A gives pi A L
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (meshes[i].indices.empty()) continue;
    const std::string name = set.name + (meshes.size() > 1 ? "_" + std::to_string(i) : "") + ".ply";
    files.push_back({name, encode_ply(meshes[i])});
    text << "AttributeBegin\n";
    add_emission(text, with_mean_one(set.palette[i]) * radiance);
    text << "  Shape \"plymesh\" \"string filename\" \"" << name << "\"\nAttributeEnd\n";
  }
}

void add_point_lamps(std::span<const Lamp> lamps, const LampSet& set, PbrtText& text) {
  for (const Lamp& lamp : lamps) {
    const Rgb color = with_mean_one(set.palette[static_cast<std::size_t>(lamp.color)]);
    const Rgb I = color * (lamp.share * set.power / (4 * kPi));
    text << "LightSource \"point\" \"rgb I\" [" << I << "] \"point3 from\" [" << lamp.position << "]\n";
  }
}

}  // namespace tyndall
