/// Everything `tyndall diff` knows about two images, and when it calls them the same.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "report/flip.h"
#include "report/image_test.h"
#include "report/metrics.h"
#include "tyndall/image.h"

namespace tyndall {

struct DiffSettings {
  std::vector<std::string> channels{};  ///< channels ("Z") or groups ("RGB", "Albedo") to look at; empty: all
  bool reference_noise = false;         ///< also errors without the reference's own noise
  bool flip = true;
  FlipSettings flip_settings{};
  ImageTestSettings test{};
};

/// Values of one channel in one image that no render has: NaN, infinity, or variances below 0.
struct BadValues {
  std::string channel;
  bool in_reference = false;
  std::size_t count = 0;
  int x = 0, y = 0;  ///< the first one's pixel, in the full frame
};

/// A channel that both images have. Differences are image - reference.
struct ChannelDiff {
  std::string name;
  double mean = 0, reference_mean = 0;
  double bias = 0;                   ///< mean difference
  double bias_error = 0;             ///< one standard error of it
  bool error_from_variance = false;  ///< by the images' Variance channels; else by the spread over pixels
  double largest = 0;                ///< absolute difference; NaN counts as infinite
  int x = 0, y = 0;                  ///< where, in the full frame
  bool equal = false;                ///< in every pixel

  double margin() const { return 1.96 * bias_error; }  ///< of the 95 % interval of the bias, to either side
};

/// Channels that belong together: R, G, B as "RGB"; Albedo.R, .G, .B as "Albedo"; Z alone as "Z".
struct GroupDiff {
  std::string name;
  std::vector<std::string> channels;
  ErrorMetrics errors;
  std::optional<ErrorMetrics> without_noise{};  ///< of RGB, when asked for and the reference has variances
};

struct ImageDiff {
  PixelBounds data;
  std::string windows;  ///< how the data windows differ; if they do, nothing below `primaries` is known
  /// How the chromaticities differ, of which an image that states none has Rec.709's; empty: not. Values are compared as they
  /// are.
  std::string primaries;
  std::vector<std::string> only_in_image, only_in_reference;  ///< channels
  std::vector<BadValues> non_finite;
  std::vector<BadValues> negative_variances;
  std::vector<ChannelDiff> channels;
  std::vector<GroupDiff> groups;
  std::optional<FlipMap> flip_ldr, flip_hdr;  ///< of R, G, B, when finite
  std::optional<ImageTest> test;              ///< of R, G, B, when both have variances, none of them negative
};

/// Variance, SampleCount and SampleWeight: channels (and groups) that describe a render and not its picture.
bool is_statistic(const std::string& channel);

/// Throws Error (usage) when a channel asked for is in neither image, or a setting is out of its range.
ImageDiff compare_images(const Image& image, const Image& reference, const DiffSettings& settings = {});

/// What must hold for two images to count as the same; all that are set must. None set: the statistical test where there
/// are variances, else equality. Whatever is set: values that are not finite, negative variances, a channel that one image
/// lacks and different data windows are differences. What is_statistic is judged by `exact` only.
struct Criteria {
  bool test = false;                   ///< the statistical test of R, G, B
  bool exact = false;                  ///< equal values in every pixel of every channel
  std::optional<double> max_error{};   ///< absolute difference of any value
  std::optional<double> max_relmse{};  ///< of any group (of RGB without the reference's noise, when that is known)
  std::optional<double> max_flip{};    ///< mean HDR-FLIP
};

struct Judgement {
  bool same = false;
  std::string criterion;             ///< as the options of the command line
  std::vector<std::string> reasons;  ///< why not, one line each
};

/// Throws Error (usage) when a criterion needs what the images do not have.
Judgement judge(const ImageDiff& diff, const Criteria& criteria);

}  // namespace tyndall
