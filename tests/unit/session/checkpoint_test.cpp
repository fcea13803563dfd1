#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "math/rng.h"
#include "support/same_pixels.h"
#include "support/sphere_scene.h"

namespace tyndall {
namespace {

const std::string kScene = test::sphere_scene(40, 36);

World world_of(const std::string& text = kScene) { return test::world_of(text, {.threads = 2}); }

RenderSettings settings_of(int spp = 8) {
  RenderSettings s;
  s.spp = spp;
  s.threads = 2;
  s.reproducible = true;
  s.aovs = {"Variance", "Z", "SampleCount"};
  return s;
}

std::string refusal(RenderJob& job, const std::string& bytes) {
  try {
    job.restore(bytes, "a.checkpoint");
  } catch (const Error& e) {
    CHECK(e.failure() == Failure::scene);
    return e.what();
  }
  return "none";
}

TEST_CASE("a job goes on from another's state as if it had been its own") {
  const World world = world_of();
  RenderJob whole(world, settings_of()), first(world, settings_of());
  whole.advance(11);
  first.advance(5);
  RenderSettings other = settings_of(100);
  other.threads = 1;
  RenderJob second(world, other);
  second.restore(first.save(), "a");
  CHECK(second.samples() == 5);
  CHECK(second.seconds() == first.seconds());
  second.advance(6);
  CHECK(test::same_bits_and_header(second.image(), whole.image()));
  CHECK(second.report().paths == whole.report().paths);
  CHECK(second.report().shadow_rays == whole.report().shadow_rays);
  CHECK(whole.report().work.vertex_lights > 0);
  for (const auto& [name, part] : kWorkParts) CHECK(second.report().work.*part == whole.report().work.*part);
}

TEST_CASE("a state of something else is refused with both values, and changes nothing") {
  const World world = world_of();
  RenderJob job(world, settings_of());
  job.advance(3);
  const Image before = job.image();
  const std::string bytes = [&] {
    RenderJob other(world, settings_of());
    other.advance(2);
    return other.save();
  }();
  const auto refused = [&](const World& w, RenderSettings s) {
    RenderJob stranger(w, s);
    return refusal(stranger, bytes);
  };
  RenderSettings s = settings_of();
  s.seed = 77;
  CHECK(refused(world, s).find("--seed 77 here") != std::string::npos);
  CHECK(refused(world, s).find("--seed 0 there") != std::string::npos);
  s = settings_of();
  s.shadow_rays = 3;
  CHECK(refused(world, s).find("options") != std::string::npos);
  s = settings_of();
  s.crop = PixelBounds{0, 0, 10, 10};
  CHECK(refused(world, s).find("crop") != std::string::npos);
  s = settings_of();
  s.aovs = {"Z"};
  CHECK(refused(world, s).find("aov") != std::string::npos);
  std::string text = kScene;
  text.replace(text.find("1 2 3"), 5, "1 2 4");
  CHECK(refused(world_of(text), settings_of()).find("another scene") != std::string::npos);

  Rng rng(1);
  int accepted = 0;
  for (int i = 0; i < 400; ++i) {
    std::string damaged = bytes;
    const auto at = static_cast<std::size_t>(rng.uniform() * static_cast<float>(bytes.size()));
    if (i % 2 == 0) damaged.resize(at);
    if (i % 2 == 1) damaged[at] = static_cast<char>(damaged[at] ^ (1 << (i / 2 % 8)));
    accepted += refusal(job, damaged) == "none" ? 1 : 0;
  }
  CHECK(accepted == 0);
  CHECK(test::same_bits_and_header(job.image(), before));
  CHECK(refusal(job, bytes) == "none");
  CHECK(job.samples() == 2);
}

TEST_CASE("a pass that is given up is undone; a first one leaves what it finished") {
  const World world = world_of();
  RenderJob job(world, settings_of());
  job.advance(2);
  const Image before = job.image();
  const std::uint64_t paths = job.report().paths;
  std::atomic<int> calls{0};
  CHECK_FALSE(job.advance(
      1, [&](double) { return ++calls < 10; }, RenderJob::GivenUp::undone));
  CHECK(test::same_bits_and_header(job.image(), before));
  CHECK(job.report().paths == paths);
  job.advance(3);
  RenderJob whole(world, settings_of());
  whole.advance(5);
  CHECK(test::same_bits_and_header(job.image(), whole.image()));

  RenderSettings one_thread = settings_of();
  one_thread.threads = 1;
  RenderJob begun(world, one_thread), full(world, one_thread);
  calls = 0;
  CHECK_FALSE(begun.advance(
      1, [&](double) { return ++calls < 8; }, RenderJob::GivenUp::undone));
  full.advance(1);
  const Image part = begun.image(), all = full.image();
  const auto &count = part.find("SampleCount")->values, &red = part.find("R")->values, &expected = all.find("R")->values;
  std::uint64_t without = 0;
  bool sound = true;
  for (std::size_t i = 0; i < red.size(); ++i) {
    without += count[i] == 0 ? 1 : 0;
    sound = sound && red[i] == (count[i] == 0 ? 0.0f : expected[i]);
  }
  CHECK(sound);
  CHECK(without == begun.report().unrendered);
  CHECK(without > 0);
  CHECK(without < red.size());
}

TEST_CASE("a stop in the first of long passes still gives a picture, soon") {
  const World world = world_of();
  RenderSettings s = settings_of(1);
  s.threads = 1;
  std::atomic<bool> stop{false};
  int calls = 0;
  const auto slow = [&](const Progress&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    if (++calls == 3) stop = true;
  };
  const Rendering r = render(world, s, {.progress = slow, .stop = &stop});
  CHECK(r.report.stopped);
  CHECK(r.report.unrendered > 0);
  CHECK(calls < 40);
}

TEST_CASE("save is called at its interval and at a stop; begin before the first pass") {
  const World world = world_of();
  std::string kept;
  int saves = 0;
  std::atomic<bool> stop{false};
  RenderControl control{.stop = &stop};
  control.save = [&](const RenderJob& job) {
    kept = job.save();
    if (++saves == 2) stop = true;
  };
  control.save_seconds = 1e-9;
  const Rendering cut = render(world, settings_of(50), control);
  CHECK(saves == 3);  // and once more at the stop
  CHECK(cut.report.samples < 50);
  RenderControl again;
  again.begin = [&](RenderJob& job) { job.restore(kept, "kept"); };
  CHECK(test::same_bits_and_header(render(world, settings_of(50), again).image, render(world, settings_of(50)).image));
}

TEST_CASE("a scene that is estimated not to fit is refused before it is built") {
  Scene scene = read_scene_text(kScene, "test.pbrt").scene;
  scene.film.width = scene.film.height = 1 << 20;
  scene.film.crop = {0, 0, 1 << 20, 1 << 20};
  CHECK_THROWS_WITH_AS(build(scene, {.max_memory = std::size_t{1} << 36}), doctest::Contains("film"), Error);
  scene.film.crop = {0, 0, 16, 16};
  CHECK_NOTHROW(build(scene, {.max_memory = std::size_t{1} << 36}));
  CHECK_THROWS_WITH_AS(build(scene, {.max_memory = 1000}), doctest::Contains("--max-memory"), Error);
}

}  // namespace
}  // namespace tyndall
