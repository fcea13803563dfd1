#include "render/lamp_aim.h"

#include <cmath>

#include "math/frame.h"

namespace tyndall {
namespace {

/// Half angle of the cone. In smoke of depth 5 and 10 among a thousand lamps, relMSE without the worst 0.1 % is within 2.5 % for
/// 0.2 and 0.35; at depth 5, 0.1 has a third more MSE.
constexpr float kWidest = 0.25f;
const float kLeastCosine = std::cos(kWidest);

}  // namespace

std::optional<LampAim> aim_near(Vec3 p, Vec3 lamp, Vec2 around, float along) {
  const Vec3 to_lamp = lamp - p;
  const float distance = length(to_lamp);
  if (!(distance > 0)) return std::nullopt;
  const float theta = kWidest * around.x, phi = 2 * kPi * around.y;
  const float sine = std::sin(theta), cosine = std::cos(theta);
  const Frame frame = Frame::around(to_lamp * (1 / distance));
  const Vec3 w = frame.to_world({sine * std::cos(phi), sine * std::sin(phi), cosine});
  // Equi-angular from the ray's origin to infinity [Kulla and Fajardo 2012].
  const float passing = distance * sine, closest = distance * cosine;
  const float angles = kPi - theta;  // of the ray, seen from the lamp
  const float t = closest + passing * std::tan(along * angles - (kPi / 2 - theta));
  const float pdf = aim_pdf(p, lamp, w);  // as MIS asks for it: 0 where w is rounded out of the cone
  if (!(t > 0 && t < kInfinity && sine > 0 && pdf > 0)) return std::nullopt;
  return LampAim{w, t, pdf, 2 * kPi * kWidest * angles / distance};
}

float aim_pdf(Vec3 p, Vec3 lamp, Vec3 w) {
  const Vec3 to_lamp = lamp - p;
  const float distance = length(to_lamp);
  if (!(dot(w, to_lamp) > kLeastCosine * distance)) return 0;
  return distance / (2 * kPi * kWidest * length(cross(w, to_lamp)));
}

}  // namespace tyndall
