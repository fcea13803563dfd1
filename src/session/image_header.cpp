#include "session/image_header.h"

#include <algorithm>
#include <charconv>
#include <ctime>

#include "session/resolved_settings.h"
#include "session/scene_hash.h"
#include "transport/sharing/suffix_reuse.h"
#include "tyndall/cryptomatte.h"
#include "tyndall/image_attributes.h"
#include "tyndall/version.h"

namespace tyndall {

namespace {

/// The shortest decimal number that is read back as `value`.
template <typename Number>
std::string exact(Number value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

std::string options_text(const RenderSettings& settings) {
  std::string text = "--max-depth " + std::to_string(settings.max_depth);
  for (const StrategyAxis& axis : strategy_axes()) {
    text += " --" + std::string(axis.option) + " " + std::string(axis.get(settings));
  }
  if (settings.candidates) text += " --candidates " + std::to_string(*settings.candidates);
  if (settings.splitting) text += " --splitting " + exact(*settings.splitting);
  if (settings.shadow_rays) text += " --shadow-rays " + std::to_string(*settings.shadow_rays);
  if (is_adaptive(settings)) text += " --adaptive";
  return text;
}

std::string end_text(const RenderSettings& settings) {
  std::string text;
  const auto add = [&](const char* option, const std::optional<double>& value) {
    if (value) text += (text.empty() ? "" : " ") + std::string(option) + " " + exact(*value);
  };
  add("--time", settings.time);
  add("--error", settings.error);
  add("--error-max", settings.error_max);
  if (!text.empty() && settings.spp <= kMostSamples) text += " --spp " + std::to_string(settings.spp);
  return text;
}

bool says_end(const Image& image, const RenderSettings& settings) {
  const auto* text = image.attribute<std::string>(attributes::kEnd);
  return (text ? *text : "") == end_text(settings);
}

std::string plan_text(const RenderSettings& settings) {
  std::string text = " --spp " + std::to_string(settings.spp);
  if (!settings.error_max) return text;
  text += " --error-max " + exact(*settings.error_max);
  return settings.error ? text + " --error " + exact(*settings.error) : text;
}

namespace {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::string joined(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ",") + name;
  return list;
}

}  // namespace

std::string_view version() { return kVersion; }

void write_header(Image& image, const World::Parts& world, const RenderSettings& settings, const RenderReport& report) {
  auto& a = image.attributes;
  a["worldToCamera"] = world.user_camera.world_to_camera();
  if (world.user_camera.has_projection()) a["worldToNDC"] = world.user_camera.world_to_ndc();
  a[attributes::kSoftware] = "Tyndall " + std::string(kVersion);
  a[attributes::kScene] = world.built.scene.source;
  a[attributes::kSceneHash] = scene_hash_text(world.scene_hash, settings);
  if (report.least_samples == report.most_samples) {
    a[attributes::kSamples] = report.samples;
  } else {
    a[attributes::kSamples] = std::to_string(report.least_samples) + ".." + std::to_string(report.most_samples);
  }
  a[attributes::kSeed] = std::to_string(settings.seed);  // 64 bits do not fit an EXR integer
  a[attributes::kOptions] = options_text(settings);
  if (const std::string end = end_text(settings); !end.empty()) a[attributes::kEnd] = end;
  if (std::any_of(settings.aovs.begin(), settings.aovs.end(), is_matte_layer))
    a[attributes::kMatteNames] = std::to_string(hash_names(world.built.scene));
  if (settings.deep_bins) a[attributes::kDeepBins] = *settings.deep_bins;
  if (!world.built.light_groups.empty()) a[attributes::kLightGroups] = joined(world.built.light_groups.names());
  if (settings.reuse == ReuseStrategy::pixels) a[attributes::kSharing] = static_cast<int>(kMostSharing);
  if (settings.reproducible) return;
  a[attributes::kRenderTime] = report.seconds;
  a[attributes::kDate] = utc_now();
}

}  // namespace tyndall
