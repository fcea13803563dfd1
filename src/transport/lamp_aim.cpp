#include "transport/lamp_aim.h"

#include <algorithm>
#include <cmath>

#include "math/frame.h"

namespace tyndall {
namespace {

/// Half angle of the cone. In smoke of depth 5 and 10 among a thousand lamps, relMSE without the worst 0.1 % is within 2.5 %
/// for 0.2 and 0.35; at depth 5, 0.1 has a third more MSE.
constexpr float kWidest = 0.25f;
const float kLeastCosine = std::cos(kWidest);

/// Over all angles the mean squared weight of Henyey and Greenstein's is 1.02 (g = 0.4) to 1.09 (0.95) times the least there
/// is; with 1 it is 1.07 to 1.23, with 1.5 1.01 to 2.1.
constexpr float kSharpen = 1.2f;
constexpr float kSharpest = 0.98f;

float lobe_stretch(float g) {
  g = std::clamp(g, -kSharpest, kSharpest);
  return std::pow((1 + g) / (1 - g), kSharpen);
}

}  // namespace

// Henyey and Greenstein's (1 + g^2 - 2 g cos theta)^-1.5 has no inverse over theta. With exponent -1 and a g of its own, which
// `stretch` stands for, it is within 1.5 of it up to |g| = 0.95 and is drawn by tan(theta / 2).
PassingPlace pass_lamp(float closest, float passing, float g, float u) {
  const float stretch = lobe_stretch(g);
  const float slope = closest / passing, root = std::sqrt(1 + slope * slope);
  const float begin = slope > 0 ? 1 / (slope + root) : root - slope;  // tan(theta / 2) at the ray's origin
  const float first = std::atan(stretch * begin), range = kPi / 2 - first;
  const float half = std::tan(first + u * range) / stretch, inverse = 1 / half;
  const float cosine2 = 1 / (1 + half * half), sine2 = 1 / (1 + inverse * inverse);  // of theta / 2
  const float range_by_density = 2 * range * (cosine2 / stretch + stretch * sine2);
  return {closest + passing * (half - inverse) / 2, range_by_density / passing};
}

std::optional<LampAim> aim_near(Vec3 p, Vec3 lamp, float g, Vec2 around, float along) {
  const Vec3 to_lamp = lamp - p;
  const float distance = length(to_lamp);
  if (!(distance > 0)) return std::nullopt;
  const float theta = kWidest * around.x, phi = 2 * kPi * around.y;
  const float sine = std::sin(theta), cosine = std::cos(theta);
  const Frame frame = Frame::around(to_lamp * (1 / distance));
  const Vec3 w = frame.to_world({sine * std::cos(phi), sine * std::sin(phi), cosine});
  const PassingPlace place = pass_lamp(distance * cosine, distance * sine, g, along);
  const float pdf = aim_pdf(p, lamp, w);  // as MIS asks for it: 0 where w is rounded out of the cone
  if (!(place.t > 0 && place.t < kInfinity && sine > 0 && pdf > 0)) return std::nullopt;
  return LampAim{w, place.t, pdf, 2 * kPi * kWidest * sine * place.spread};
}

float aim_pdf(Vec3 p, Vec3 lamp, Vec3 w) {
  const Vec3 to_lamp = lamp - p;
  const float distance = length(to_lamp);
  if (!(dot(w, to_lamp) > kLeastCosine * distance)) return 0;
  return distance / (2 * kPi * kWidest * length(cross(w, to_lamp)));
}

}  // namespace tyndall
