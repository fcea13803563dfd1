#include "report/error_parts.h"

#include <numeric>
#include <string>
#include <utility>

#include "report/metrics.h"
#include "tyndall/relative_error.h"

namespace tyndall {
namespace {

const std::vector<float>& values_of(const Image& image, const std::string& name) {
  return required_channel(image, name).values;
}

/// Sum of squared differences, each over the reference's square.
double relative_difference(const std::vector<float>& a, const std::vector<float>& b, const std::vector<float>& reference) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = double{a[i]} - double{b[i]}, r = reference[i];
    sum += d * d / (r * r + kRelativeEpsilon);
  }
  return sum;
}

}  // namespace

void ErrorParts::add(const Image& image) {
  if (image.channels.empty()) return;
  std::vector<std::vector<float>> parts;
  for (const char* part : kLightParts) {
    for (const char* color : {"R", "G", "B"}) {
      parts.push_back(values_of(image, std::string(part) + "." + color));
      if (before_.empty()) continue;
      const std::size_t i = parts.size() - 1;
      variances_[i / 3] += relative_difference(parts[i], before_[i], values_of(*reference_, color));
    }
  }
  before_ = std::move(parts);
}

std::optional<ErrorParts::Shares> ErrorParts::shares() const {
  const double sum = std::accumulate(variances_.begin(), variances_.end(), 0.0);
  if (!(sum > 0)) return std::nullopt;
  Shares shares = variances_;
  for (double& share : shares) share /= sum;
  return shares;
}

}  // namespace tyndall
