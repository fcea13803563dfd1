/// What `render --denoise` does beside rendering.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "cli/render_options.h"
#include "tyndall/denoise.h"
#include "tyndall/render.h"
#include "tyndall/timer.h"

namespace tyndall::cli {

class Denoiser {
 public:
  /// Asks `settings` for the AOVs that it takes. Throws Error (usage) for what cannot be denoised.
  Denoiser(const RenderOptions& options, RenderSettings& settings);

  /// Denoises the finished image, and leaves out the AOVs that were not asked for.
  DenoiseReport finish(Image& image) const;
  bool previews() const { return preview_every_ < std::numeric_limits<double>::infinity(); }
  /// At a checkpoint: writes the picture so far to `output` when the last time was long enough ago. A failure is told on
  /// stderr, once for each reason, and costs no render.
  void preview(const RenderJob& job, const std::string& output);

 private:
  ImageOptions image_;
  std::vector<std::string> asked_;
  int threads_;
  double preview_every_;
  Timer since_preview_;
  std::string failure_;
};

}  // namespace tyndall::cli
