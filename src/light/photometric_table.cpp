#include <algorithm>
#include <cmath>
#include <numbers>

#include "light/intensity_profile.h"

namespace tyndall {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
/// Candela of a watt per steradian, as the SI defines it.
constexpr double kLuminousEfficacy = 683;

double to_radians(double degrees) { return degrees * (std::numbers::pi / 180); }

Vec3d web_direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), -std::cos(theta), std::sin(theta) * std::sin(phi)};
}

/// The angles at which a row stands around the whole circle, by the symmetry that the range of angles says [LM-63].
std::vector<double> mirrored(double phi, double first, double last) {
  if (first == last) return {0};
  if (first == 90) return {phi, 540 - phi, 180 - phi};  // 90 to 270
  if (last == 90) return {phi, 180 - phi, 180 + phi, 360 - phi};
  if (last == 180) return {phi, 360 - phi};
  return {phi};
}

}  // namespace

PhotometricTable::PhotometricTable(const PhotometricWeb& web) {
  for (const float degrees : web.vertical_degrees) theta_.push_back(to_radians(degrees));
  for (const float candela : web.candela) intensity_.push_back(static_cast<float>(candela / kLuminousEfficacy));
  const std::vector<float>& horizontal = web.horizontal_degrees;
  for (std::size_t row = 0; row < horizontal.size(); ++row)
    for (const double degrees : mirrored(horizontal[row], horizontal.front(), horizontal.back()))
      if (degrees >= 0 && degrees < 360) planes_.push_back({to_radians(degrees), row});
  std::stable_sort(planes_.begin(), planes_.end(), [](const Plane& a, const Plane& b) { return a.phi < b.phi; });
  const auto same = [](const Plane& a, const Plane& b) { return a.phi == b.phi; };
  planes_.erase(std::unique(planes_.begin(), planes_.end(), same), planes_.end());
  const Plane first = planes_.front(), last = planes_.back();
  planes_.insert(planes_.begin(), {last.phi - kTurn, last.row});
  planes_.push_back({first.phi + kTurn, first.row});
}

double PhotometricTable::on_plane(std::size_t row, double theta) const {
  const auto above = std::upper_bound(theta_.begin() + 1, theta_.end() - 1, theta);
  const auto i = static_cast<std::size_t>(above - theta_.begin()) - 1;
  const float* values = &intensity_[row * theta_.size()];
  const double t = (theta - theta_[i]) / (theta_[i + 1] - theta_[i]);
  return values[i] + t * (static_cast<double>(values[i + 1]) - values[i]);
}

double PhotometricTable::between(const Plane& a, const Plane& b, double theta, double phi) const {
  if (a.row == b.row) return on_plane(a.row, theta);
  const double t = (phi - a.phi) / (b.phi - a.phi), low = on_plane(a.row, theta);
  return low + t * (on_plane(b.row, theta) - low);
}

Rgb PhotometricTable::at(Vec3 w) const {
  const double theta = std::atan2(std::hypot(double(w.x), double(w.z)), -double(w.y));
  if (!(theta >= theta_.front() && theta <= theta_.back())) return {};
  const double angle = std::atan2(double(w.z), double(w.x)), phi = angle < 0 ? angle + kTurn : angle;
  const auto after = std::upper_bound(planes_.begin() + 1, planes_.end() - 1, phi,
                                      [](double value, const Plane& plane) { return value < plane.phi; });
  return Rgb(static_cast<float>(std::max(between(*(after - 1), *after, theta, phi), 0.0)));
}

/// int I sin(theta) d theta with I linear between angles a and b: I_a cos a - I_b cos b + slope (sin b - sin a).
double PhotometricTable::plane_flux(std::size_t row) const {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < theta_.size(); ++i) {
    const double a = theta_[i], b = theta_[i + 1];
    const double Ia = intensity_[row * theta_.size() + i], Ib = intensity_[row * theta_.size() + i + 1];
    sum += Ia * std::cos(a) - Ib * std::cos(b) + (Ib - Ia) / (b - a) * (std::sin(b) - std::sin(a));
  }
  return sum;
}

/// Around the circle once, from the second plane on: the first and the last are a turn apart from others.
Rgb PhotometricTable::flux() const {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < planes_.size(); ++k) {
    const Plane &a = planes_[k], &b = planes_[k + 1];
    sum += (b.phi - a.phi) * 0.5 * (plane_flux(a.row) + plane_flux(b.row));
  }
  return Rgb(static_cast<float>(sum));
}

void PhotometricTable::visit(const PartVisitor& visitor) const {
  const double step = to_radians(3);
  const auto pieces = [step](double range) { return std::max(1, static_cast<int>(std::ceil(range / step))); };
  for (std::size_t k = 1; k + 1 < planes_.size(); ++k) {
    const Plane &a = planes_[k], &b = planes_[k + 1];
    const int across = pieces(b.phi - a.phi);
    const double width = (b.phi - a.phi) / across;
    for (std::size_t i = 0; i + 1 < theta_.size(); ++i) {
      const int down = pieces(theta_[i + 1] - theta_[i]);
      const double height = (theta_[i + 1] - theta_[i]) / down;
      for (int n = 0; n < across * down; ++n) {
        const double phi = a.phi + (n % across) * width, theta = theta_[i] + (n / across) * height;
        const auto value = [&](double s, double t) { return between(a, b, theta + t * height, phi + s * width); };
        const bool lit = value(0, 0) > 0 || value(1, 0) > 0 || value(0, 1) > 0 || value(1, 1) > 0;
        visitor({to_vec3(web_direction(theta + 0.5 * height, phi + 0.5 * width)), static_cast<float>(0.5 * (width + height)),
                 (std::cos(theta) - std::cos(theta + height)) * width, static_cast<float>(value(0.5, 0.5)), lit});
      }
    }
  }
}

}  // namespace tyndall
