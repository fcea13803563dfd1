#include "cli/picture_render.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <sstream>

#include "cli/log.h"
#include "cli/output_paths.h"
#include "cli/room.h"
#include "cli/save.h"
#include "cli/stop_signal.h"
#include "session/image_header.h"
#include "session/rendered_pixels.h"
#include "session/scene_hash.h"
#include "tyndall/cryptomatte.h"
#include "tyndall/image_attributes.h"
#include "tyndall/io.h"
#include "tyndall/memory.h"
#include "tyndall/slice.h"
#include "tyndall/timer.h"

namespace tyndall::cli {
namespace {

namespace fs = std::filesystem;

/// Before anything is built: whether what comes out of it can be written.
void check_outputs(const RenderOptions& options, const Scene& scene, const std::string& output) {
  check_writable(output, "-o");
  require_room(output, scene, options.keeps_checkpoints());
  if (!options.error_log.empty()) check_writable(options.error_log, "--error-log");
  if (!options.deep.empty()) check_writable(options.deep, "--deep");
}

/// What the denoiser takes is not the render's.
std::size_t memory_for_render(const RenderOptions& options, const Scene& scene) {
  const std::size_t limit = memory_limit(options.max_memory);
  if (!options.denoise) return limit;
  return limit - std::min(limit, denoise_memory(pixels_of(scene)));
}

template <typename T>
bool says(const Image& header, const std::string& attribute, const T& value) {
  const T* said = header.attribute<T>(attribute);
  return said && *said == value;
}

/// What a setting leaves open stands in the header as the render chose it.
bool says_options(const Image& header, const RenderSettings& settings) {
  const auto* text = header.attribute<std::string>(attributes::kOptions);
  if (!text) return false;
  std::istringstream asked(options_text(settings)), rendered(*text);
  std::string word, other;
  while (asked >> word)
    if (!(rendered >> other) || (word != other && word != "auto")) return false;
  return !(rendered >> other);
}

}  // namespace

PictureRender::PictureRender(const RenderOptions& options, Scene& scene, LivePage* page)
    : options_(options), checkpoint_(std::string()) {
  apply(options, scene);
  require_end(scene.settings);
  asked_aovs_ = scene.settings.aovs;
  if (options.denoise) denoiser_.emplace(options, scene.settings);
  settings_ = scene.settings;
  limit_image_threads(settings_.threads);
  output_ = output_path(options, scene);
  checkpoint_ = CheckpointFile(output_);
  if (options.keeps_checkpoints()) checkpoint_.tidy();
  check_outputs(options, scene, output_);
  pixels_ = rendered_pixels(scene, settings_);
  memory_ = memory_for_render(options, scene);
  if (!options.reference.empty()) reference_ = read_reference(options.reference);
  if (page) page_.emplace(*page, denoiser_ ? &*denoiser_ : nullptr);
  if (!options.display.empty()) viewer_ = std::make_unique<ViewerLink>(options.display, output_);
}

bool PictureRender::holds_all_channels(const Image& header) const {
  const auto holds = [&](const std::string& name) {
    return std::any_of(header.channels.begin(), header.channels.end(),
                       [&](const Channel& c) { return c.name == name || c.name.starts_with(name + "."); }) ||
           has_mattes(header, name);
  };
  return std::all_of(asked_aovs_.begin(), asked_aovs_.end(), holds) && options_.denoise == holds("noisy");
}

/// Whether the deep image stands beside it that was asked for.
bool PictureRender::holds_deep(const Image& header) const {
  if (options_.deep.empty()) return true;
  std::error_code absent;
  return fs::exists(options_.deep, absent) && is_deep_exr(options_.deep) &&
         says(header, attributes::kDeepBins, *settings_.deep_bins);
}

/// Its mattes go by the names of the scene.
bool PictureRender::holds_names(const Image& header, std::uint64_t names) const {
  const auto& aovs = settings_.aovs;
  return std::none_of(aovs.begin(), aovs.end(), is_matte_layer) || says(header, attributes::kMatteNames, std::to_string(names));
}

bool PictureRender::is_finished(const SceneHashes& of) const {
  std::error_code absent;
  if (settings_.slice || !fs::exists(output_, absent) || fs::exists(checkpoint_.path(), absent)) return false;
  try {
    const Image header = read_exr_header(output_);
    const bool open_end = settings_.time || settings_.error || settings_.error_max;  // it ended where these say
    return says(header, attributes::kSceneHash, scene_hash_text(of.scene, settings_)) &&
           says(header, attributes::kSeed, std::to_string(settings_.seed)) && says_options(header, settings_) &&
           !header.attributes.contains(attributes::kStopped) && !header.attributes.contains(attributes::kRelight) &&
           (open_end || says(header, attributes::kSamples, settings_.spp)) && says_end(header, settings_) &&
           header.data == pixels_ && holds_all_channels(header) && holds_names(header, of.names) && holds_deep(header);
  } catch (const Error&) {
    return false;  // damaged, or no .exr: it is rendered anew
  }
}

World PictureRender::build(Scene scene, KeptFiles* kept) const {
  const BuildSettings how{.lights = {settings_.lights},
                          .volume_lights = settings_.emission != EmissionStrategy::paths,
                          .sanitize = options_.picture.sanitize,
                          .threads = settings_.threads,
                          .max_memory = memory_,
                          .kept = kept};
  return tyndall::build(std::move(scene), how);
}

/// What was rendered before need not be rendered again: an array of jobs can be submitted as often as you like.
bool PictureRender::is_slice_there(const World& world) const {
  std::error_code absent;
  if (!options_.resume || !settings_.slice || !fs::exists(output_, absent)) return false;
  try {
    const Image image = read_image(output_);
    return holds_deep(image) && holds_slice(image, world, settings_);
  } catch (const Error&) {
    return false;  // damaged: it is rendered anew
  }
}

/// At 1, 2, 4 ... samples.
void PictureRender::look_at(const RenderJob& job) {
  if (errors_) errors_->add(job);
  if (denoiser_) denoiser_->preview(job, output_);
  if (viewer_) viewer_->show(job.image());
}

void PictureRender::resume(RenderJob& job) {
  const bool found = checkpoint_.resume(job, settings_);
  if (found && errors_) errors_->resume(job.samples());
  if (options_.quiet) return;
  if (found) log("{}: going on from {} samples a pixel\n", checkpoint_.path(), job.samples());
  if (!found && options_.frames.empty()) log("{}: no such file; starting at the beginning\n", checkpoint_.path());
}

Rendering PictureRender::render_with(const World& world, const std::function<void(const Progress&)>& progress) {
  RenderControl control{.progress = progress, .stop = &stop_requested()};
  const bool previews = denoiser_ && denoiser_->previews();
  if (errors_ || previews || viewer_) control.checkpoint = [&](const RenderJob& job) { look_at(job); };
  if (page_) page_->join(control);
  if (options_.resume) control.begin = [&](RenderJob& job) { resume(job); };
  if (options_.keeps_checkpoints()) control.save = [&](const RenderJob& job) { checkpoint_.save(job); };
  // --resume alone: at a stop
  control.save_seconds = options_.checkpoint.value_or(std::numeric_limits<double>::infinity());
  Rendering rendering = render(world, settings_, control);
  if (errors_) errors_->finish(rendering);
  return rendering;
}

/// A slice says how it was made, so that the command for others can be told; one of a picture that is not all there is none.
void PictureRender::finish_slice(Rendering& rendering, const std::string& command_line) const {
  if (rendering.report.unrendered > 0)
    throw Error(Failure::incomplete, output_ + ": not written: the slice was stopped before every pixel had a sample");
  rendering.image.attributes[attributes::kCommand] = command_line;
}

/// A render that was stopped at its first sample stays as it is.
std::optional<DenoiseReport> PictureRender::denoise_finished(Rendering& rendering) const {
  if (rendering.report.samples > 1) return denoiser_->finish(rendering.image);
  log("{}: is not denoised: it has one sample a pixel, and noise is told from two\n", output_);
  return std::nullopt;
}

/// A render that is complete needs its checkpoint no longer than until the image is safe, and the room it takes least of all.
void PictureRender::save(const Rendering& rendering) const {
  std::function<void()> remove_checkpoint;
  if (options_.keeps_checkpoints() && !rendering.report.stopped) remove_checkpoint = [&] { checkpoint_.remove(); };
  save_image(rendering.image, output_, image_format(options_.image, output_), remove_checkpoint);
  if (rendering.deep) save_deep_image(*rendering.deep, options_.deep);
  if (remove_checkpoint) remove_checkpoint();
}

void PictureRender::require_log_written() const {
  if (errors_) errors_->require_written();
}

std::optional<Summary> PictureRender::run(const World& world, const std::string& command_line,
                                          const std::function<void(const Progress&)>& progress) {
  if (reference_) reference_->require_fit(world, settings_, {settings_.seed});
  if (reference_) errors_.emplace(std::move(*reference_), options_.error_log);
  if (page_) page_->begin("rendering", output_);
  Rendering rendering = render_with(world, progress);
  if (settings_.slice) finish_slice(rendering, command_line);
  if (rendering.report.unrendered == rendering.image.data.size()) {
    log("{}: not written: stopped before any pixel had a sample\n", output_);
    return std::nullopt;
  }
  Summary summary;
  summary.output = output_;
  summary.render = rendering.report;
  summary.width = rendering.image.width();
  summary.height = rendering.image.height();
  if (denoiser_ && page_) page_->begin("denoising", output_);
  if (denoiser_) summary.denoised = denoise_finished(rendering);
  if (viewer_) viewer_->show(rendering.image);
  if (page_) page_->show(rendering);
  if (page_) page_->begin("writing", output_);
  Timer watch;
  save(rendering);
  summary.write_seconds = watch.lap();
  return summary;
}

}  // namespace tyndall::cli
