#include "transport/techniques/point_aim.h"

#include <algorithm>
#include <cmath>

#include "math/frame.h"

namespace tyndall {
namespace {

/// Half angle of the cone (docs/measurements.md).
constexpr float kWidest = 0.25f;
const float kLeastCosine = std::cos(kWidest);

/// By this exponent the mean squared weight stays close to the least there is for all g (docs/measurements.md).
constexpr float kSharpen = 1.2f;
constexpr float kSharpest = 0.98f;

float lobe_elongation(float g) {
  g = std::clamp(g, -kSharpest, kSharpest);
  return std::pow((1 + g) / (1 - g), kSharpen);
}

}  // namespace

// Henyey and Greenstein's (1 + g^2 - 2 g cos theta)^-1.5 has no inverse over theta. With exponent -1 and a g of its own, which
// `elongation` stands for, it is within 1.5 of it up to |g| = 0.95 and is drawn by tan(theta / 2).
PassingPlace pass_point(float closest, float passing, float g, float u) {
  const float elongation = lobe_elongation(g);
  const float slope = closest / passing, root = std::sqrt(1 + slope * slope);
  const float begin = slope > 0 ? 1 / (slope + root) : root - slope;  // tan(theta / 2) at the ray's origin
  const float first = std::atan(elongation * begin), range = kPi / 2 - first;
  const float half = std::tan(first + u * range) / elongation, inverse = 1 / half;
  const float cosine2 = 1 / (1 + half * half), sine2 = 1 / (1 + inverse * inverse);  // of theta / 2
  const float range_by_density = 2 * range * (cosine2 / elongation + elongation * sine2);
  return {closest + passing * (half - inverse) / 2, range_by_density / passing};
}

std::optional<PointAim> aim_near(Vec3 p, Vec3 point, float g, Vec2 around, float along) {
  const Vec3 to_point = point - p;
  const float distance = length(to_point);
  if (!(distance > 0)) return std::nullopt;
  const float theta = kWidest * around.x, phi = 2 * kPi * around.y;
  const float sine = std::sin(theta), cosine = std::cos(theta);
  const Frame frame = Frame::around(to_point * (1 / distance));
  const Vec3 w = frame.to_world({sine * std::cos(phi), sine * std::sin(phi), cosine});
  const PassingPlace place = pass_point(distance * cosine, distance * sine, g, along);
  const float pdf = aim_pdf(p, point, w);  // as MIS asks for it: 0 where w is rounded out of the cone
  if (!(place.t > 0 && place.t < kInfinity && sine > 0 && pdf > 0)) return std::nullopt;
  return PointAim{w, place.t, pdf, 2 * kPi * kWidest * sine * place.spread};
}

float aim_pdf(Vec3 p, Vec3 point, Vec3 w) {
  const Vec3 to_point = point - p;
  const float distance = length(to_point);
  if (!(dot(w, to_point) > kLeastCosine * distance)) return 0;
  return distance / (2 * kPi * kWidest * length(cross(w, to_point)));
}

}  // namespace tyndall
