/// Pictures whose pixels are measured means: what is compared when two renders are.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "report/statistics.h"
#include "tyndall/image.h"

namespace tyndall {

/// R, G and B of each pixel (or block of pixels) with their errors, row by row.
struct MeanImage {
  int width = 0, height = 0;
  std::array<std::vector<Estimate>, 3> channels;
  /// Up to so many pixels share their noise (RenderSettings::reuse): a sum over pixels has at most so many times the variance
  /// that independent ones would give it.
  double sharing = 1;

  const Estimate& at(int x, int y, int channel) const { return channels[channel][static_cast<std::size_t>(y) * width + x]; }
};

/// Gathers independent renders of one picture (equal samples, different seeds). The error of a pixel is the spread
/// between them, so it needs no word from the renderer.
class MeanImageBuilder {
 public:
  void add(const Image& image);  ///< throws Error (usage) when the size differs from the first one's
  int count() const { return count_; }
  MeanImage result() const;

 private:
  int width_ = 0, height_ = 0, count_ = 0;
  double sharing_ = 1;
  std::array<std::vector<Moments>, 3> moments_;
};

/// An image that carries "Variance.R" .. (of the pixel mean), known with `dof` degrees of freedom unless the image
/// says so itself in "Dof.R" .. . Throws Error (scene) when the variances are absent.
MeanImage mean_image(const Image& image, double dof);

/// How many pixels of `image` share their noise at most, as its header says.
double sharing_of(const Image& image);

/// Means over blocks of size x size pixels; smaller ones at the right and lower edge. Whatever pixels share is in their
/// variances.
MeanImage block_means(const MeanImage& pixels, int size);

/// Mean over everything.
Estimate image_mean(const MeanImage& image, int channel);

}  // namespace tyndall
