/// BSDFs and directions that the tests of this folder share.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "surface/bsdf.h"

namespace tyndall::test {

struct BsdfCase {
  std::string name;
  Bsdf bsdf;
};

/// Not aligned with anything, so that a forgotten change of frame shows.
inline Frame tilted_frame() { return Frame::around(normalize(Vec3{0.3f, -0.5f, 0.8f}), {1, 0.2f, 0}); }

inline Bsdf make(const Bsdf::Lobe& lobe) { return {tilted_frame(), lobe}; }

inline ConductorLobe metal(float ax, float ay) {
  return {.ggx = Ggx(ax, ay), .eta = {0.2f, 0.92f, 1.1f}, .k = {3.9f, 2.45f, 2.14f}};
}

inline DielectricLobe glass(float eta, float ax, float ay) { return {.eta = eta, .ggx = Ggx(ax, ay)}; }

/// Lobes with an exact density that is not narrow.
inline std::vector<BsdfCase> smooth_cases() {
  return {{"diffuse", make(DiffuseLobe{{0.2f, 0.5f, 0.8f}})},
          {"diffuse transmission", make(DiffuseTransmissionLobe{{0.4f, 0.2f, 0.1f}, {0.1f, 0.3f, 0.2f}})},
          {"metal 0.3", make(metal(0.3f, 0.3f))},
          {"metal 0.4 x 0.08", make(metal(0.4f, 0.08f))},
          {"metal 1", make(metal(1, 1))},
          {"glass 0.3", make(glass(1.5f, 0.3f, 0.3f))},
          {"glass 0.5 x 0.15", make(glass(1.5f, 0.5f, 0.15f))},
          {"glass 1", make(glass(1.33f, 1, 1))},
          {"bubble 0.3", make(glass(1 / 1.5f, 0.3f, 0.3f))},
          {"diamond 0.2", make(glass(2.4f, 0.2f, 0.2f))}};
}

inline Vec3 polar(float theta_degrees, float phi_degrees) {
  const float t = theta_degrees * kPi / 180, p = phi_degrees * kPi / 180;
  return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

/// Local directions to look from: along the normal, oblique, grazing, and from inside.
inline std::vector<Vec3> view_directions() {
  return {{0, 0, 1}, polar(40, 30), polar(75, 200), polar(89.5f, 100), polar(150, -60), polar(96, 10)};
}

/// Reproducible uniform numbers.
class TestRandom {
 public:
  explicit TestRandom(std::uint64_t seed) : engine_(seed) {}
  float operator()() { return float(engine_() >> 40) * 0x1p-24f; }
  Vec2 pair() {
    const float x = (*this)(), y = (*this)();
    return {x, y};
  }
  Vec3 direction() {
    const Vec2 u = pair();
    const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
    return {r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z};
  }

 private:
  std::mt19937_64 engine_;
};

/// Mean and its standard error.
class Estimate {
 public:
  void add(double x) {
    ++n_;
    const double d = x - mean_;
    mean_ += d / double(n_);
    squares_ += d * (x - mean_);
  }
  double mean() const { return mean_; }
  double error() const { return std::sqrt(squares_ / double(n_) / double(n_ - 1)); }

 private:
  std::size_t n_ = 0;
  double mean_ = 0, squares_ = 0;
};

}  // namespace tyndall::test
