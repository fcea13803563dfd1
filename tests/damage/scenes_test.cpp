/// Damaged scene files: read, built and rendered, or refused in one line.
#include <doctest/doctest.h>

#include <filesystem>

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

void read_and_render(const std::string& path) {
  // Assets lie beside the seed, not beside the mutant.
  SceneFile file = read_scene_text(read_bytes(path), path, kSuite);
  if (file.scene.film.width < 4 || file.scene.film.height < 4) return;
  const RenderSettings settings = a_glance(file.scene);
  const World world = build(std::move(file.scene), {.lights = {settings.lights}, .threads = 1});
  render(world, settings);
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
