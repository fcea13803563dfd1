/// Sums of samples a pixel, and the image made of them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "session/allocation.h"
#include "session/aov.h"
#include "session/deep_layout.h"
#include "session/film_sums.h"
#include "session/keyed_sums.h"
#include "transport/sample/deep_sample.h"
#include "transport/sample/path_record.h"
#include "tyndall/cryptomatte.h"
#include "tyndall/deep_image.h"
#include "tyndall/image.h"
#include "tyndall/scene.h"

namespace tyndall {

/// Samples of a pixel of which the odd ones are left out.
inline int even_of(int samples) { return samples - samples / 2; }

/// What a FilmBuffer holds of a few pixels.
struct FilmTile {
  FilmSums sums;
  std::vector<KeyedSums> keyed;

  bool empty() const { return sums.size() == 0; }
};

/// Sums over the pixels of a crop. A pixel is written by one thread at a time; neither threads nor how samples are grouped into
/// passes, or into jobs, change a sum.
class FilmBuffer {
 public:
  /// What is gathered beside R G B A.
  struct Extras {
    std::vector<Aov> aovs{};
    std::vector<std::string> groups{};  ///< names of light groups
    std::optional<DeepLayout> deep{};
  };
  /// Sums of a pixel with these, without KeyedSums; and channels of the image, without those of mattes, or a few more.
  static std::size_t sums_of_pixel(const Extras& extras);
  static std::size_t channels_of_image(const Extras& extras);
  /// The film rectangle `crop` and what to gather.
  FilmBuffer(const Film& film, PixelBounds crop, Extras extras);

  bool wants(Aov aov) const;
  const PixelBounds& crop() const { return crop_; }
  const Film& film() const { return film_; }

  struct SamplePlace {
    int x, y, sample;  ///< its number, in pixel (x, y) of the full frame
    float share = 1;   ///< of how many samples of the mean it is, where pixels have different numbers (SamplePlan::share)
  };
  /// Add a sample, weighted by the pixel filter.
  void add(const SamplePlace& at, const PathRecord& record, float weight);
  /// The same sample by light groups, one for each. What rounding makes their sum differ from `radiance` by goes to the
  /// brightest of them, so that the sums of the groups are those of R G B.
  void add_groups(const SamplePlace& at, Rgb radiance, std::span<const Rgb> by_group, float weight);
  const std::vector<std::string>& groups() const { return groups_; }
  const std::optional<DeepLayout>& deep_layout() const { return deep_; }

  /// The same sample by mattes: `coverage` of `id` in a layer that an AOV asks for.
  void add_matte(const SamplePlace& at, Aov layer, MatteCoverage cover, float weight);
  /// The same sample in depth.
  void add_deep(const SamplePlace& at, std::span<const DeepSample::Part> parts, float weight);

  /// All sums, pixel by pixel: what a checkpoint keeps.
  const FilmSums& sums() const { return sums_; }
  FilmSums& sums() { return sums_; }
  /// Besides, those of mattes and of depth, by layer.
  std::vector<KeyedSums>& keyed() { return keyed_; }
  const std::vector<KeyedSums>& keyed() const { return keyed_; }
  /// The sums of the pixels of `tile`, which lies in the crop; and back.
  FilmTile copy(const PixelBounds& tile) const;
  void restore(const PixelBounds& tile, const FilmTile& sums);
  void clear(const PixelBounds& tile);

  /// Means over `samples` of each pixel, in the film's colour space. `paths`: how many it has had in their place, where that
  /// differs; the channel SampleWeight then tells `samples`. Beside P and Z stands
  /// SurfaceCount, beside Zvol VolumeCount: over how many samples their means are, so that renders can be merged. With
  /// Aov::replicate each channel that is a mean comes a second time, as "Replicate.R" and so on: over the even samples. Light
  /// groups are "LightGroup.key.R" and so on, with Aov::variance "Variance.LightGroup.key.R".
  Image image(int samples, std::span<const int> paths = {}) const;
  /// The same in depth; nothing where that was not asked for. Attributes are the caller's.
  std::optional<DeepImage> deep_image(int samples) const;

