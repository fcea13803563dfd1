#include "report/metrics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tyndall/error.h"
#include "tyndall/image_attributes.h"
#include "tyndall/relative_error.h"

namespace tyndall {
namespace {

const std::vector<std::string> kRgb{"R", "G", "B"};

/// Planes of one image side by side.
using Planes = std::vector<const std::vector<float>*>;

Planes planes_of(const Image& image, const std::vector<std::string>& channels, const std::string& prefix = "") {
  Planes planes;
  for (const std::string& name : channels) planes.push_back(&required_channel(image, prefix + name).values);
  return planes;
}

/// `noise`: variances of the reference, or nothing.
ErrorMetrics measure(const Planes& image, const Planes& reference, const Planes& noise) {
  ErrorMetrics sum;
  std::vector<double> relative(image.front()->size());  // of each pixel
  const auto channels = static_cast<double>(image.size());
  for (std::size_t k = 0; k < image.size(); ++k) {
    for (std::size_t i = 0; i < relative.size(); ++i) {
      const double x = (*image[k])[i], r = (*reference[k])[i], distance = std::abs(x - r);
      const double square = distance * distance - (noise.empty() ? 0.0 : (*noise[k])[i]);
      const double relative_square = square / (r * r + kRelativeEpsilon);
      sum.mse += square;
      sum.relmse += relative_square;
      sum.mape += distance / (std::abs(r) + kRelativeEpsilon);
      sum.smape += 2 * distance / (std::abs(x) + std::abs(r) + kRelativeEpsilon);
      relative[i] += relative_square / channels;
    }
  }
  const double count = channels * static_cast<double>(relative.size());
  const bool trims = std::isfinite(sum.relmse) && kTrimmedFraction * static_cast<double>(relative.size()) >= 1;
  const double trimmed = trims ? trimmed_mean(std::move(relative), kTrimmedFraction) : sum.relmse / count;
  return {sum.mse / count, sum.relmse / count, trimmed, sum.mape / count, sum.smape / count};
}

}  // namespace

double trimmed_mean(std::vector<double> values, double fraction) {
  const auto dropped = static_cast<std::size_t>(fraction * static_cast<double>(values.size()));
  const auto kept = values.end() - static_cast<std::ptrdiff_t>(dropped);
  if (dropped > 0) std::nth_element(values.begin(), kept, values.end());
  return std::accumulate(values.begin(), kept, 0.0) / static_cast<double>(values.size() - dropped);
}

const Channel& required_channel(const Image& image, const std::string& name) {
  if (const Channel* channel = image.find(name)) return *channel;
  const bool variance = name.starts_with("Variance.");
  throw Error(Failure::scene, "the image has no channel " + name +
                                  (variance ? "; render it with --aov Variance" : "; choose an image that has it"));
}

void require_same_size(const Image& a, const Image& b) {
  if (a.width() == b.width() && a.height() == b.height()) return;
  const auto size = [](const Image& i) { return std::to_string(i.width()) + " x " + std::to_string(i.height()); };
  throw Error(Failure::usage, "images of different sizes, " + size(a) + " and " + size(b) +
                                  ", cannot be compared; render them at one resolution");
}

ErrorMetrics measure_error(const Image& image, const Image& reference) { return measure_error(image, reference, kRgb); }

ErrorMetrics measure_error(const Image& image, const Image& reference, const std::vector<std::string>& channels) {
  require_same_size(image, reference);
  return measure(planes_of(image, channels), planes_of(reference, channels), {});
}

ErrorMetrics measure_error_without_noise(const Image& image, const Image& reference) {
  require_same_size(image, reference);
  ErrorMetrics errors = measure(planes_of(image, kRgb), planes_of(reference, kRgb), planes_of(reference, kRgb, "Variance."));
  errors.stated = stated_errors(image, reference);
  return errors;
}

bool has_variances(const Image& image) {
  return image.find("Variance.R") && image.find("Variance.G") && image.find("Variance.B") &&
         !image.attributes.contains(attributes::kDenoised);
}

double relmse_by_variances(const Image& image) {
  const Planes means = planes_of(image, kRgb), variances = planes_of(image, kRgb, "Variance.");
  double sum = 0;
  for (std::size_t k = 0; k < means.size(); ++k) {
    for (std::size_t i = 0; i < means[k]->size(); ++i) {
      const double mean = (*means[k])[i], variance = (*variances[k])[i];
      sum += variance / (std::max(mean * mean - variance, 0.0) + kRelativeEpsilon);
    }
  }
  return sum / static_cast<double>(means.size() * means.front()->size());
}

}  // namespace tyndall
