#include "transport/pixel/peaks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "transport/pixel/chosen_by_brightness.h"

namespace tyndall {
namespace {

/// Positions are drawn up to so many heights from the foot, three quarters of the light, or to so much of a pixel's shorter
/// step.
constexpr float kReach = 4, kPixelReach = 0.5f;
/// Pixels of a peak that is seen at a grazing angle. One that is long enough for more is left to their filters.
constexpr double kMostPixels = 256;

float cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// Of equals the first.
bool brighter(const Peak& a, const Peak& b) {
  if (a.brightness != b.brightness) return a.brightness > b.brightness;
  return a.light != b.light ? a.light < b.light : a.height < b.height;
}

/// Weight of a peak at an offset from the pixel, in units of what reaches into it. What reaches in from beyond has its share.
float toward_rim(float dx, float dy) { return std::exp(-2.25f * (dx * dx + dy * dy)); }

/// What of a film reaches into a pixel's filter or out of it.
Vec2 reach_into(const Peak& peak, Vec2 filter_radius) { return peak.reach() + filter_radius; }

/// The peak as the pixel has it: the less bright the farther off; dark where nothing of it is under the filter.
Peak in_pixel(Peak peak, int x, int y, Vec2 filter_radius) {
  const Vec2 most = reach_into(peak, filter_radius);
  const float dx = (peak.at.x - (static_cast<float>(x) + 0.5f)) / most.x;
  const float dy = (peak.at.y - (static_cast<float>(y) + 0.5f)) / most.y;
  peak.brightness *= std::abs(dx) < 1 && std::abs(dy) < 1 ? toward_rim(dx, dy) : 0.0f;
  return peak;
}

bool is_usable(const Peak& peak, Vec2 filter_radius) {
  const Vec2 most = reach_into(peak, filter_radius);
  return peak.brightness > 0 && peak.brightness < kInfinity && double{most.x} * most.y * 4 <= kMostPixels;
}

/// visit(x, y) for the pixels that may have the peak.
template <typename Visit>
void for_each_pixel(const Peak& peak, const PixelBounds& pixels, Vec2 filter_radius, const Visit& visit) {
  const Vec2 most = reach_into(peak, filter_radius);
  const auto within = [](float x, int begin, int end) {
    return static_cast<int>(std::floor(std::min(std::max(static_cast<float>(begin), x), static_cast<float>(end))));
  };
  const int x0 = within(peak.at.x - most.x, pixels.x0, pixels.x1), x1 = within(peak.at.x + most.x + 1, pixels.x0, pixels.x1);
  const int y0 = within(peak.at.y - most.y, pixels.y0, pixels.y1), y1 = within(peak.at.y + most.y + 1, pixels.y0, pixels.y1);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      if (in_pixel(peak, x, y, filter_radius).brightness > 0) visit(x, y);
    }
  }
}

}  // namespace

float Peak::radius() const {
  const float shorter = std::min(std::hypot(right.x, right.y), std::hypot(down.x, down.y));
  return std::max(kReach * height, kPixelReach * shorter);
}

/// The part of the light that comes within radius().
float Peak::share() const { return 1 - height / std::hypot(height, radius()); }

/// rho by the light within it, 1 - h / sqrt(h^2 + rho^2), uniform.
Vec2 Peak::draw(Vec2 u) const {
  const float most = share();
  const float left = 1 - most * u.x, phi = 2 * kPi * u.y;
  const float rho = height * std::sqrt(std::max(1 / (left * left) - 1, 0.0f));
  const Vec2 v{rho * std::cos(phi), rho * std::sin(phi)};
  const float area = cross(right, down);
  return {at.x + cross(v, down) / area, at.y + cross(right, v) / area};
}

float Peak::pdf(Vec2 x) const {
  const Vec2 v = right * (x.x - at.x) + down * (x.y - at.y);
  const float rho = std::hypot(v.x, v.y);
  if (!(rho <= radius())) return 0;
  const float s = 1 + rho * rho / (height * height);
  return std::abs(cross(right, down)) / (2 * kPi * share() * height * height * s * std::sqrt(s));
}

Vec2 Peak::reach() const {
  const float rho = radius() / std::abs(cross(right, down));
  return {rho * std::hypot(down.x, down.y), rho * std::hypot(right.x, right.y)};
}

PixelPeaks::PixelPeaks(List peaks) : peaks_(std::move(peaks)) { keep_brightest(peaks_, kMost, brighter); }

PixelPeaks::Draw PixelPeaks::draw(float which, Vec2 u) const {
  const Peak& chosen = chosen_by_brightness(peaks_, which);
  const Vec2 x = chosen.draw(u);
  return {chosen.light, x, pdf(chosen.light, x)};
}

float PixelPeaks::pdf(LightId light, Vec2 x) const {
  float sum = 0;
  for (const Peak& peak : peaks_) {
    if (peak.light == light) sum += peak.brightness * peak.pdf(x);
  }
  return sum;
}

FilmPeaks::FilmPeaks(const PixelBounds& pixels, Vec2 filter_radius, std::vector<Peak> peaks)
    : pixels_(pixels), filter_radius_(filter_radius), peaks_(std::move(peaks)) {
  std::erase_if(peaks_, [&](const Peak& peak) { return !is_usable(peak, filter_radius); });
  if (peaks_.empty()) return;
  std::vector<std::size_t> end(static_cast<std::size_t>(pixels.width()) * static_cast<std::size_t>(pixels.height()) + 1);
  for (const Peak& peak : peaks_)
    for_each_pixel(peak, pixels, filter_radius, [&](int x, int y) { ++end[pixels.index(x, y) + 1]; });
  for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
  begin_ = end;
  of_pixel_.resize(end.back());
  for (std::size_t i = 0; i < peaks_.size(); ++i) {
    for_each_pixel(peaks_[i], pixels, filter_radius,
                   [&](int x, int y) { of_pixel_[end[pixels.index(x, y)]++] = static_cast<std::uint32_t>(i); });
  }
}

PixelPeaks FilmPeaks::of(int x, int y) const {
  if (begin_.empty()) return {};
  const std::size_t pixel = pixels_.index(x, y);
  PixelPeaks::List seen;
  for (std::size_t i = begin_[pixel]; i < begin_[pixel + 1]; ++i)
    seen.push_back(in_pixel(peaks_[of_pixel_[i]], x, y, filter_radius_));
  return PixelPeaks(std::move(seen));
}

}  // namespace tyndall
