/// Images held against each other, and methods: what `tyndall diff` and `tyndall compare` find, for programs.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/image.h"
#include "tyndall/scene.h"
#include "tyndall/settings.h"

namespace tyndall {

/// What to look at, and what must hold for two images to count as the same: all criteria that are set. None set: the
/// statistical test where both have variances, else equality.
struct DiffQuestion {
  std::vector<std::string> channels{};  ///< channels ("Z") or groups ("RGB", "Albedo") to look at; empty: all
  bool reference_noise = false;         ///< also errors without the reference's own noise
  bool flip = true;                     ///< FLIP, the slowest of the metrics
  bool test = false;                    ///< the statistical test of R, G and B
  bool exact = false;                   ///< equal values in every pixel of every channel
  std::optional<double> max_error{};    ///< absolute difference of any value
  std::optional<double> max_relmse{};   ///< of any group
  std::optional<double> max_flip{};     ///< mean HDR-FLIP
};
/// What `tyndall diff --json` prints (docs/comparing.md). Throws Error (usage) when a channel asked for is in neither image,
/// or a criterion needs what they do not have.
std::string diff_images(const Image& image, const Image& reference, const DiffQuestion& question = {});

/// A method under its name.
struct NamedMethod {
  std::string name;
  RenderSettings settings;
};
/// Runs of every method with seeds `seed`, seed + 1, ...; one of `seconds` (of rendering) and `samples` (a pixel) is set.
struct MethodRace {
  std::vector<NamedMethod> methods;  ///< the first is what the others are measured by
  std::optional<double> seconds{};
  std::optional<int> samples{};
  int seeds = 5;           ///< >= 2: intervals come from their spread
  std::uint64_t seed = 1;  ///< of the first run
  /// What errors are measured against; one is rendered, with the first method, when there is none.
  std::optional<Image> reference{};
  double reference_relmse = 1e-3;             ///< estimated, at which the rendered one is good enough
  std::optional<double> reference_seconds{};  ///< to render it for, at most
  int threads = 0;                            ///< 0: all cores
  /// Bytes: of BuildSettings.
  std::size_t max_memory = std::numeric_limits<std::size_t>::max();
};
struct MethodRaceControl {
  std::function<void(double)> progress{};   ///< told the fraction that is done, the reference apart; may be empty
  const std::atomic<bool>* stop = nullptr;  ///< set it to end with the seeds that are complete
};
struct NamedImage {
  std::string name;
  Image image;
};
struct MethodRaceResult {
  std::string json;  ///< results.json (docs/comparing.md)
  Image reference;
  std::vector<NamedImage> images;  ///< of the first seed, one of each method that was not given up
};
/// Throws Error: usage for a plan that cannot be, incomplete when it is stopped before a seed is complete, and what build()
/// throws.
MethodRaceResult race_methods(Scene scene, const MethodRace& plan, const MethodRaceControl& control = {});

}  // namespace tyndall
