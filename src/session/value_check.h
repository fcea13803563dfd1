/// Refusing values that a Scene cannot be rendered with, under one wording.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "tyndall/error.h"
#include "tyndall/math.h"

namespace tyndall {

/// Values of one thing in a scene. Every function throws Error (scene) for a value that is not finite, or not as it says.
class ValueCheck {
 public:
  /// `owner`: begins the message, as "the camera".
  ValueCheck(Location where, std::string owner) : where_(std::move(where)), owner_(std::move(owner)) {}

  [[noreturn]] void refuse(const std::string& what) const { throw Error(where_, owner_ + " " + what); }
  void require(bool good, const std::string& what) const {
    if (!good) refuse(what);
  }

  /// `good`: besides being finite; `wanted`: what to give instead.
  void number(const char* name, float value, bool good, const char* wanted) const {
    if (!std::isfinite(value) || !good) refuse_value(name, shown(value), wanted);
  }
  void finite(const char* name, float value) const { number(name, value, true, "a finite number"); }
  void positive(const char* name, float value) const { number(name, value, value > 0, "a finite number above 0"); }
  void not_negative(const char* name, float value) const { number(name, value, value >= 0, "a finite number of 0 or more"); }

  void vector(const char* name, Vec3 v) const {
    if (!is_finite(v)) refuse_value(name, shown(v.x) + " " + shown(v.y) + " " + shown(v.z), "three finite numbers");
  }
  void direction(const char* name, Vec3 v) const {
    const float size = length(v);  // 0 and infinite where a float cannot hold its square
    if (!(size > 0 && std::isfinite(size)))
      refuse_value(name, shown(v.x) + " " + shown(v.y) + " " + shown(v.z), "a finite vector that has a length");
  }
  void color(const char* name, Rgb c) const {
    if (!is_finite(c) || min_component(c) < 0) refuse_value(name, shown(c), "finite numbers of 0 or more");
  }
  /// Emission of a colour that lies outside Rec.709 has negative channels, but never those alone.
  void emission(const char* name, Rgb c) const {
    const bool negative = max_component(c) <= 0 && min_component(c) < 0;
    if (!is_finite(c) || negative) refuse_value(name, shown(c), "finite numbers that are not all negative");
  }
  template <typename Numbers>
  void all_finite(const char* name, const Numbers& numbers) const {
    if (!std::all_of(numbers.begin(), numbers.end(), [](float v) { return std::isfinite(v); }))
      refuse(std::string("has ") + name + " with a number that is not finite; correct it");
  }

 private:
  static float min_component(Rgb c) { return std::min({c.r, c.g, c.b}); }
  static std::string shown(float v) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", double{v});
    return text;
  }
  static std::string shown(Rgb c) { return shown(c.r) + " " + shown(c.g) + " " + shown(c.b); }
  [[noreturn]] void refuse_value(const char* name, const std::string& value, const char* wanted) const {
    refuse(std::string("has ") + name + " " + value + "; give " + wanted);
  }

  Location where_;
  std::string owner_;
};

}  // namespace tyndall
