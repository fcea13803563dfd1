#include <doctest/doctest.h>
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "support/same_pixels.h"
#include "support/sphere_scene.h"

namespace tyndall {
namespace {

World world_of(std::vector<LightStrategy> strategies = {LightStrategy::tree}) {
  return test::world_of(test::sphere_scene(24, 16), {.lights = std::move(strategies), .threads = 1});
}

RenderSettings settings_of(int spp) {
  RenderSettings s;
  s.spp = spp;
  s.threads = 1;
  s.reproducible = true;
  s.aovs = {"Variance"};
  return s;
}

TEST_CASE("a job gives the same picture however it is advanced, and the one that render() gives") {
  const World world = world_of();
  RenderJob one(world, settings_of(1)), many(world, settings_of(1));
  one.advance(11);
  for (const int n : {1, 3, 2, 5}) many.advance(n);
  CHECK(one.samples() == 11);
  CHECK(test::same_bits(one.image(), many.image()));
  CHECK(test::same_bits(one.image(), render(world, settings_of(11)).image));
  CHECK(one.seconds() > 0);
  CHECK(one.report().paths == many.report().paths);
}

TEST_CASE("shares of a render's work are of what it did, and add up to all of it") {
  const World world = world_of();
  RenderSettings settings = settings_of(1);
  settings.reuse = ReuseStrategy::off;
  RenderJob job(world, settings);
  const auto sum = [&] {
    double all = 0;
    for (const auto& [name, part] : kWorkParts) all += job.report().work.*part;
    return all;
  };
  CHECK(sum() == 0);
  job.advance(2);
  CHECK(sum() == doctest::Approx(1));
  const WorkParts work = job.report().work;
  CHECK(work.paths > 0.1);
  CHECK(work.vertex_lights > 0.01);
  CHECK(work.shadow_rays > 0.01);
  for (const double none : {work.media, work.segment_lights, work.sharing, work.guiding}) CHECK(none == 0);
}

TEST_CASE("a path that scatters between a boundary and a surface right behind it keeps its place") {
  // The gap is less than the surface's place is known to, for its size. Who scatters in it is on the wrong side of the
  // boundary, enters the medium a second time on the way back, and never leaves it.
  constexpr const char* kSlab = R"(
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
LookAt 0 0 .05 0 0 0 0 1 0
Camera "orthographic" "float screenwindow" [-.1 .1 -.1 .1]
Integrator "volpath" "integer maxdepth" 1000
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
MakeNamedMedium "m" "string type" "homogeneous" "rgb sigma_a" [0 0 0] "rgb sigma_s" [1 1 1]
AttributeBegin
MediumInterface "m" ""
Material "interface"
Shape "trianglemesh" "integer indices" [0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 4 3 4 7]
 "point3 P" [-200 -200 -1 200 -200 -1 200 200 -1 -200 200 -1 -200 -200 0 200 -200 0 200 200 0 -200 200 0]
AttributeEnd
Material "diffuse" "rgb reflectance" [0 0 0]
Shape "trianglemesh" "point3 P" [-3000 -3000 -1.001 3000 -3000 -1.001 3000 3000 -1.001 -3000 3000 -1.001] "integer indices" [0 1 2 0 2 3]
)";
  const World world = build(read_scene_text(kSlab, "slab.pbrt").scene, {.threads = 1});
  RenderJob job(world, settings_of(1));
  job.advance(64);
  CHECK(job.report().rays > 10'000);
  CHECK(job.report().parity_errors == 0);
}

TEST_CASE("a pass can be given up") {
  const World world = world_of();
  RenderJob job(world, settings_of(1));
  CHECK(job.advance(1));
  int calls = 0;
  CHECK_FALSE(job.advance(1, [&](double) { return ++calls < 2; }));
  CHECK(calls == 2);
  CHECK(job.samples() == 1);
}

TEST_CASE("denormals are flushed alike on every thread, and the caller's mode stays as it was") {
  constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
  const World world = world_of();
  RenderSettings s = settings_of(1);
  s.threads = 2;
  RenderJob job(world, s);
  const unsigned before = _mm_getcsr();
  std::atomic<int> calls{0}, flushed{0};
  job.advance(4, [&](double samples) {
    if (samples == 0) return true;  // before the first
    ++calls;
    if ((_mm_getcsr() & kFlushToZero) && (_mm_getcsr() & kDenormalsAreZero)) ++flushed;
    return true;
  });
  CHECK(calls > 0);
  CHECK(flushed == calls);
  CHECK((_mm_getcsr() & (kFlushToZero | kDenormalsAreZero)) == (before & (kFlushToZero | kDenormalsAreZero)));
}

TEST_CASE("the estimated error is what the variance channels say") {
  const World world = world_of();
  RenderJob job(world, settings_of(1));
  job.advance(1);
  CHECK(std::isinf(job.estimated_relmse()));
  job.advance(7);
  const Image image = job.image();
  // As the equation has it: a pixel's square leans on the mean of those around it in its block as far as its noise explains how
  // it differs from them.
  const int width = image.width();
  double expected = 0;
  for (const std::string k : {"R", "G", "B"}) {
    const auto &mean = image.find(k)->values, &variance = image.find("Variance." + k)->values;
    const auto square_of = [&](std::size_t i) { return double{mean[i]} * mean[i] - variance[i]; };
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
      double means = 0, squares = 0, count = 0;
      for (std::size_t j = 0; j < mean.size(); ++j) {
        const int u = static_cast<int>(j) % width, v = static_cast<int>(j) / width;
        if (i == j || std::abs(u - x) > 1 || std::abs(v - y) > 1 || u / 8 != x / 8 || v / 8 != y / 8) continue;
        means += mean[j], squares += square_of(j), ++count;
      }
      const double off = mean[i] - means / count, doubt = variance[i] > 0 ? std::min(1.0, variance[i] / (off * off)) : 0;
      const double square = (1 - doubt) * square_of(i) + doubt * squares / count;
      expected += variance[i] / (std::max(square, 0.0) + 0.01) / (3.0 * static_cast<double>(mean.size()));
    }
  }
  CHECK(expected > 0);
  CHECK(job.estimated_relmse() / expected == doctest::Approx(1).epsilon(1e-4));
}

TEST_CASE("estimated errors are those of blocks, and the worst of them is the report's") {
  const World world = world_of();
  RenderJob job(world, settings_of(1));
  job.advance(1);
  CHECK(job.estimated_errors().empty());
  job.advance(7);
  const std::vector<float> errors = job.estimated_errors();
  REQUIRE(errors.size() == 24 * 16);
  CHECK(*std::max_element(errors.begin(), errors.end()) == doctest::Approx(job.report().worst_relmse));
  const auto block_at = [&](int x, int y) { return errors[static_cast<std::size_t>(y * 24 + x)]; };
  bool differ = false;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 24; ++x) {
      CHECK(block_at(x, y) == block_at(x / 8 * 8, y / 8 * 8));
      differ = differ || block_at(x, y) != block_at(0, 0);
    }
  }
  CHECK(differ);
}

