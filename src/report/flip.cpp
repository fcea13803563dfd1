#include "report/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "report/flip_color.h"
#include "report/flip_filter.h"
#include "report/metrics.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

using Opponent = std::array<Plane, 3>;  // Y, Cx, Cz
using Pixels = std::vector<Rgb>;

struct Size {
  int width, height;
};

// --- Colour [Andersson et al. 2020, sec. 4.1]

/// Contrast sensitivity as a sum of Gaussians a sqrt(pi/b) exp(-pi^2 x^2 / b), x in degrees [sec. 4.1.1, table 1].
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity kAchromatic{1, 0.0047}, kRedGreen{1, 0.0053}, kBlueYellow[2]{{34.1, 0.04}, {13.5, 0.025}};

double deviation_of(const Sensitivity& s, double pixels_per_degree) {
  return std::sqrt(s.b / 2) / std::numbers::pi * pixels_per_degree;
}
/// Of the widest of the filters: the others are as large.
int csf_radius(double pixels_per_degree) {
  return static_cast<int>(std::ceil(3 * deviation_of(kBlueYellow[0], pixels_per_degree)));
}

Plane blurred(const Plane& plane, const Sensitivity& s, double pixels_per_degree) {
  const Kernel kernel = normalized(gaussian(deviation_of(s, pixels_per_degree), csf_radius(pixels_per_degree)));
  return filtered(plane, kernel, kernel);
}

/// What one Gaussian adds to the sum of a filter's weights over the pixel grid.
double weight_of(const Sensitivity& s, double pixels_per_degree) {
  const Kernel kernel = gaussian(deviation_of(s, pixels_per_degree), csf_radius(pixels_per_degree));
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  return s.a * std::sqrt(std::numbers::pi / s.b) * sum * sum;
}

Plane blurred_blue_yellow(const Plane& plane, double pixels_per_degree) {
  Plane wide = blurred(plane, kBlueYellow[0], pixels_per_degree);
  const Plane narrow = blurred(plane, kBlueYellow[1], pixels_per_degree);
  const double w = weight_of(kBlueYellow[0], pixels_per_degree), n = weight_of(kBlueYellow[1], pixels_per_degree);
  const auto part = static_cast<float>(w / (w + n));
  for (std::size_t i = 0; i < wide.values.size(); ++i) wide.values[i] = std::lerp(narrow.values[i], wide.values[i], part);
  return wide;
}

/// What the eye makes of the picture, in Hunt-adjusted L*a*b*.
std::vector<Tristimulus> perceived(const Opponent& picture, double pixels_per_degree) {
  const Plane y = blurred(picture[0], kAchromatic, pixels_per_degree), cx = blurred(picture[1], kRedGreen, pixels_per_degree),
              cz = blurred_blue_yellow(picture[2], pixels_per_degree);
  std::vector<Tristimulus> lab;
  lab.reserve(y.values.size());
  for (std::size_t i = 0; i < y.values.size(); ++i) {
    const Rgb c = rgb_of_ycxcz({y.values[i], cx.values[i], cz.values[i]});
    lab.push_back(hunt_lab({std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)}));
  }
  return lab;
}

/// HyAB to the power of 0.7, mapped to [0, 1] such that the first 40 % of its range take 95 % [sec. 4.1.3].
float color_difference(Tristimulus a, Tristimulus b) {
  constexpr float kExponent = 0.7f, kKnee = 0.4f, kAtKnee = 0.95f;
  static const float largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kExponent);
  const float e = std::pow(hyab(a, b), kExponent), knee = kKnee * largest;
  return e < knee ? kAtKnee / knee * e : kAtKnee + (e - knee) / (largest - knee) * (1 - kAtKnee);
}

// --- Features [sec. 4.2]

/// Magnitudes of the response to `kernel` across and down; `smooth` runs along the feature.
Plane response(const Plane& luminance, const Kernel& kernel, const Kernel& smooth) {
  Plane across = filtered(luminance, kernel, smooth);
  const Plane down = filtered(luminance, smooth, kernel);
  for (std::size_t i = 0; i < across.values.size(); ++i) across.values[i] = std::hypot(across.values[i], down.values[i]);
  return across;
}

/// Differences of edges and points, in [0, 1].
std::vector<float> feature_differences(Plane a, Plane b, double pixels_per_degree) {
  constexpr double kWidth = 0.082;  // degrees from peak to trough of the eye's edge detector
  const double deviation = kWidth / 2 * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  for (Plane* plane : {&a, &b}) {
    for (float& y : plane->values) y = (y + 16) / 116;
  }
  const Kernel smooth = normalized(gaussian(deviation, radius));
  std::vector<float> largest(a.values.size());
  for (const Kernel& kernel : {edge_kernel(deviation, radius), point_kernel(deviation, radius)}) {
    const Plane in_a = response(a, kernel, smooth), in_b = response(b, kernel, smooth);
    for (std::size_t i = 0; i < largest.size(); ++i)
      largest[i] = std::max(largest[i], std::abs(in_a.values[i] - in_b.values[i]));
  }
  for (float& v : largest) v = std::sqrt(v / std::numbers::sqrt2_v<float>);
  return largest;
}

