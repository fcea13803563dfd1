#include "report/mean_image.h"

#include <algorithm>
#include <string>

#include "report/metrics.h"
#include "tyndall/error.h"
#include "tyndall/image_attributes.h"

namespace tyndall {
namespace {

constexpr std::array<const char*, 3> kSuffix{"R", "G", "B"};

Estimate block_mean(const MeanImage& pixels, int channel, const PixelBounds& block) {
  std::vector<Estimate> parts;
  for (int y = block.y0; y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x) parts.push_back(pixels.at(x, y, channel));
  }
  Estimate mean = average(parts);
  // Var(sum over a group) <= n sum Var [Cauchy and Schwarz], and groups are independent.
  mean.variance *= std::min(pixels.sharing, static_cast<double>(parts.size()));
  return mean;
}

}  // namespace

void MeanImageBuilder::add(const Image& image) {
  if (count_ == 0) {
    width_ = image.width();
    height_ = image.height();
    for (auto& m : moments_) m.resize(static_cast<std::size_t>(width_) * height_);
  }
  if (image.width() != width_ || image.height() != height_) {
    throw Error(Failure::usage, "images of different sizes cannot be averaged; render them at one resolution");
  }
  ++count_;
  sharing_ = std::max(sharing_, sharing_of(image));
  for (int k = 0; k < 3; ++k) {
    const std::vector<float>& values = required_channel(image, kSuffix[k]).values;
    for (std::size_t i = 0; i < values.size(); ++i) moments_[k][i].add(values[i]);
  }
}

MeanImage MeanImageBuilder::result() const {
  MeanImage result{width_, height_, {}, sharing_};
  for (int k = 0; k < 3; ++k) {
    for (const Moments& m : moments_[k]) result.channels[k].push_back(m.estimate());
  }
  return result;
}

MeanImage mean_image(const Image& image, double dof) {
  MeanImage result{image.width(), image.height(), {}, sharing_of(image)};
  for (int k = 0; k < 3; ++k) {
    const std::string suffix = kSuffix[k];
    const Channel& mean = required_channel(image, suffix);
    const Channel& variance = required_channel(image, "Variance." + suffix);
    const Channel* known = image.find("Dof." + suffix);
    for (std::size_t i = 0; i < mean.values.size(); ++i) {
      result.channels[k].push_back({mean.values[i], variance.values[i], known ? known->values[i] : dof});
    }
  }
  return result;
}

double sharing_of(const Image& image) {
  const int* sharing = image.attribute<int>(attributes::kSharing);
  return sharing ? std::max(*sharing, 1) : 1;
}

MeanImage block_means(const MeanImage& pixels, int size) {
  MeanImage result{(pixels.width + size - 1) / size, (pixels.height + size - 1) / size, {}};
  for (int k = 0; k < 3; ++k) {
    for (int y = 0; y < pixels.height; y += size) {
      for (int x = 0; x < pixels.width; x += size) {
        result.channels[k].push_back(
            block_mean(pixels, k, {x, y, std::min(x + size, pixels.width), std::min(y + size, pixels.height)}));
      }
    }
  }
  return result;
}

Estimate image_mean(const MeanImage& image, int channel) {
  return block_mean(image, channel, {0, 0, image.width, image.height});
}

}  // namespace tyndall
