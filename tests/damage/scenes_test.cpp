/// Damaged scene files: read, built and rendered, or refused in one line.
#include <doctest/doctest.h>

#include <algorithm>

#include "support/damage.h"
#include "support/scratch.h"
#include "tyndall/io.h"
#include "tyndall/render.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

const std::string kSuite = TYNDALL_SOURCE_DIR "/tests/regression/suite/";

/// A few pixels from the middle, one sample.
RenderSettings a_glance(const Scene& scene) {
  RenderSettings settings = scene.settings;
  const int x = scene.film.width / 2, y = scene.film.height / 2;
  settings.crop = PixelBounds{x, y, x + 2, y + 2};
  settings.spp = 1;
  settings.max_depth = std::min(settings.max_depth, 3);
  settings.threads = 1;
  settings.time = settings.error = std::nullopt;
  return settings;
}

/// Coefficients so large that a walk through them takes its millions of steps, as it should, and this test with it.
bool too_thick(const Scene& scene) {
  constexpr float kMost = 1e4f;
  const auto any = [](const std::vector<Rgb>& values) {
    return std::any_of(values.begin(), values.end(), [](Rgb v) { return max_component(v) > kMost; });
  };
  for (const Medium& medium : scene.media) {
    if (max_component(medium.optics.sigma_a + medium.optics.sigma_s) > kMost) return true;
    if (const auto* grid = std::get_if<UniformGridMedium>(&medium.kind)) {
      if (std::any_of(grid->density.begin(), grid->density.end(), [](float v) { return v > kMost; })) return true;
    }
    if (const auto* cloud = std::get_if<CloudMedium>(&medium.kind); cloud && cloud->density > kMost) return true;
    const auto* grid = std::get_if<RgbGridMedium>(&medium.kind);
    if (grid && (grid->scale > kMost || any(grid->sigma_a) || any(grid->sigma_s))) return true;
  }
  return false;
}

void read_and_render(const std::string& path) {
  // Assets lie beside the seed, not beside the mutant.
  SceneFile file = read_scene_text(read_bytes(path), path, kSuite);
  if (file.scene.film.width < 4 || file.scene.film.height < 4) return;
  const RenderSettings settings = a_glance(file.scene);
  const bool look = !too_thick(file.scene);
  const World world = build(std::move(file.scene), {.lights = {settings.lights}, .threads = 1});
  if (look) render(world, settings);
}

}  // namespace

TEST_CASE("damaged scenes") {
  std::vector<std::string> seeds;
  for (const char* name : {"bsdf_coated", "boundary_instances", "light_area", "light_sky_equal_area", "medium_rgbgrid",
                           "medium_temperature", "medium_nested", "shapes", "textures", "medium_cloud"})
    seeds.push_back(kSuite + name + ".pbrt");
  for (const std::string& seed : seeds) read_and_render(seed);
  const Verdict verdict = read_mutants(seeds, read_and_render, /*text=*/true);
  MESSAGE(verdict.str());
  CHECK(verdict.complaints.empty());
}
