#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/same_pixels.h"
#include "support/sphere_scene.h"

namespace tyndall {
namespace {

/// A lit sphere: noise in one part of the picture.
World world() { return test::world_of(test::sphere_scene(60, 40), {.threads = 2}); }

RenderSettings settings_of(int spp = 1 << 20, int threads = 2) {
  RenderSettings s;
  s.spp = spp;
  s.threads = threads;
  s.reproducible = true;
  s.aovs = {"Variance", "Z", "N", "Replicate"};
  s.adaptive = true;
  return s;
}

TEST_CASE("an adaptive picture is the same however its samples are grouped, for any threads, and after a pause in a round") {
  const World w = world();
  RenderJob one(w, settings_of()), many(w, settings_of(1 << 20, 1)), paused(w, settings_of()), resumed(w, settings_of());
  one.advance(107);
  CHECK(one.samples() == 112);  // where a step ends
  for (const int n : {1, 40, 3, 4, 1, 30, 8}) many.advance(n);
  CHECK(many.samples() == 112);
  paused.advance(53);
  resumed.restore(paused.save(), "a");
  CHECK(resumed.samples() == 56);
  resumed.advance(56);
  CHECK(one.report().most_samples > one.report().least_samples);
  CHECK(test::same_bits_and_header(one.image(), many.image()));
  CHECK(test::same_bits_and_header(one.image(), resumed.image()));
}

TEST_CASE("a pass that is given up leaves an adaptive job as it was") {
  const World w = world();
  RenderJob whole(w, settings_of()), broken(w, settings_of());
  whole.advance(100);
  broken.advance(50);
  int calls = 0;
  CHECK_FALSE(broken.advance(
      10, [&](double) { return ++calls < 4; }, RenderJob::GivenUp::undone));
  broken.advance(100 - broken.samples());
  CHECK(test::same_bits_and_header(whole.image(), broken.image()));
  CHECK(whole.report().paths == broken.report().paths);
}

TEST_CASE("a picture weighs all rounds alike, and the header tells how many samples pixels have") {
  const World w = world();
  RenderJob job(w, settings_of());
  job.advance(96);
  const Image image = job.image();
  const std::vector<float>& counts = image.find("SampleCount")->values;
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  CHECK(*most > 2 * *least);
  CHECK(job.report().least_samples == static_cast<int>(*least));
  CHECK(job.report().most_samples == static_cast<int>(*most));
  CHECK(job.report().samples == 96);
  const std::string range = std::to_string(job.report().least_samples) + ".." + std::to_string(job.report().most_samples);
  CHECK(*image.attribute<std::string>("tyndall/samples") == range);
  for (const float weight : image.find("SampleWeight")->values) REQUIRE(weight == 96);
  for (const float weight : image.find("Replicate.SampleWeight")->values) REQUIRE(weight == 48);
  for (const float alpha : image.find("A")->values) REQUIRE(alpha <= 1);

  RenderSettings uniform = settings_of();
  uniform.adaptive = false;
  RenderJob even(w, uniform);
  even.advance(96);
  const Image expected = even.image();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto pair = [&](const char* name) { return std::pair{image.find(name)->values[i], expected.find(name)->values[i]}; };
    const auto [seen, seen_there] = pair("SurfaceCount");
    if (seen < 90 || seen_there < 90) continue;
    const auto [depth, depth_there] = pair("Z");
    REQUIRE(depth == doctest::Approx(depth_there).epsilon(0.02));
    const auto [light, light_there] = pair("G");
    const double deviation = std::sqrt(image.find("Variance.G")->values[i] + expected.find("Variance.G")->values[i]);
    REQUIRE(std::abs(light - light_there) <= 0.1 * light_there + 6 * deviation);
  }
  const float most_seen = std::nextafter(96.0f, 97.0f);  // shares such as 8 / 11 are rounded
  for (const float seen : image.find("SurfaceCount")->values) REQUIRE(seen <= most_seen);
}

TEST_CASE("an error goal ends an adaptive render near the error; no pixel has more samples than the most") {
  const World w = world();
  RenderSettings s = settings_of();
  s.adaptive.reset();
  RenderJob even(w, s);
  even.advance(32);
  s.error = even.estimated_relmse() / 3;
  const RenderReport report = render(w, s).report;
  CHECK(report.most_samples > report.least_samples);
  CHECK(report.estimated_relmse < *s.error);
  CHECK(report.estimated_relmse > 0.6 * *s.error);  // the last step adds up to half of the samples there are: 2/3, and noise
  CHECK(report.worst_relmse > report.estimated_relmse);
  CHECK(report.least_samples >= 32);
  s.error = 1e-12;
  s.spp = 70;
  const RenderReport most = render(w, s).report;
  CHECK(most.samples == 64);
  CHECK(most.most_samples <= 70);
  s.slice = SliceChoice{1, 2};
  s.error.reset();
  s.adaptive = true;
  CHECK_THROWS_AS(RenderJob(w, s), Error);
}

TEST_CASE("an adaptive job that has all samples it may have stays as it is") {
  const World w = world();
  for (const auto& [most, end] : {std::pair{70, 64}, {5, 5}}) {
    RenderJob job(w, settings_of(most));
    job.advance(end);
    const Image image = job.image();
    job.advance(20);
    CHECK(job.samples() == end);
    CHECK(test::same_bits_and_header(job.image(), image));
  }
}

TEST_CASE("an error goal of the worst part ends a render where that is as good, beside one of the mean where both are") {
  const World w = world();
  RenderSettings s = settings_of();
  s.adaptive.reset();
  RenderJob even(w, s);
  even.advance(32);
  const RenderReport first = even.report();
  s.error_max = first.worst_relmse / 4;
  const RenderReport of_worst = render(w, s).report;
  CHECK(of_worst.most_samples > of_worst.least_samples);  // adaptive without being asked
  CHECK(of_worst.worst_relmse < *s.error_max);
  CHECK(of_worst.worst_relmse > 0.25 * *s.error_max);

  s.error = first.estimated_relmse / 8;
  const RenderReport both = render(w, s).report;
  CHECK(both.estimated_relmse < *s.error);
  CHECK(both.worst_relmse < *s.error_max);
  s.adaptive = false;
  const RenderReport uniform = render(w, s).report;
  CHECK(uniform.estimated_relmse < *s.error);
  CHECK(uniform.worst_relmse < *s.error_max);
  CHECK(uniform.samples > both.samples);
}

TEST_CASE("what decided where samples went must agree for a checkpoint, but the mean's goal alone decides nothing") {
  const World w = world();
  RenderSettings s = settings_of();
  const auto fits = [&](const RenderSettings& saved, const RenderSettings& resumed) {
    RenderJob a(w, saved), b(w, resumed);
    a.advance(2);
    try {
      b.restore(a.save(), "a");
    } catch (const Error&) {
      return false;
    }
    return true;
  };
  RenderSettings mean = s, worst = s, both = s, other = s;
  mean.error = 1e-3;
  worst.error_max = 1e-2;
  both.error = 1e-3;
  both.error_max = 1e-2;
  other.error_max = 2e-2;
  CHECK(fits(s, mean));
  CHECK(fits(worst, worst));
  CHECK_FALSE(fits(mean, worst));
  CHECK_FALSE(fits(worst, both));
  CHECK_FALSE(fits(worst, other));
}

TEST_CASE("time that is left goes where the error is: less error at as many samples") {
  const World w = world();
  RenderSettings s = settings_of();
  s.time = 0.5;
  const RenderReport timed = render(w, s).report;
  if (timed.samples <= 64) return;  // a machine on which half a second holds no more tells nothing
  CHECK(timed.most_samples > timed.least_samples);
  s.time.reset();
  s.adaptive = false;
  RenderJob even(w, s);
  even.advance(timed.samples);
  CHECK(timed.estimated_relmse < even.estimated_relmse());
}

}  // namespace
}  // namespace tyndall
