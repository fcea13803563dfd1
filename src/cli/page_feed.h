/// What a render tells the page of --serve.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/denoiser.h"
#include "serve/live_page.h"
#include "tyndall/render.h"

namespace tyndall::cli {

/// Of one picture. Hardly anything is made for a page that nobody looks at, and nothing that goes wrong here costs a render.
class PageFeed {
 public:
  /// `page` and `denoiser`, which may be null, must outlive this.
  PageFeed(LivePage& page, const Denoiser* denoiser) : page_(page), denoiser_(denoiser) {}

  /// Puts itself beside what `control` does already.
  void join(RenderControl& control);
  void begin(const std::string& stage, const std::string& output) {
    page_.begin(stage, output, denoiser_ && stage == "rendering" ? "denoising" : "");
  }
  /// What is written.
  void show(const Rendering& rendering);

 private:
  void look_at(const RenderJob& job);
  void denoise(const RenderJob& job);
  void keep_errors(const RenderJob& job);
  void try_to(const std::function<void()>& show);

  LivePage& page_;
  const Denoiser* denoiser_;
  int shown_ = 0;                   ///< samples a pixel of the last picture
  std::vector<float> last_errors_;  ///< of the pixels
  bool failed_ = false;
};

}  // namespace tyndall::cli