  /// The exact sums as channels "Sum.N.high", ".mid" and ".low", floats that add up to sum number N; and back, added to those
  /// here: of an image of the same crop that has_sums().
  void store_sums(Image& image) const;
  bool has_sums(const Image& image) const;
  void add_sums(const Image& image);

  /// As RenderJob tells.
  double estimated_relmse(int samples) const;
  /// Of a block of pixels that are means over so many samples, 2 or more.
  BlockNoise noise(const PixelBounds& block, int samples) const;

 private:
  static constexpr std::size_t kEven = 0, kOdd = 3;                                 ///< where the sums of a half begin
  std::size_t first_of(int x, int y) const { return crop_.index(x, y) * stride_; }  ///< of a pixel's sums
  double sum(std::size_t pixel, std::size_t offset) const { return sums_.value(pixel * stride_ + offset); }
  void add3(std::size_t first, float x, float y, float z, float weight);
  void add3(std::size_t first, Rgb c, float weight) { add3(first, c.r, c.g, c.b, weight); }
  void add_aov(Aov aov, std::size_t first, const PathRecord& record, float weight, float share);
  /// Which samples the channels of an image are means of.
  struct Means {
    std::string prefix;  ///< of the channels
    int samples;
    std::span<const int> paths;
    bool even_only = false;

    int count() const { return even_only ? even_of(samples) : samples; }
    int paths_of(std::size_t pixel) const {
      const int all = paths.empty() ? samples : paths[pixel];
      return even_only ? even_of(all) : all;
    }
  };
  void store_means(Image& image, const Means& means) const;
  /// Sums at `offset`; light that is summed by halves has those of the odd samples after those of the even ones.
  enum class Halves : bool { joined, apart };
  void store_color(Image& image, const std::string& name, std::size_t offset, const Means& means, Halves halves) const;
  void store_ratio(Image& image, const std::string& name, std::size_t offset, const Means& means) const;
  void store_aov(Image& image, Aov aov, std::size_t offset, const Means& means) const;
  void store_variance(Image& image, const std::string& name, std::size_t offset, int samples) const;
  /// Of the means of even and odd samples, at `offset`; of a pixel with one sample, its mean.
  Rgb difference(std::size_t pixel, std::size_t offset, int samples) const;
  void store_groups(Image& image, const Means& means) const;
  void store_mattes(Image& image, int samples) const;
  void store_keyed(Image& image) const;
  void add_keyed(const Image& image);
  std::string keyed_name(std::size_t layer) const;
  void store_count(Image& image, const std::string& name, std::size_t offset) const;
  void store_counts(Image& image, const Means& means) const;
  void store_paths(Image& image, const Means& means) const;
  /// By channel.
  struct PixelNoise {
    std::array<double, 3> mean, variance;  ///< of all samples, and that mean's variance
    std::array<double, 3> square;          ///< of the true mean: unbiased, may be below 0
  };
  /// Of a pixel that has 2 samples or more.
  PixelNoise noise_of(std::size_t pixel, int samples) const;
  Rgb to_film_space(Rgb c) const;

  Film film_;
  PixelBounds crop_;
  std::vector<Aov> aovs_;
  std::vector<std::string> groups_;
  std::vector<std::size_t> offsets_;  ///< of each AOV within a pixel's sums; those of its even samples follow when wanted
  std::size_t first_group_;           ///< its sums, those of the others follow
  bool replicate_;
  std::size_t stride_;
  FilmSums sums_;
  std::vector<Aov> mattes_;  ///< layers, in the order of the AOVs
  std::optional<DeepLayout> deep_;
  std::vector<KeyedSums> keyed_;  ///< of the mattes, then of depth
};

}  // namespace tyndall