// --- Both

Opponent to_opponent(const Pixels& pixels, Size size, const std::function<float(float)>& displayed) {
  Opponent planes;
  for (Plane& p : planes) p = {size.width, size.height, std::vector<float>(pixels.size())};
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Tristimulus t = ycxcz({displayed(pixels[i].r), displayed(pixels[i].g), displayed(pixels[i].b)});
    planes[0].values[i] = t.x;
    planes[1].values[i] = t.y;
    planes[2].values[i] = t.z;
  }
  return planes;
}

/// Features amplify the colour difference: Ec^(1 - Ef) [sec. 4.3].
std::vector<float> flip(const Opponent& a, const Opponent& b, double pixels_per_degree) {
  const std::vector<Tristimulus> seen_a = perceived(a, pixels_per_degree), seen_b = perceived(b, pixels_per_degree);
  std::vector<float> map = feature_differences(a[0], b[0], pixels_per_degree);
  for (std::size_t i = 0; i < map.size(); ++i) map[i] = std::pow(color_difference(seen_a[i], seen_b[i]), 1 - map[i]);
  return map;
}

Pixels pixels_of(const Image& image) {
  const auto &r = required_channel(image, "R").values, &g = required_channel(image, "G").values,
             &b = required_channel(image, "B").values;
  Pixels pixels;
  pixels.reserve(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) pixels.emplace_back(r[i], g[i], b[i]);
  return pixels;
}

void require_valid(const Image& image, const Image& reference, const FlipSettings& settings) {
  require_same_size(image, reference);
  if (settings.pixels_per_degree > 0 && settings.pixels_per_degree <= 1000) return;
  throw Error(Failure::usage, "pixels per degree are above 0 and at most 1000; 67 is a desk's display");
}

// --- Exposures [Andersson et al. 2021, sec. 2]

/// The ACES curve as fitted by Narkowicz [2015], with its pre-exposure of 0.6: y = (k0 x^2 + k1 x) / (k2 x^2 + k3 x + k4).
constexpr double kAces[5]{0.36 * 2.51, 0.6 * 0.03, 0.36 * 2.43, 0.6 * 0.59, 0.14};

float aces(double x) {
  const double v = std::max(x, 0.0);
  const double below = (kAces[2] * v + kAces[3]) * v + kAces[4];
  return static_cast<float>(std::clamp((kAces[0] * v + kAces[1]) * v / below, 0.0, 1.0));
}

/// Where the curve reaches y: the positive root of a quadratic.
double inverse_aces(double y) {
  const double a = kAces[0] - y * kAces[2], b = (kAces[1] - y * kAces[3]) / a, c = -y * kAces[4] / a;
  return -b / 2 + std::sqrt(b * b / 4 - c);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

/// First and last exposure and their number into `map`.
void choose_exposures(const Pixels& reference, FlipMap& map) {
  constexpr double kShown = 0.85;  // of the display's range
  std::vector<double> luminances;
  for (const Rgb c : reference) luminances.push_back(0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b);
  const double brightest = *std::max_element(luminances.begin(), luminances.end());
  map.exposures = 1;
  if (!(brightest > 0)) return;
  double typical = median(luminances);
  if (!(typical > 0)) {
    std::erase_if(luminances, [](double v) { return !(v > 0); });
    typical = median(luminances);
  }
  const double shown = inverse_aces(kShown);
  map.start_exposure = std::log2(shown / brightest);
  map.stop_exposure = std::log2(shown / typical);
  map.exposures = std::max(2, static_cast<int>(std::ceil(map.stop_exposure - map.start_exposure)));
}

}  // namespace

double FlipMap::mean() const { return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()); }

FlipMap flip_ldr(const Image& image, const Image& reference, const FlipSettings& settings) {
  require_valid(image, reference, settings);
  const Size size{image.width(), image.height()};
  const auto displayed = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
  FlipMap map;
  map.values = flip(to_opponent(pixels_of(image), size, displayed), to_opponent(pixels_of(reference), size, displayed),
                    settings.pixels_per_degree);
  return map;
}

FlipMap flip_hdr(const Image& image, const Image& reference, const FlipSettings& settings) {
  require_valid(image, reference, settings);
  const Size size{image.width(), image.height()};
  const Pixels a = pixels_of(image), b = pixels_of(reference);
  FlipMap map;
  choose_exposures(b, map);
  map.values.assign(a.size(), 0.0f);
  for (int i = 0; i < map.exposures; ++i) {
    const double step = (map.stop_exposure - map.start_exposure) / std::max(map.exposures - 1, 1);
    const double scale = std::exp2(map.start_exposure + i * step);
    const auto displayed = [scale](float v) { return aces(scale * v); };
    const std::vector<float> one =
        flip(to_opponent(a, size, displayed), to_opponent(b, size, displayed), settings.pixels_per_degree);
    std::transform(one.begin(), one.end(), map.values.begin(), map.values.begin(),
                   [](float v, float w) { return std::max(v, w); });
  }
  return map;
}

}  // namespace tyndall
