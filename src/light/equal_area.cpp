#include "light/equal_area.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {

// In one quadrant of the square let r in [0, 1] be the distance from the centre in the 1-norm. Hemispheres need the
// share r^2 of the square within r to equal the share 1 - z of the hemisphere; past the diagonal the lower one follows.
Vec3 equal_area_square_to_sphere(Vec2 p) {
  const float u = 2 * p.x - 1, v = 2 * p.y - 1;
  const float a = std::abs(u), b = std::abs(v);
  const float above = 1 - (a + b);  // negative in the lower hemisphere
  const float r = 1 - std::abs(above);
  const float phi = (r > 0 ? (b - a) / r + 1 : 1) * (kPi / 4);
  const float sine = r * std::sqrt(std::max(0.0f, 2 - r * r));
  return normalize(
      {std::copysign(std::cos(phi) * sine, u), std::copysign(std::sin(phi) * sine, v), std::copysign(1 - r * r, above)});
}

Vec2 equal_area_wrapped(Vec2 p) {
  const auto in_period = [](float x) { return x - 2 * std::floor(x / 2); };  // across two edges: as before
  p = {in_period(p.x), p.y};
  if (p.x > 1) p = {2 - p.x, 1 - p.y};
  p.y = in_period(p.y);
  if (p.y > 1) p = {1 - p.x, 2 - p.y};
  return p;
}

std::array<int, 2> equal_area_neighbor(int x, int y, int n) {
  const auto outside = [n](int i) { return i < 0 || i >= n; };
  const auto mirrored = [n](int i) { return i < 0 ? -1 - i : i >= n ? 2 * n - 1 - i : i; };
  const bool across_x = outside(x), across_y = outside(y);
  if (across_x) x = mirrored(x), y = n - 1 - y;
  if (across_y) x = n - 1 - x, y = mirrored(y);
  return {x, y};
}

Vec2 equal_area_sphere_to_square(Vec3 w) {
  const float x = std::abs(w.x), y = std::abs(w.y), z = std::abs(w.z);
  // 1 - z from the other components where z has run out of digits.
  const float r = std::sqrt(z > 0.9f ? (x * x + y * y) / (1 + z) : std::max(0.0f, 1 - z));
  const float phi = x + y > 0 ? std::atan2(y, x) * (2 / kPi) : 0;  // [0, 1] in the first quadrant
  float v = phi * r, u = r - v;
  if (w.z < 0) {
    std::swap(u, v);
    u = 1 - u;
    v = 1 - v;
  }
  return {0.5f * (std::copysign(u, w.x) + 1), 0.5f * (std::copysign(v, w.y) + 1)};
}

}  // namespace tyndall
