#include "cli/denoiser.h"

#include <algorithm>
#include <set>

#include "cli/log.h"
#include "cli/save.h"
#include "tyndall/cryptomatte.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall::cli {
namespace {

/// Fewer samples show more blotches than picture.
constexpr int kFirstPreview = 4;

const std::string kReplicate = "Replicate.";

/// "Albedo.R" is of Albedo, "SurfaceCount" of Z and P.
bool is_of(const std::string& channel, const std::string& aov) {
  if (channel == aov || channel.starts_with(aov + ".")) return true;
  if (is_matte_channel(channel) && channel.starts_with(aov)) return true;
  return (channel == "SurfaceCount" && (aov == "Z" || aov == "P")) || (channel == "VolumeCount" && aov == "Zvol");
}

bool is_kept(const std::string& channel, const std::vector<std::string>& asked) {
  static const std::set<std::string> always{"R", "G", "B", "A"};
  const auto asked_for = [&](const std::string& name) {
    return always.contains(name) || std::any_of(asked.begin(), asked.end(), [&](const auto& aov) { return is_of(name, aov); });
  };
  if (!channel.starts_with(kReplicate))
    return channel.starts_with("noisy.") || channel.starts_with("Mse.") || channel.starts_with("LightGroup.") ||
           asked_for(channel);
  const std::string name = channel.substr(kReplicate.size());
  return std::find(asked.begin(), asked.end(), "Replicate") != asked.end() &&
         (name == "SampleCount" || name.starts_with("LightGroup.") || asked_for(name));
}

}  // namespace

Denoiser::Denoiser(const RenderOptions& options, RenderSettings& settings)
    : image_(options.image),
      asked_(settings.aovs),
      threads_(settings.threads),
      preview_every_(options.preview_every.value_or(std::numeric_limits<double>::infinity())) {
  if (settings.slice)
    throw Error(Failure::usage,
                "--denoise takes all slices together; render them with --aov Denoise and denoise what tyndall "
                "merge makes of them");
  if (settings.spp == 1)
    throw Error(Failure::usage, "--denoise needs two samples a pixel, to tell noise from picture; give --spp 2 or more");
  const auto needed = denoise_aovs();
  settings.aovs.insert(settings.aovs.end(), needed.begin(), needed.end());
}

DenoiseReport Denoiser::finish(Image& image) const {
  Denoised denoised = denoise(image, {.threads = threads_});
  image = std::move(denoised.image);
  std::erase_if(image.channels, [&](const Channel& c) { return !is_kept(c.name, asked_); });
  return denoised.report;
}

void Denoiser::preview(const RenderJob& job, const std::string& output) {
  if (job.samples() < kFirstPreview || since_preview_.seconds() < preview_every_) return;
  try {
    Image image = job.image();
    finish(image);
    write_image(image, output, image_format(image_, output));
    failure_.clear();
  } catch (const std::exception& e) {
    if (failure_ != e.what()) log("warning: {}; the render goes on without this preview\n", e.what());
    failure_ = e.what();
  }
  since_preview_ = {};
}

}  // namespace tyndall::cli
