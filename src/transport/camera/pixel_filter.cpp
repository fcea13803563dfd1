#include "transport/camera/pixel_filter.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr int kBins = 1024;

float gaussian(float x, float sigma) { return std::exp(-x * x / (2 * sigma * sigma)); }

/// Mitchell and Netravali's cubic on [-2, 2].
float mitchell(float x, float b, float c) {
  x = std::abs(x);
  if (x <= 1) {
    return ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + (6 - 2 * b)) / 6;
  }
  if (x <= 2) {
    return ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) / 6;
  }
  return 0;
}

float sinc(float x) {
  const float px = kPi * x;
  return std::abs(px) < 1e-3f ? 1 - px * px / 6 : std::sin(px) / px;
}

/// One factor of the separable filter; 0 outside the radius.
float filter_axis(const PixelFilter& f, float x, float radius) {
  if (std::abs(x) > radius) return 0;
  switch (f.kind) {
    case PixelFilter::Kind::box:
      return 1;
    case PixelFilter::Kind::triangle:
      return radius - std::abs(x);
    case PixelFilter::Kind::gaussian:
      return std::max(0.0f, gaussian(x, f.sigma) - gaussian(radius, f.sigma));
    case PixelFilter::Kind::mitchell:
      return mitchell(2 * x / radius, f.b, f.c);
    case PixelFilter::Kind::sinc:
      return sinc(x) * sinc(x / f.tau);
  }
  return 0;
}

}  // namespace

float filter_value(const PixelFilter& filter, Vec2 offset) {
  return filter_axis(filter, offset.x, filter.radius.x) * filter_axis(filter, offset.y, filter.radius.y);
}

FilterSampler::Axis::Axis(const PixelFilter& filter, int axis) : radius(axis == 0 ? filter.radius.x : filter.radius.y) {
  std::vector<float> magnitudes;
  double plain = 0;
  for (int i = 0; i < kBins; ++i) {
    const float f = filter_axis(filter, radius * (2 * (static_cast<float>(i) + 0.5f) / kBins - 1), radius);
    magnitudes.push_back(std::abs(f));
    weights.push_back(std::copysign(1.0f, f));
    plain += f;
  }
  if (!(radius > 0) || !(plain > 0)) {
    throw Error(Failure::scene, "the pixel filter has no positive integral; give it a larger radius");
  }
  distribution = PiecewiseConstant1D(magnitudes);
  even = std::all_of(magnitudes.begin(), magnitudes.end(), [&](float m) { return m == magnitudes.front(); });
  for (float& w : weights) w *= static_cast<float>(distribution.total() / plain);
}

FilterSampler::Axis::Place FilterSampler::Axis::sample(float u) const {
  const auto s = distribution.sample(u);
  return {radius * (2 * s.x - 1), weights[s.cell], s.pdf / (2 * radius)};
}

FilterSampler::Axis::Place FilterSampler::Axis::at(float x) const {
  const float unit = 0.5f * (x / radius + 1);
  if (!(unit >= 0 && unit < 1)) return {x, 0, 0};
  return {x, weights[static_cast<std::size_t>(unit * kBins)], distribution.pdf(unit) / (2 * radius)};
}

FilterSampler::FilterSampler(const PixelFilter& filter) : x_(filter, 0), y_(filter, 1) {}

FilterSampler::Offset FilterSampler::sample(Vec2 u) const { return both(x_.sample(u.x), y_.sample(u.y)); }

FilterSampler::Offset FilterSampler::at(Vec2 p) const { return both(x_.at(p.x), y_.at(p.y)); }

FilterSampler::Offset FilterSampler::both(Axis::Place x, Axis::Place y) {
  return {{x.x, y.x}, x.weight * y.weight, x.pdf * y.pdf};
}

}  // namespace tyndall
