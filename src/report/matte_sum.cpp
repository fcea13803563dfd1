#include "report/matte_sum.h"

namespace tyndall {

void MatteSum::add(std::size_t pixel, const std::vector<MatteCoverage>& covers, double samples) {
  if (!(samples > 0)) return;
  for (const MatteCoverage& cover : covers) pixels_[pixel][cover.id] += samples * static_cast<double>(cover.coverage);
}

void MatteSum::store(Image& image, const std::vector<double>& samples) const {
  MatteWriter writer(image, layer_);
  std::vector<MatteCoverage> covers;
  for (std::size_t pixel = 0; pixel < pixels_.size(); ++pixel) {
    covers.clear();
    for (const auto& [id, sum] : pixels_[pixel]) covers.push_back({id, static_cast<float>(sum / samples[pixel])});
    writer.set(pixel, covers);
  }
}

}  // namespace tyndall
