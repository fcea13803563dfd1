#include "transport/camera/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tyndall {
namespace {

constexpr int kBins = 1024;
/// Of the samples, where a filter is negative. Mitchell's and sinc's own shares are 0.06 and 0.2: this one adds 4 % to the
/// variance, and is met exactly by any eight stratified samples.
constexpr float kNegative = 1.0f / 8;

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
  std::vector<float> values, magnitudes;
  for (int i = 0; i < kBins; ++i) {
    values.push_back(filter_axis(filter, radius * (2 * (static_cast<float>(i) + 0.5f) / kBins - 1), radius));
    magnitudes.push_back(std::abs(values.back()));
  }
  magnitude = PiecewiseConstant1D(magnitudes);
  even = std::all_of(magnitudes.begin(), magnitudes.end(), [&](float m) { return m == magnitudes.front(); });
  if (std::any_of(values.begin(), values.end(), [](float v) { return v < 0; })) {
    lobes[0] = PiecewiseConstant1D(values);  // what is negative counts as 0
    for (float& v : values) v = -v;
    lobes[1] = PiecewiseConstant1D(values);
  }
  if (!(radius > 0) || !(mass(false) > mass(true))) {
    throw Error(Failure::scene, "the pixel filter has no positive integral; give it a larger radius");
  }
}

double FilterSampler::Axis::mass(bool below) const {
  if (lobes[0].size() == 0) return below ? 0 : magnitude.total();
  return part(below).total();
}

FilterSampler::Axis::Place FilterSampler::Axis::sample(float u, bool below) const {
  const float unit = part(below).sample(u).x;
  return {radius * (2 * unit - 1), magnitude.pdf(unit) / (2 * radius), below};
}

FilterSampler::Axis::Place FilterSampler::Axis::at(float x) const {
  const float unit = 0.5f * (x / radius + 1);
  if (!(unit >= 0 && unit < 1)) return {x, 0, false};
  return {x, magnitude.pdf(unit) / (2 * radius), lobes[1].size() > 0 && lobes[1].pdf(unit) > 0};
}

FilterSampler::FilterSampler(const PixelFilter& filter) : x_(filter, 0), y_(filter, 1) {
  const bool any_below = x_.mass(true) + y_.mass(true) > 0;
  signs_ = {of_sign(false, any_below ? 1 - kNegative : 1), of_sign(true, any_below ? kNegative : 0)};
}

FilterSampler::Sign FilterSampler::of_sign(bool below, float share) const {
  const double first = x_.mass(false) * y_.mass(below), mass = first + x_.mass(true) * y_.mass(!below);
  if (!(mass > 0)) return {0, 0, 0, 0};
  const double integral = (x_.mass(false) - x_.mass(true)) * (y_.mass(false) - y_.mass(true));
  const double density = share * x_.magnitude.total() * y_.magnitude.total() / mass;
  const double weight = mass / (share * integral);
  return {share, static_cast<float>(first / mass), static_cast<float>(below ? -weight : weight), static_cast<float>(density)};
}

FilterSampler::Offset FilterSampler::sample(Vec2 u) const {
  const bool below = u.x < signs_[1].share;
  const Sign& sign = signs_[below ? 1 : 0];
  float left = std::min((below ? u.x : u.x - signs_[1].share) / sign.share, kOneMinusEpsilon);
  const bool second = left >= sign.first;
  left = second ? (left - sign.first) / (1 - sign.first) : left / sign.first;
  return offset(x_.sample(std::min(left, kOneMinusEpsilon), second), y_.sample(u.y, second != below));
}

FilterSampler::Offset FilterSampler::at(Vec2 p) const { return offset(x_.at(p.x), y_.at(p.y)); }

FilterSampler::Offset FilterSampler::offset(const Axis::Place& x, const Axis::Place& y) const {
  const Sign& sign = signs_[x.below != y.below ? 1 : 0];
  return {{x.x, y.x}, sign.weight, x.pdf * y.pdf * sign.density};
}

}  // namespace tyndall
