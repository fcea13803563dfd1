#include "session/pass_schedule.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

#include "support/sphere_scene.h"

namespace tyndall {
namespace {

/// A render that was cut off after 8 samples, as another process finds it.
RenderJob resumed(const World& world, const RenderSettings& settings) {
  RenderJob before(world, settings), after(world, settings);
  before.advance(8);
  after.restore(before.save(), "kept");
  return after;
}

/// As many samples as a limit leaves room for.
RenderSettings without_end() { return {.spp = std::numeric_limits<int>::max(), .threads = 1}; }

TEST_CASE("what is left of a resumed render is measured by what was done here") {
  const World world = test::world_of(test::sphere_scene(16, 16), {.threads = 1});
  RenderSettings settings{.spp = 16, .threads = 1};
  RenderJob job = resumed(world, settings);
  PassSchedule schedule(settings, false);
  CHECK(schedule.next_pass(job) > 0);
  const auto begun = schedule.progress(job, 0);
  REQUIRE(begun);
  CHECK(begun->fraction == doctest::Approx(0.5));
  PassSchedule other(settings, false);
  other.next_pass(job);
  const double before = job.preparing_seconds();
  job.advance(4);
  const auto half = other.progress(job, 0);
  REQUIRE(half);
  CHECK(half->fraction == doctest::Approx(0.75));
  CHECK(half->remaining ==
        doctest::Approx(half->seconds - (job.preparing_seconds() - before)));  // 4 samples took so long, 4 are left
}

TEST_CASE("the time that a render had before it was resumed counts") {
  const World world = test::world_of(test::sphere_scene(16, 16), {.threads = 1});
  RenderJob job = resumed(world, {.threads = 1});
  RenderSettings settings{.spp = 1 << 20, .threads = 1};
  settings.time = 4 * job.seconds();
  PassSchedule schedule(settings, false);
  CHECK(schedule.next_pass(job) > 0);
  const auto begun = schedule.progress(job, 0);
  REQUIRE(begun);
  CHECK(begun->fraction >= 0.25);  // the pass that has begun takes time
  settings.time = job.seconds() / 2;
  CHECK(PassSchedule(settings, false).next_pass(job) == 0);
}

TEST_CASE("the time that a running pass takes counts before it has ended") {
  const World world = test::world_of(test::sphere_scene(16, 16), {.threads = 1});
  RenderSettings settings{.spp = 1 << 20, .threads = 1};
  settings.time = 1e-4;
  RenderJob job(world, settings);
  PassSchedule schedule(settings, false);
  std::optional<Progress> during;
  job.advance(schedule.next_pass(job), [&](double samples) {
    if (samples == 0) return true;  // it looks at the film
    const auto progress = schedule.progress(job, samples);
    if (progress) during = progress;
    return true;
  });
  REQUIRE(during);
  CHECK(job.samples() == 1);
  CHECK(during->samples_done == 0);
  CHECK(during->fraction > 1e-3);  // the share of the samples is 1e-6
}

TEST_CASE("a time that is up before the first sample has ended is not all that is to be done") {
  const World world = test::world_of(test::sphere_scene(16, 16), {.threads = 1});
  RenderSettings settings = without_end();
  settings.time = 1e-9;
  RenderJob job(world, settings);
  PassSchedule schedule(settings, false);
  double largest = 0;
  job.advance(schedule.next_pass(job), [&](double samples) {
    const auto progress = schedule.progress(job, samples);
    if (progress && samples < 0.9) largest = std::max(largest, progress->fraction);
    return true;
  });
  CHECK(largest < 0.9);
}

TEST_CASE("what takes until the error is small is not told before there is one") {
  const World world = test::world_of(test::sphere_scene(16, 16), {.threads = 1});
  RenderSettings settings = without_end();
  settings.error = 1e-3;
  RenderJob job(world, settings);
  PassSchedule schedule(settings, false);
  CHECK(schedule.next_pass(job) > 0);
  const auto begun = schedule.progress(job, 0.5);
  REQUIRE(begun);
  CHECK(begun->remaining == 0);
}

// The pilot comes before the second sample of one pass.
TEST_CASE("samples and time count once while a pass finds out what pays") {
  const World world = test::world_of(test::sphere_scene(16, 16), {.threads = 1});
  RenderSettings settings{.spp = 8, .threads = 1};
  settings.time = 1e6;
  RenderJob job(world, settings);
  PassSchedule schedule(settings, false);
  REQUIRE(schedule.next_pass(job) == 1);
  job.advance(1);
  const auto at_one = schedule.progress(job, 1);
  REQUIRE(at_one);
  CHECK(at_one->samples_done == 1);
  CHECK(at_one->fraction == doctest::Approx(1.0 / 8));

  settings.time = 100 * job.seconds();
  PassSchedule timed(settings, false);
  REQUIRE(timed.next_pass(job) > 0);
  std::this_thread::sleep_for(std::chrono::duration<double>(0.25 * *settings.time));
  const auto waiting = timed.progress(job, 0);
  REQUIRE(waiting);
  CHECK(waiting->fraction >= 0.25);
  CHECK(waiting->remaining > 0);
}

TEST_CASE("what is left is measured by samples alone, not by what is looked at before them") {
  const World world = test::world_of(test::sphere_scene(16, 16), {.threads = 1});
  const RenderSettings settings{.spp = 4, .threads = 1};
  RenderJob job(world, settings);
  PassSchedule schedule(settings, false);
  constexpr std::chrono::seconds kLook{1};
  bool looked = false;
  REQUIRE(schedule.next_pass(job) == 1);
  job.advance(1, [&](double samples) {
    if (samples == 0 && !looked) std::this_thread::sleep_for(kLook);
    looked |= samples == 0;
    return true;
  });
  const auto after = schedule.progress(job, 0);
  REQUIRE(after);
  CHECK(after->seconds > 1);
  CHECK(after->remaining > 0);
  CHECK(after->remaining < 1);  // three samples of a few hundred pixels
  REQUIRE(schedule.next_pass(job) > 0);
  std::this_thread::sleep_for(kLook);  // as when it is found out what pays
  const auto looking = schedule.progress(job, 0);
  REQUIRE(looking);
  CHECK(looking->remaining == doctest::Approx(after->remaining).epsilon(0.2));
}

TEST_CASE("a render that looks at the film before its first sample shows that it does") {
  const World world = test::world_of(test::sphere_scene(16, 16), {.threads = 1});
  const RenderSettings settings{.spp = 2, .threads = 1};
  RenderJob job(world, settings);
  PassSchedule schedule(settings, false);
  std::optional<Progress> first;
  job.advance(schedule.next_pass(job), [&](double samples) {
    if (!first) first = schedule.progress(job, samples);
    return true;
  });
  REQUIRE(first);
  CHECK(first->preparing);
  CHECK(first->fraction == 0);
  CHECK(job.preparing_seconds() > 0);
  CHECK(job.preparing_seconds() < job.seconds());
  PassSchedule later(settings, false);
  later.next_pass(job);
  CHECK_FALSE(later.progress(job, 0)->preparing);
}

}  // namespace
}  // namespace tyndall
