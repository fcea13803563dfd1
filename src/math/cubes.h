/// A box cut into cubes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "tyndall/math.h"

namespace tyndall {

/// Cubes that tile a box, or nearly cubes; few along an axis rather than thin ones.
class Cubes {
 public:
  static constexpr float kMost = 64;  ///< along an axis

  /// About as many as `wanted`, at least one; the box must not be empty.
  Cubes(const Bounds3& box, float wanted) : box_(box) {
    const Vec3 e = box.extent();
    const float longest = std::max({e.x, e.y, e.z});
    // Flat boxes are cut as if they had some thickness.
    const float volume = std::max(e.x, 1e-3f * longest) * std::max(e.y, 1e-3f * longest) * std::max(e.z, 1e-3f * longest);
    const float edge = std::cbrt(volume / wanted);  // not a number where the box is too large for one: then it is one cube
    for (std::size_t i = 0; i < 3; ++i) {
      const float length = e[static_cast<int>(i)];
      counts_[i] = edge > 0 && length / edge < kInfinity ? static_cast<std::size_t>(std::clamp(length / edge, 1.0f, kMost)) : 1;
      step_[static_cast<int>(i)] = length / static_cast<float>(counts_[i]);
    }
  }

  std::size_t size() const { return counts_[0] * counts_[1] * counts_[2]; }
  std::size_t count(int axis) const { return counts_[static_cast<std::size_t>(axis)]; }
  Vec3 step() const { return step_; }
  Vec3 corner(std::size_t index) const {
    const std::size_t x = index % counts_[0], y = index / counts_[0] % counts_[1], z = index / (counts_[0] * counts_[1]);
    return box_.min + Vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} * step_;
  }
  /// Of the cube that holds `p`, or is next to it.
  std::size_t index(Vec3 p) const {
    const Vec3 from = p - box_.min;
    std::size_t index = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const std::size_t count = counts_[static_cast<std::size_t>(axis)];
      const float cells = from[axis] / step_[axis], at = cells > 0 ? std::min(cells, kMost) : 0.0f;
      index = index * count + std::min(static_cast<std::size_t>(at), count - 1);
    }
    return index;
  }

 private:
  Bounds3 box_;
  std::array<std::size_t, 3> counts_{};
  Vec3 step_;
};

}  // namespace tyndall
