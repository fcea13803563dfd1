#include <algorithm>
#include <cmath>

#include "light/intensity_profile.h"
#include "math/vec3d.h"

namespace tyndall {
namespace {

/// Solid angle of the rectangle from the axis to (x, y) on the plane z = 1.
double corner_solid_angle(double x, double y) { return std::atan(x * y / std::sqrt(1 + x * x + y * y)); }

}  // namespace

ProjectedImage::ProjectedImage(TexelImage image, float fov_degrees) : image_(std::move(image)) {
  const double shorter = std::tan(0.5 * fov_degrees * kPi / 180);
  const double aspect = static_cast<double>(image_.width()) / image_.height();
  half_x_ = shorter * std::max(aspect, 1.0);
  half_y_ = shorter * std::max(1 / aspect, 1.0);
}

Rgb ProjectedImage::at(Vec3 w) const {
  if (!(w.z > 0)) return {};
  const double s = 0.5 + 0.5 * w.x / (w.z * half_x_), t = 0.5 - 0.5 * w.y / (w.z * half_y_);
  if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1)) return {};
  return image_.texel(std::min(static_cast<int>(s * image_.width()), image_.width() - 1),
                      std::min(static_cast<int>(t * image_.height()), image_.height() - 1));
}

Vec3d ProjectedImage::direction(double s, double t) const { return {(2 * s - 1) * half_x_, (1 - 2 * t) * half_y_, 1}; }

double ProjectedImage::solid_angle(double s0, double s1, double t0, double t1) const {
  const Vec3d a = direction(s0, t1), b = direction(s1, t0);
  return corner_solid_angle(b.x, b.y) - corner_solid_angle(a.x, b.y) - corner_solid_angle(b.x, a.y) +
         corner_solid_angle(a.x, a.y);
}

Rgb ProjectedImage::flux() const {
  double sum[3] = {};
  const int w = image_.width(), h = image_.height();
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const double omega = solid_angle(double(x) / w, (x + 1.0) / w, double(y) / h, (y + 1.0) / h);
      for (int c = 0; c < 3; ++c) sum[c] += image_.texel(x, y)[c] * omega;
    }
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

void ProjectedImage::visit(const PartVisitor& visitor) const {
  constexpr int kFine = 64;  // pieces along the shorter side, at least
  const int shorter = std::min(image_.width(), image_.height()), pieces = (kFine + shorter - 1) / shorter;
  const int w = image_.width() * pieces, h = image_.height() * pieces;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const double s0 = double(x) / w, s1 = (x + 1.0) / w, t0 = double(y) / h, t1 = (y + 1.0) / h;
      const Vec3 center = to_vec3(normalize(direction((s0 + s1) / 2, (t0 + t1) / 2)));
      double reach = 0;
      for (const auto& [s, t] : {std::pair{s0, t0}, std::pair{s1, t0}, std::pair{s0, t1}, std::pair{s1, t1}})
        reach = std::max(reach, angle_between(center, to_vec3(normalize(direction(s, t)))));
      const auto value = static_cast<float>(strength(image_.texel(x / pieces, y / pieces)));
      visitor({center, static_cast<float>(reach), solid_angle(s0, s1, t0, t1), value, value > 0});
    }
}

}  // namespace tyndall
