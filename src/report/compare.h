/// Methods side by side on one scene: error against time.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "report/efficiency.h"
#include "report/error_parts.h"
#include "report/race.h"
#include "report/reference.h"

namespace tyndall {

/// A method under its name.
struct CompareVariant {
  std::string name;
  std::string options;  ///< as on the command line
  RenderSettings settings;
};

/// What is made of every picture after rendering: each variant then comes twice, as rendered and filtered.
struct CompareFilter {
  std::string name, option;                  ///< added to the variant's
  std::vector<std::string> aovs;             ///< that it takes
  std::function<Image(const Image&)> apply;  ///< empty: nothing is filtered
};

struct ComparePlan {
  std::vector<CompareVariant> variants;  ///< the first is what the others are measured by
  RaceBudget budget;
  std::vector<std::uint64_t> seeds;  ///< a run of every variant for each
  CompareFilter filter{};
};

/// One point of a variant's curve: means over the seeds, at equal samples.
struct CurvePoint {
  double seconds = 0, samples = 0;
  double mse = 0;
  ConfidenceInterval relmse;
};

/// What the runs of a variant say together. What cannot be said is absent.
struct VariantResult {
  std::string name, options;
  std::string as_rendered;   ///< filtered: the variant whose pictures these were; else empty
  double build_seconds = 0;  ///< of what only this strategy needs
  double samples = 0, seconds = 0;
  int least_samples = 0, most_samples = 0;  ///< of any pixel
  ErrorMetrics error;                       ///< at the end, mean over the seeds
  std::vector<CurvePoint> curve;
  std::optional<ConfidenceInterval> slope;                           ///< of log relMSE against log seconds
  std::optional<ConfidenceInterval> slope_samples;                   ///< against log samples: without the machine's moods
  std::optional<ConfidenceInterval> efficiency, efficiency_trimmed;  ///< relative to the first variant
  std::array<double, 3> mean_rgb{};
  Image image;                                    ///< of the first seed
  Image sample_counts;                            ///< Y: samples of its pixels, where they differ; else empty
  std::optional<WorkParts> work;                  ///< mean over the seeds, fractions of 1; of pictures as rendered
  std::optional<ErrorParts::Shares> error_parts;  ///< likewise, from two seeds on
  std::uint64_t non_finite = 0, majorant_violations = 0, caps_hit = 0, parity_errors = 0;
  bool given_up = false;

  bool near_noise = false;  ///< its error is so near the reference's own that slope and efficiency say little

  /// "", or what the slopes are a sign of.
  std::string slope_note() const;
};

struct CompareResult {
  std::vector<VariantResult> variants;
  std::vector<std::string> warnings;
  std::size_t seeds_done = 0;  ///< fewer than planned: stopped
};

struct CompareControl {
  std::function<void(double)> progress{};   ///< told the fraction that is done; may be empty
  const std::atomic<bool>* stop = nullptr;  ///< set it to end with the seeds that are complete
};

/// What the plan's variants and a reference rendered with `base` need of a World, added to `settings`.
BuildSettings with_needs_of(const ComparePlan& plan, const RenderSettings& base, BuildSettings settings);

/// Run the plan on `world`, which must have been built for every light strategy in it. No variants in the result: it was
/// stopped before a seed was complete.
CompareResult compare(const World& world, const ComparePlan& plan, const Reference& reference,
                      const CompareControl& control = {});

}  // namespace tyndall
