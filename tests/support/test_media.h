/// Media for tests of tracking, and numbers that need no tracking.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "math/rng.h"
#include "tyndall/scene.h"
#include "volume/tracking.h"

namespace tyndall::test {

struct Optics {
  Rgb sigma_a, sigma_s;
  float g = 0;
};

inline ParticipatingMedium built(Medium medium, const Optics& optics) {
  medium.optics = {optics.sigma_a, optics.sigma_s, HenyeyGreenstein{optics.g}};
  medium.name = "test";
  std::vector<std::string> notes;
  return build_medium(medium, {}, notes);
}

inline ParticipatingMedium homogeneous(const Optics& optics, Rgb Le = {}) {
  Medium medium;
  medium.kind = HomogeneousMedium{Le};
  return built(medium, optics);
}

/// Clouds with clear air between them, high above the dense lower half that pbrt's formula makes.
inline ParticipatingMedium cloud(const Optics& optics) {
  CloudMedium cloud;
  cloud.bounds = {{-2, 0.55f, -2}, {2, 0.95f, 2}};
  cloud.frequency = 3;
  Medium medium;
  medium.kind = cloud;
  return built(medium, optics);
}

/// n^3 cells over [lo, hi]^3.
struct Cells {
  int n;
  float lo, hi;
};
/// With density draw(i) in cell i.
template <typename Draw>
ParticipatingMedium grid(const Cells& cells, const Optics& optics, const Draw& draw, Rgb Le = {},
                         const Transform& to_world = {}) {
  UniformGridMedium uniform;
  uniform.bounds = {{cells.lo, cells.lo, cells.lo}, {cells.hi, cells.hi, cells.hi}};
  uniform.nx = uniform.ny = uniform.nz = cells.n;
  for (int i = 0; i < cells.n * cells.n * cells.n; ++i) uniform.density.push_back(draw(i));
  uniform.Le = Le;
  Medium medium;
  medium.kind = uniform;
  medium.to_world = to_world;
  return built(medium, optics);
}

/// Random blobs with empty parts between them.
inline ParticipatingMedium clumpy(const Optics& optics, std::uint64_t seed, Rgb Le = {}, const Transform& to_world = {}) {
  constexpr int kSide = 48;
  Rng rng(seed);
  const float a = rng.uniform() * 6, b = rng.uniform() * 6;
  return grid(
      {kSide, -1, 1}, optics,
      [&](int i) {
        const float x = static_cast<float>(i % kSide), y = static_cast<float>(i / kSide % kSide),
                    z = static_cast<float>(i / (kSide * kSide));
        const float v = std::sin(0.31f * x + a) * std::cos(0.23f * y + b) + std::sin(0.17f * (z + x)) - 0.3f;
        return v > 0 ? v * (0.5f + rng.uniform()) : 0.0f;
      },
      Le, to_world);
}

/// Integrals along a ray by the midpoint rule on `steps` points, per channel, in double precision.
struct LineIntegrals {
  double depth[3] = {}, emitted[3] = {};
  double transmittance(int c) const { return std::exp(-depth[c]); }
};
inline LineIntegrals integrate_line(MediaView media, const Ray& ray, float t0, float t1, int steps = 20000) {
  LineIntegrals sum;
  const double dt = (double{t1} - t0) / steps;
  for (int i = 0; i < steps; ++i) {
    const Vec3 p = ray.at(static_cast<float>(t0 + (i + 0.5) * dt));
    for (const ParticipatingMedium* medium : media) {
      const Coefficients k = medium->at(p);
      for (int c = 0; c < 3; ++c) {
        sum.emitted[c] += std::exp(-sum.depth[c]) * k.sigma_a[c] * k.Le[c] * dt;
        sum.depth[c] += (double{k.sigma_a[c]} + k.sigma_s[c]) * dt;
      }
    }
  }
  return sum;
}

/// Mean and standard error of a sample.
class Moments {
 public:
  void add(double x) {
    ++n_;
    const double d = x - mean_;
    mean_ += d / n_;
    m2_ += d * (x - mean_);
  }
  double mean() const { return mean_; }
  double standard_error() const { return std::sqrt(m2_ / (n_ - 1.0) / n_); }
  /// Standard errors between the mean and `expected`; `slack` is forgiven. For values in [0,1] that are mostly 0 the
  /// sample's own error means nothing where few are expected; the binomial one stands in.
  double deviation(double expected, double slack = 0) const {
    const double off = std::max(0.0, std::abs(mean_ - expected) - slack);
    const double rare = n_ * std::abs(expected) < 30 ? std::sqrt(std::abs(expected) / n_) : 0;
    return off == 0 ? 0 : off / std::max(standard_error(), rare);
  }

 private:
  double n_ = 0, mean_ = 0, m2_ = 0;
};

}  // namespace tyndall::test
