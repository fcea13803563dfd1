#include "denoise/share_out.h"

#include <algorithm>

#include "denoise/inputs.h"

namespace tyndall {
namespace {

std::vector<float*> planes_of(Image& image, const std::vector<std::string>& prefixes, const std::string& suffix) {
  std::vector<float*> planes;
  for (const std::string& prefix : prefixes) {
    for (Channel& c : image.channels) {
      if (c.name == prefix + suffix) planes.push_back(c.values.data());
    }
  }
  return planes;
}

/// Fits may fall below 0, where there is next to no light. Where all do, the groups have even shares.
void share_pixel(double total, const std::vector<float*>& planes, std::size_t i) {
  double sum = 0;
  for (const float* plane : planes) sum += std::max(plane[i], 0.0f);
  for (float* plane : planes) {
    const double share = sum > 0 ? std::max(plane[i], 0.0f) / sum : 1.0 / static_cast<double>(planes.size());
    plane[i] = static_cast<float>(total * share);
  }
}

}  // namespace

void share_out(const ColorPlanes& total, const std::vector<std::string>& prefixes, Image& image) {
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<float*> planes = planes_of(image, prefixes, kRgb[c]);
    std::size_t i = 0;
    for (int y = 0; y < total[c].height(); ++y) {
      for (int x = 0; x < total[c].width(); ++x) share_pixel(total[c].at(x, y), planes, i++);
    }
  }
}

}  // namespace tyndall
