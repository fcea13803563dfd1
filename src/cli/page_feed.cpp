#include "cli/page_feed.h"

#include <exception>
#include <utility>

#include "cli/log.h"
#include "tyndall/timer.h"

namespace tyndall::cli {
namespace {

/// Fewer samples show more blotches than picture.
constexpr int kFirstDenoised = 4;

}  // namespace

void PageFeed::join(RenderControl& control) {
  control.progress = [this, progress = std::move(control.progress)](const Progress& p) {
    page_.show(p);
    progress(p);
  };
  control.pass_end = [this](const RenderJob& job) {
    try_to([&] { look_at(job); });
    if (denoiser_ && job.samples() >= kFirstDenoised) try_to([&] { denoise(job); });
  };
  control.end = [this](const RenderJob& job) { try_to([&] { keep_errors(job); }); };
}

/// With twice the samples also when nobody looks, so that who comes sees something.
void PageFeed::look_at(const RenderJob& job) {
  if (job.samples() < 2 * shown_ && !page_.wants_picture()) return;
  const Timer watch;
  LivePage::Picture picture{job.image(), job.estimated_errors(), job.estimated_relmse()};
  picture.seconds = watch.seconds();
  page_.show(std::move(picture));
  shown_ = job.samples();
}

void PageFeed::denoise(const RenderJob& job) {
  if (!page_.wants_denoised()) return;
  const Timer watch;
  Image image = job.image();
  denoiser_->finish(image);
  page_.show_denoised(std::move(image), watch.seconds());
}

void PageFeed::keep_errors(const RenderJob& job) {
  if (page_.is_watched()) last_errors_ = job.estimated_errors();
}

void PageFeed::show(const Rendering& rendering) {
  try_to([&] {
    if (page_.is_watched()) page_.show({rendering.image, std::move(last_errors_), rendering.report.estimated_relmse});
  });
}

void PageFeed::try_to(const std::function<void()>& show) {
  if (failed_) return;
  try {
    show();
  } catch (const std::exception& e) {
    failed_ = true;
    log("warning: --serve: {}; the render goes on, and the page shows it no more\n", e.what());
  }
}

}  // namespace tyndall::cli
