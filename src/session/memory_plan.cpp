#include "session/memory_plan.h"

#include <algorithm>
#include <cstdio>

#include "math/process_memory.h"
#include "session/deep_layout.h"
#include "session/film_buffer.h"
#include "session/slice.h"
#include "transport/planned_memory.h"
#include "transport/world/light_groups.h"
#include "tyndall/cryptomatte.h"
#include "tyndall/deep_image.h"
#include "tyndall/error.h"
#include "tyndall/lights.h"

namespace tyndall {
namespace {

/// Bytes a pixel of what is kept by keys, and of the images made of it: of mattes, about four ids in each layer; of depth,
/// light in every bin of the media, or where there are none of a few surfaces.
double plan_keyed(const Scene& scene) {
  const RenderSettings& settings = scene.settings;
  constexpr double kSum = sizeof(double) + sizeof(float), kKey = sizeof(std::uint32_t), kList = 40;
  const auto& aovs = settings.aovs;
  const auto layers = static_cast<double>(std::count_if(aovs.begin(), aovs.end(), is_matte_layer));
  double bytes = layers * (kList + 4 * (kKey + kSum) + 2 * 2 * kMatteRanks * sizeof(float));
  const int places = scene.media.empty() ? 4 : settings.deep_bins.value_or(0) + 2;
  if (settings.deep_bins) bytes += kList + places * (kKey + kSumsOfDepth * kSum + 2 * sizeof(DeepPixelSample));
  return bytes;
}

std::size_t plan_film(const Scene& scene) {
  const double pixels = pixels_of(scene);
  const FilmNumbers film = film_numbers(scene);
  const auto sums = static_cast<double>(film.sums), channels = static_cast<double>(film.channels);
  ByteCount sum;
  sum.add(pixels, 2 * (sizeof(double) + sizeof(float)) * sums);         // twice: a long pass keeps a copy to undo it
  sum.add(pixels, 2 * sizeof(float) * channels);                        // the image, and its encoding
  if (scene.settings.slice) sum.add(pixels, 3 * sizeof(float) * sums);  // its sums
  sum.add(pixels, plan_keyed(scene));
  return sum.bytes();
}

std::string gigabytes(std::size_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, bytes < 1'000'000'000 ? "%.3f" : "%.1f", static_cast<double>(bytes) * 1e-9);
  return text;
}

}  // namespace

std::size_t MemoryPlan::total() const {
  std::size_t sum = in_use;
  for (const auto& part : parts) sum += std::min(part.second, SIZE_MAX - sum);
  return sum;
}

std::string MemoryPlan::str() const {
  std::string text = "in use " + gigabytes(in_use);
  for (const auto& [what, bytes] : parts) text += ", " + what + " " + gigabytes(bytes);
  return text;
}

FilmNumbers film_numbers(const Scene& scene) {
  std::vector<std::string> groups = named_light_groups(scene);
  if (!groups.empty()) groups.emplace_back(kUngrouped);
  const FilmBuffer::Extras extras{film_aovs(scene.settings), std::move(groups)};
  return {FilmBuffer::sums_of_pixel(extras), FilmBuffer::channels_of_image(extras)};
}

MemoryPlan plan_memory(const Scene& scene, std::span<const LightStrategy> lights, KeptFiles* kept) {
  const PlannedMemory built = plan_built_world(scene, lights, kept);
  return {process_memory().resident,
          {{"film", plan_film(scene) + built.on_film},
           {"geometry", built.geometry},
           {"lights", built.lights},
           {"textures", built.textures},
           {"volumes", built.volumes}}};
}

void require_memory(const MemoryPlan& plan, const Scene& scene, std::size_t limit) {
  if (plan.total() <= limit) return;
  throw Error(Failure::scene, (scene.source.empty() ? "the scene" : scene.source) + ": is estimated to need " +
                                  gigabytes(plan.total()) + " GB of memory (" + plan.str() + "), more than the limit of " +
                                  gigabytes(limit) + "; make it smaller, or set --max-memory");
}

std::size_t left_for_volumes(const MemoryPlan& plan, std::size_t limit) { return limit - std::min(plan.total(), limit); }

}  // namespace tyndall
