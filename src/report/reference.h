/// The picture that errors are measured against.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "report/metrics.h"
#include "tyndall/render.h"

namespace tyndall {

struct Reference {
  Image image;
  std::string source;         ///< its file, or "rendered"
  bool has_variance = false;  ///< its own noise is known and taken off every error
  int samples = 0;            ///< a pixel; 0: the file does not say
  std::string seed;           ///< several when merged, "1,2"; empty: the file does not say
  double seconds = 0;         ///< it took to render here
  double relmse = 0;          ///< estimated from its variance; 0 when that is absent
  bool stopped = false;       ///< by RenderControl::stop, before it was good enough

  ErrorMetrics error_of(const Image& picture) const;
  /// It can be held against renders of `world` with `settings` and these seeds. Throws Error (scene) for other pixels,
  /// another scene (as far as the image says which it is of), and a seed that is among `seeds`: an error against one's own
  /// samples means nothing.
  void require_fit(const World& world, const RenderSettings& settings, const std::vector<std::uint64_t>& seeds) const;

 private:
  [[noreturn]] void refuse(const std::string& why) const;
};

/// `source` stands for the image in messages. Throws Error (scene) when it has no R, G and B, or values that are not finite.
Reference as_reference(Image image, const std::string& source);
/// The same of a file. Throws Error (scene) when it cannot be read.
Reference read_reference(const std::string& path);

/// Of references that are rendered: apart from any seed that a run is likely to have.
inline constexpr std::uint64_t kReferenceSeed = 0x7265666572656e63;

/// When a reference is good enough.
struct ReferenceGoal {
  double relmse = 1e-3;                                      ///< estimated, eps 0.01
  double seconds = std::numeric_limits<double>::infinity();  ///< at most
  int samples = std::numeric_limits<int>::max();             ///< at most
};

/// Render one with the settings given, but for spp, time and error; at least 16 samples, unless stopped.
Reference render_reference(const World& world, RenderSettings settings, const ReferenceGoal& goal,
                           const RenderControl& control = {});

}  // namespace tyndall
