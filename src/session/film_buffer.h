/// Sums of samples a pixel, and the image made of them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "transport/path_record.h"
#include "tyndall/image.h"
#include "tyndall/scene.h"

namespace tyndall {

enum class Aov {
  albedo,
  n,
  p,
  z,
  z_volume,
  variance,
  sample_count,
  transmittance,
  surface_direct,
  surface_indirect,
  volume_direct,
  volume_indirect,
  emission,
};

/// AOVs by name, once each, in the order of aov_names(). Throws Error (usage) that lists the names for an unknown one.
std::vector<Aov> parse_aovs(const std::vector<std::string>& names);

/// Double sums over the pixels of a crop. A pixel is written by one thread at a time, its samples in order, so that
/// the sums do not depend on threads or on how samples are grouped into passes.
class FilmBuffer {
 public:
  /// The film rectangle `crop` and the AOVs to gather.
  FilmBuffer(const Film& film, PixelBounds crop, std::vector<Aov> aovs);

  bool wants(Aov aov) const;
  const PixelBounds& crop() const { return crop_; }

  /// Add sample number `sample` of pixel (x, y) of the full frame, weighted by the pixel filter.
  void add(int x, int y, int sample, const PathRecord& record, float weight);

  /// All sums, pixel by pixel: what a checkpoint keeps.
  std::span<const double> sums() const { return sums_; }
  std::span<double> sums() { return sums_; }
  /// The sums of the pixels of `tile`, which lies in the crop; and back.
  std::vector<double> copy(const PixelBounds& tile) const;
  void restore(const PixelBounds& tile, const std::vector<double>& sums);
  void clear(const PixelBounds& tile);

  /// Means of the `samples` samples that every pixel has received, in the film's colour space. Beside P and Z stands
  /// SurfaceCount, beside Zvol VolumeCount: over how many samples their means are, so that renders can be merged.
  Image image(int samples) const;

  /// Mean of variance / (mean^2 + 0.01) over pixels and channels, as the two replicates tell; infinity for samples < 2.
  double estimated_relmse(int samples) const;

 private:
  double* pixel(int x, int y) { return sums_.data() + crop_.index(x, y) * stride_; }
  const double* pixel(std::size_t index) const { return sums_.data() + index * stride_; }
  void add_aov(Aov aov, double* sum, const PathRecord& record, float weight) const;
  void store_color(Image& image, const std::string& prefix, std::size_t offset, int samples) const;
  void store_ratio(Image& image, const std::string& prefix, std::size_t offset, int samples) const;
  void store_aov(Image& image, Aov aov, std::size_t offset, int samples) const;
  void store_variance(Image& image, int samples) const;
  void store_count(Image& image, const std::string& name, std::size_t offset) const;
  void store_counts(Image& image) const;
  Rgb to_film_space(Rgb c) const;

  Film film_;
  PixelBounds crop_;
  std::vector<Aov> aovs_;
  std::vector<std::size_t> offsets_;  ///< of each AOV within a pixel's sums
  std::size_t stride_;
  std::vector<double> sums_;
};

}  // namespace tyndall
