#include "report/reference.h"

#include <cmath>

#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

template <typename T>
const T* attribute(const Image& image, const std::string& name) {
  const auto it = image.attributes.find(name);
  return it == image.attributes.end() ? nullptr : std::get_if<T>(&it->second);
}

}  // namespace

ErrorMetrics Reference::error_of(const Image& picture) const {
  return has_variance ? measure_error_without_noise(picture, image) : measure_error(picture, image);
}

void Reference::require_size(const PixelBounds& pixels) const {
  if (image.width() == pixels.width() && image.height() == pixels.height()) return;
  throw Error(Failure::usage, source + ": has " + std::to_string(image.width()) + "x" + std::to_string(image.height()) +
                                  " pixels where the render has " + std::to_string(pixels.width()) + "x" +
                                  std::to_string(pixels.height()) + "; give the reference's --resolution and --crop");
}

Reference read_reference(const std::string& path) {
  Reference r;
  r.image = read_image(path);
  r.source = path;
  for (const char* name : {"R", "G", "B"}) required_channel(r.image, name);
  r.has_variance = r.image.find("Variance.R") && r.image.find("Variance.G") && r.image.find("Variance.B");
  if (const int* samples = attribute<int>(r.image, "tyndall/samples")) r.samples = *samples;
  if (const auto* seed = attribute<std::string>(r.image, "tyndall/seed")) r.seed = *seed;
  if (r.has_variance) r.relmse = estimated_relmse(r.image);
  return r;
}

Reference render_reference(const World& world, RenderSettings settings, const ReferenceGoal& goal,
                           const std::function<void(const Progress&)>& progress) {
  settings.aovs = {"Variance"};
  settings.error = goal.relmse;
  settings.spp = goal.samples;
  settings.time.reset();
  if (std::isfinite(goal.seconds)) settings.time = goal.seconds;
  Rendering rendering = render(world, settings, {.progress = progress});
  Reference r;
  r.image = std::move(rendering.image);
  r.source = "rendered";
  r.has_variance = true;
  r.samples = rendering.report.samples;
  r.seed = std::to_string(settings.seed);
  r.seconds = rendering.report.seconds;
  r.relmse = estimated_relmse(r.image);
  return r;
}

}  // namespace tyndall
