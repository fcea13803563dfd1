#include <array>
#include <cmath>
#include <span>

#include "transport/camera/lens_system.h"

namespace tyndall {
namespace {

struct Corner {
  double x, y;
};

bool is_inside(std::span<const Corner> polygon, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a.y > y) != (b.y > y) && x < a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

double area(std::span<const Corner> polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

/// One corner down: the picture is upside down, and there it points up.
const std::array<Corner, 5>& pentagon() {
  static const std::array<Corner, 5> kCorners = [] {
    std::array<Corner, 5> corners;
    for (int i = 0; i < 5; ++i) {
      const double angle = kPi * (0.4 * i - 0.5);
      corners[i] = {0.8 * std::cos(angle), 0.8 * std::sin(angle)};
    }
    return corners;
  }();
  return kCorners;
}

const std::array<Corner, 10>& star() {
  static const std::array<Corner, 10> kCorners = [] {
    std::array<Corner, 10> corners;
    const double inner = std::cos(kPi * 0.4) / std::cos(kPi * 0.2);
    for (int i = 0; i < 10; ++i) {
      const double r = i % 2 == 1 ? 1 : inner, angle = kPi * 0.2 * i;
      corners[i] = {r * std::cos(angle), r * std::sin(angle)};
    }
    return corners;
  }();
  return kCorners;
}

double of_polygon(std::span<const Corner> polygon, double x, double y) {
  return is_inside(polygon, x, y) ? kPi / area(polygon) : 0;
}

}  // namespace

double stop_transmission(Lenses::Stop stop, double x, double y) {
  const double r2 = x * x + y * y;
  switch (stop) {
    case Lenses::Stop::circle:
      return r2 <= 1 ? 1 : 0;
    case Lenses::Stop::gaussian:
      return r2 < 1 ? (std::exp(-r2) - std::exp(-1.0)) / (1 - 2 / std::exp(1.0)) : 0;
    case Lenses::Stop::square:
      return std::abs(x) < 0.5 && std::abs(y) < 0.5 ? kPi : 0;
    case Lenses::Stop::pentagon:
      return of_polygon(pentagon(), x, y);
    case Lenses::Stop::star:
      return of_polygon(star(), x, y);
  }
  return 0;
}

}  // namespace tyndall
