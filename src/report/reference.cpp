#include "report/reference.h"

#include <algorithm>
#include <cmath>

#include "tyndall/error.h"
#include "tyndall/image_attributes.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

constexpr int kFewestSamples = 16;  ///< of a reference, whatever time it has: its variance must mean something

/// `seeds` is a list of numbers with anything in between.
bool names_seed(const std::string& seeds, const std::string& seed) {
  const auto digit = [&](std::size_t i) { return i < seeds.size() && seeds[i] >= '0' && seeds[i] <= '9'; };
  for (std::size_t at = seeds.find(seed); at != std::string::npos; at = seeds.find(seed, at + 1)) {
    if ((at == 0 || !digit(at - 1)) && !digit(at + seed.size())) return true;
  }
  return false;
}

/// Throws Error (scene) that names `path` unless R, G and B are there and finite.
void require_sound(const Image& image, const std::string& path) {
  for (const char* name : {"R", "G", "B"}) {
    const Channel* channel = image.find(name);
    if (!channel) throw Error(Failure::scene, path + ": has no channel " + name + "; a reference needs R, G and B");
    for (std::size_t i = 0; i < channel->values.size(); ++i) {
      if (std::isfinite(channel->values[i])) continue;
      const auto width = static_cast<std::size_t>(image.width());
      throw Error(Failure::scene, path + ": " + name + " is not finite at pixel (" + std::to_string(i % width) + ", " +
                                      std::to_string(i / width) + "); choose a sound reference");
    }
  }
}

}  // namespace

ErrorMetrics Reference::error_of(const Image& picture) const {
  return has_variance ? measure_error_without_noise(picture, image) : measure_error(picture, image);
}

void Reference::require_fit(const World& world, const RenderSettings& settings, const std::vector<std::uint64_t>& seeds) const {
  const PixelBounds pixels = RenderJob(world, settings).pixels();
  const bool of_ours = image.attributes.contains(attributes::kSceneHash);
  if (image.width() != pixels.width() || image.height() != pixels.height() || (of_ours && !(image.data == pixels))) {
    refuse("has the pixels " + crop_text(image.data) + " where the render has " + crop_text(pixels) +
           "; give the reference's --resolution and --crop");
  }
  const auto* hash = image.attribute<std::string>(attributes::kSceneHash);
  if (hash && *hash != world.scene_hash(settings)) {
    refuse("is of another scene (" + *hash + ", this one is " + world.scene_hash(settings) +
           "); render it from this scene with the same --max-depth");
  }
  for (const std::uint64_t s : seeds) {
    if (names_seed(seed, std::to_string(s))) {
      refuse("was rendered with seed " + std::to_string(s) + ", which is among those to be measured; use another --seed");
    }
  }
}

void Reference::refuse(const std::string& why) const { throw Error(Failure::scene, source + ": " + why); }

Reference read_reference(const std::string& path) { return as_reference(read_image(path), path); }

Reference as_reference(Image image, const std::string& source) {
  Reference r;
  r.image = std::move(image);
  r.source = source;
  require_sound(r.image, source);
  r.has_variance = has_variances(r.image);
  if (const int* samples = r.image.attribute<int>(attributes::kSamples)) r.samples = *samples;
  if (const auto* seed = r.image.attribute<std::string>(attributes::kSeed)) r.seed = *seed;
  r.has_variance = r.has_variance && r.samples != 1;  // one sample says nothing of its variance
  if (r.has_variance) r.relmse = relmse_by_variances(r.image);
  return r;
}

Reference render_reference(const World& world, RenderSettings settings, const ReferenceGoal& goal,
                           const RenderControl& control) {
  settings.aovs = {"Variance"};
  settings.error = goal.relmse;
  settings.error_max.reset();
  settings.adaptive = false;  // all pixels are to be as good
  settings.spp = goal.samples;
  settings.time.reset();
  if (std::isfinite(goal.seconds)) settings.time = goal.seconds;
  Rendering rendering = render(world, settings, control);
  if (rendering.report.samples < kFewestSamples && !rendering.report.stopped) {
    settings.time.reset();
    settings.spp = std::min(kFewestSamples, goal.samples);
    rendering = render(world, settings, control);
  }
  Reference r;
  r.image = std::move(rendering.image);
  r.source = "rendered";
  r.stopped = rendering.report.stopped;
  r.has_variance = rendering.report.samples != 1;
  r.samples = rendering.report.samples;
  r.seed = std::to_string(settings.seed);
  r.seconds = rendering.report.seconds;
  if (r.has_variance) r.relmse = relmse_by_variances(r.image);
  return r;
}

}  // namespace tyndall
