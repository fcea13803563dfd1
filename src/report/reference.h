/// The picture that errors are measured against.
#pragma once

#include <functional>
#include <limits>
#include <string>

#include "report/metrics.h"
#include "tyndall/render.h"

namespace tyndall {

struct Reference {
  Image image;
  std::string source;        ///< its file, or "rendered"
  bool has_variance = false; ///< its own noise is known and taken off every error
  int samples = 0;           ///< a pixel; 0: the file does not say
  std::string seed;          ///< empty: the file does not say
  double seconds = 0;        ///< it took to render here
  double relmse = 0;         ///< estimated from its variance; 0 when that is absent

  ErrorMetrics error_of(const Image& picture) const;
  /// Throws Error (usage) unless it has as many pixels a side as `pixels`.
  void require_size(const PixelBounds& pixels) const;
};

/// Throws Error (scene) when it cannot be read or has no R, G and B.
Reference read_reference(const std::string& path);

/// When a reference is good enough.
struct ReferenceGoal {
  double relmse = 1e-3;                                          ///< estimated, eps 0.01
  double seconds = std::numeric_limits<double>::infinity();      ///< at most
  int samples = std::numeric_limits<int>::max();                 ///< at most
};

/// Render one with the settings given, but for spp, time and error. `progress` is told how far it is, in [0, 1].
Reference render_reference(const World& world, RenderSettings settings, const ReferenceGoal& goal,
                           const std::function<void(const Progress&)>& progress);

}  // namespace tyndall
