#include "report/error_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "report/metrics.h"
#include "tyndall/math.h"
#include "tyndall/relative_error.h"

namespace tyndall {
namespace {

constexpr double kLog10Lowest = -4, kLog10Highest = 1;
constexpr Rgb kNotFinite{0, 1, 0};

/// As displayed (sRGB), evenly spaced; lightness rises all the way, so that it reads in grey too.
constexpr std::array<Rgb, 5> kColors{Rgb{0, 0, 0}, Rgb{0.33f, 0.08f, 0.50f}, Rgb{0.78f, 0.18f, 0.30f}, Rgb{0.98f, 0.58f, 0.10f},
                                     Rgb{1.0f, 0.98f, 0.75f}};

float to_linear(float srgb) { return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f); }

Rgb color_of(double relative_square) {
  if (!std::isfinite(relative_square)) return kNotFinite;
  if (relative_square <= 0) return kColors.front();
  const double t = (std::log10(relative_square) - kLog10Lowest) / (kLog10Highest - kLog10Lowest);
  const auto place = static_cast<float>(std::clamp(t, 0.0, 1.0) * (kColors.size() - 1));
  const std::size_t below = std::min(static_cast<std::size_t>(place), kColors.size() - 2);
  const float part = place - static_cast<float>(below);
  const Rgb shown = kColors[below] * (1 - part) + kColors[below + 1] * part;
  return {to_linear(shown.r), to_linear(shown.g), to_linear(shown.b)};
}

}  // namespace

Image error_picture(const Image& image, const Image& reference) { return error_picture(image, reference, {"R", "G", "B"}); }

Image error_picture(const Image& image, const Image& reference, const std::vector<std::string>& channels) {
  require_same_size(image, reference);
  Image picture;
  picture.data = image.data;
  picture.display = image.display;
  for (const char* name : {"R", "G", "B"}) picture.add_channel(name);
  std::vector<double> error(picture.channels[0].values.size());
  for (const std::string& name : channels) {
    const auto &x = required_channel(image, name).values, &r = required_channel(reference, name).values;
    for (std::size_t i = 0; i < error.size(); ++i) {
      const double d = static_cast<double>(x[i]) - r[i];
      error[i] += d * d / (static_cast<double>(r[i]) * r[i] + kRelativeEpsilon) / static_cast<double>(channels.size());
    }
  }
  for (std::size_t i = 0; i < error.size(); ++i) {
    const Rgb c = color_of(error[i]);
    for (int k = 0; k < 3; ++k) picture.channels[static_cast<std::size_t>(k)].values[i] = c[k];
  }
  return picture;
}

}  // namespace tyndall
