#include <algorithm>
#include <cmath>

#include "light/equal_area.h"
#include "light/intensity_profile.h"

namespace tyndall {
namespace {

Vec3 swapped(Vec3 w) { return {w.x, w.z, w.y}; }

}  // namespace

GoniometricMap::GoniometricMap(const TexelImage& image) : size_(image.width()) {
  double sum = 0;
  for (int y = 0; y < size_; ++y)
    for (int x = 0; x < size_; ++x) {
      texels_.push_back(std::max(tyndall::mean(image.texel(x, y)), 0.0f));
      sum += texels_.back();
    }
  mean_ = static_cast<float>(sum / static_cast<double>(texels_.size()));
}

Rgb GoniometricMap::at(Vec3 w) const {
  const Vec2 st = equal_area_sphere_to_square(swapped(w));
  const auto cell = [this](float s) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(s * static_cast<float>(size_)), 0, size_ - 1));
  };
  return Rgb(texels_[cell(st.y) * static_cast<std::size_t>(size_) + cell(st.x)]);
}

void GoniometricMap::visit(const PartVisitor& visitor) const {
  constexpr int kFine = 64;  // pieces along a side, at least
  const int pieces = (kFine + size_ - 1) / size_, n = size_ * pieces;
  const double omega = 4.0 * kPi / (static_cast<double>(n) * n);
  // A piece is as large as a square of that solid angle, and at most twice as long.
  const auto reach = static_cast<float>(2 * std::sqrt(omega));
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const float value = texels_[static_cast<std::size_t>(y / pieces) * static_cast<std::size_t>(size_) +
                                  static_cast<std::size_t>(x / pieces)];
      const Vec2 st{(static_cast<float>(x) + 0.5f) / static_cast<float>(n),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(n)};
      visitor({swapped(equal_area_square_to_sphere(st)), reach, omega, value, value > 0});
    }
}

}  // namespace tyndall
