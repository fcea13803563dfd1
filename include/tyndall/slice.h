/// A render in slices: machines each take a range of the samples of one seed, and what they bring adds up to the very image
/// that one of them would have made alone.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "tyndall/image.h"

namespace tyndall {

class World;
struct DeepImage;
struct RenderSettings;

/// Samples [first, first + count) of every pixel.
struct SampleRange {
  int first = 0, count = 0;
  bool operator==(const SampleRange&) const = default;
};

/// Slices begin at multiples: at an even sample, as replicates do, and where Sobol' points are balanced.
inline constexpr int kSliceGrain = 16;

/// More would be a damaged header, or a mistake.
inline constexpr int kMostSlices = 100'000;

/// Slice `index` of `count`, from 1.
struct SliceChoice {
  int index = 1, count = 1;
  bool operator==(const SliceChoice&) const = default;
};

/// The samples that `settings` ask for: all of `spp`, or those of the slice, which begins and ends at multiples of 16 (the end
/// of all excepted). Throws Error (usage) for a slice that cannot be, or has no samples.
SampleRange sample_range(const RenderSettings& settings);

/// What the header of a rendered slice says.
struct SliceInfo {
  SliceChoice choice;
  int total = 0;         ///< samples a pixel that all slices were asked for; the largest int: as many as their time gives
  bool timed = false;    ///< each slice was given a time, and ends where that does
  bool stopped = false;  ///< before its end
  SampleRange range;     ///< the samples that are in it

  SampleRange share() const;  ///< the samples that it was asked for
  bool complete() const;      ///< all of them, or of its time
};
/// Nothing when the image is no slice, nor a merge of some. Throws Error (scene), naming `path`, for a header that is damaged.
std::optional<SliceInfo> slice_info(const Image& header, const std::string& path);

/// A slice that is being rendered, or was.
struct SliceCheckpoint {
  SliceInfo info;
  double seconds = 0;  ///< of rendering
};
/// From the bytes of RenderJob::save; nothing when they are not of a slice. Throws Error (scene), naming `path`, for bytes that
/// are no checkpoint or damaged.
std::optional<SliceCheckpoint> slice_checkpoint(std::string_view bytes, const std::string& path);

/// Whether `image`, of a file, is the slice that `settings` ask for: of the same scene, options and samples, complete and
/// intact.
bool holds_slice(const Image& image, const World& world, const RenderSettings& settings);

/// The exact sum of slices of one render, in any order.
class SliceSum {
 public:
  /// For slices that go with `header`, that of one of them.
  SliceSum(const Image& header, const std::string& path);
  SliceSum(SliceSum&&) noexcept;
  SliceSum& operator=(SliceSum&&) noexcept;
  ~SliceSum();

  /// Throws Error (scene), naming `path`, for pixels that are not as they were written, and is then as before.
  void add(const Image& slice, const std::string& path);

  int samples() const;  ///< a pixel, of all that was added
  /// As RenderJob::estimated_relmse.
  double estimated_relmse() const;
  /// Channels and windows as a render of all these samples would have given, bit for bit. Attributes are the caller's.
  /// `with_variance`: Variance and SampleCount are there whether they were asked for or not.
  Image image(bool with_variance) const;
  /// Where the slices have what it takes (RenderSettings::deep_bins); without attributes.
  std::optional<DeepImage> deep_image() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Of the attributes, those that a slice has and the whole has not.
bool is_slice_attribute(std::string_view name);

}  // namespace tyndall