TEST_CASE("an error goal ends a uniform render at a power of two from 64 on, at the first that is good enough") {
  const World world = world_of();
  RenderJob job(world, settings_of(1));
  job.advance(64);
  const double at_64 = job.estimated_relmse();
  job.advance(192);
  const double at_256 = job.estimated_relmse();
  REQUIRE(at_256 < at_64);

  RenderSettings s = settings_of(1 << 20);
  s.adaptive = false;
  s.error = at_64 * 1.01;
  CHECK(render(world, s).report.samples == 64);
  s.error = 1e9;  // at once, but not sooner
  CHECK(render(world, s).report.samples == 64);
  s.error = at_256 * 1.01;
  const int reached = render(world, s).report.samples;
  CHECK((reached == 128 || reached == 256));
  s.spp = 40;  // the other ends hold
  CHECK(render(world, s).report.samples == 40);
  s.error = -1;
  CHECK_THROWS_AS(render(world, s), Error);
}

TEST_CASE("checkpoints come at every power of two, and change nothing") {
  const World world = world_of();
  std::vector<int> seen;
  const Rendering with =
      render(world, settings_of(21), {.checkpoint = [&](const RenderJob& j) { seen.push_back(j.samples()); }});
  CHECK(seen == std::vector<int>{1, 2, 4, 8, 16});
  CHECK(test::same_bits(with.image, render(world, settings_of(21)).image));
}

TEST_CASE("every pass end is told of, then the end, and it changes nothing") {
  const World world = world_of();
  std::vector<int> seen;
  int at_end = 0;
  RenderControl control;
  control.pass_end = [&](const RenderJob& job) { seen.push_back(job.samples()); };
  control.end = [&](const RenderJob& job) {
    CHECK(at_end == 0);
    at_end = job.samples();
  };
  const Rendering looked_at = render(world, settings_of(20), control);
  REQUIRE(seen.size() > 1);
  CHECK(std::is_sorted(seen.begin(), seen.end()));
  CHECK(seen.back() == 20);
  CHECK(at_end == 20);
  CHECK(test::same_bits(looked_at.image, render(world, settings_of(20)).image));
}

TEST_CASE("one world serves several light strategies, and refuses those it was not built for") {
  const World world = world_of({LightStrategy::power, LightStrategy::tree});
  REQUIRE(world.summary().light_strategies.size() == 2);
  CHECK(world.summary().light_strategies[0].strategy == LightStrategy::power);
  CHECK(world.summary().light_strategies[1].bytes > 0);
  RenderSettings s = settings_of(4);
  s.lights = LightStrategy::power;
  CHECK(render(world, s).report.samples == 4);
  s.lights = LightStrategy::exhaustive;
  CHECK_THROWS_WITH_AS(render(world, s), doctest::Contains("exhaustive"), Error);
}

}  // namespace
}  // namespace tyndall
