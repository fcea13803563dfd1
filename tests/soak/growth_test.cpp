/// One process that builds, renders, saves, writes and fails again and again must not grow: not in memory, not in open files,
/// not in threads or child processes. A short while per commit, an hour nightly.
#include <doctest/doctest.h>

#include <malloc.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdio>
#include <filesystem>

#include "math/process_memory.h"
#include "support/constant_vdb.h"
#include "support/measure.h"
#include "support/scene_text.h"
#include "support/scratch.h"
#include "tyndall/io.h"
#include "tyndall/render.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

constexpr Bounds3 kBox{{-1, -1, -1}, {1, 1, 1}};

std::string scene(int lights, const std::string& volume) {
  std::string text =
      view({.eye = {1.6f, 1.2f, -3.2f}, .look = {0, 0, 0}, .fov_degrees = 42, .resolution = 24, .max_depth = 4}) +
      environment(0.1f) + vdb("m", {.sigma_a = Rgb(0.3f), .sigma_s = {1, 2, 0.5f}, .g = 0.5f}, volume) +
      medium_box("m", "", kBox) + diffuse_plane(1.8f, 3, 0.6f);
  for (int i = 0; i < lights; ++i)
    text += i % 2 ? point_light({std::cos(0.7f * float(i)) * 2, std::sin(1.3f * float(i)), 1}, 1.0f / float(lights))
                  : emitting_square({std::cos(0.3f * float(i)), 1.2f, std::sin(0.3f * float(i))}, 0.01f, 1);
  return text;
}

/// A round of everything that takes something: memory, files, threads, a child that reads the volume.
void work(const std::string& text, const Scratch& folder, std::uint64_t round) {
  const World world = build(read_scene_text(text, "soak.pbrt").scene, {.lights = {LightStrategy::tree, LightStrategy::power}});
  RenderSettings settings;
  settings.spp = 2;
  settings.max_depth = 4;
  settings.seed = round;
  settings.aovs = {"Albedo", "N", "Variance"};
  const Image image = render(world, settings).image;
  write_exr(image, folder / "out.exr");
  CHECK(read_image(folder / "out.exr").width() == image.width());
  RenderJob job(world, settings), again(world, settings);
  job.advance(1);
  again.restore(job.save(), "saved");
  // What fails gives back what it took.
  CHECK_THROWS_AS(read_scene_text(text + "Shape \"sphere", "broken.pbrt"), Error);
  write_bytes(folder / "broken.vdb", "no volume");
  CHECK_THROWS_AS(build(read_scene_text(scene(3, folder / "broken.vdb"), "broken.pbrt").scene), Error);
  CHECK_THROWS_AS(write_exr(image, folder / "no/such/folder.exr"), Error);
}

struct Held {
  double megabytes, allocated;
  std::size_t files, threads;
  bool children;
};

std::size_t entries(const char* folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

Held held() {
  malloc_trim(0);
  return {static_cast<double>(process_memory().resident) * 1e-6,
          static_cast<double>(mallinfo2().uordblks + mallinfo2().hblkhd) * 1e-6, entries("/proc/self/fd"),
          entries("/proc/self/task"), waitpid(-1, nullptr, WNOHANG) >= 0};
}

}  // namespace

TEST_CASE("many builds and renders in one process do not grow it") {
  const Scratch folder;
  const ConstantVdb volume(kBox, 0.1f);
  const std::string text = scene(nightly() ? 20'000 : 2'000, volume.path());
  const int warm_up = 12, rounds = nightly() ? 1'000'000 : 36;
  const double seconds = nightly() ? 3600 : 1e9;
  Held before{};
  const auto start = std::chrono::steady_clock::now();
  int round = 0;
  for (; round < rounds + warm_up; ++round) {
    if (round == warm_up) before = held();
    work(text, folder, static_cast<std::uint64_t>(round));
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > seconds) break;
  }
  REQUIRE(round > warm_up);
  const Held after = held();
  std::printf("  %d rounds: resident %.1f -> %.1f MB, allocated %.2f -> %.2f MB, files %zu -> %zu, threads %zu -> %zu\n",
              round - warm_up, before.megabytes, after.megabytes, before.allocated, after.allocated, before.files, after.files,
              before.threads, after.threads);
  CHECK(after.megabytes < 1.01 * before.megabytes + 2);
  CHECK(after.allocated < 1.01 * before.allocated + 0.1);
  CHECK(after.files == before.files);
  CHECK(after.threads <= before.threads);
  CHECK_FALSE(after.children);
}
