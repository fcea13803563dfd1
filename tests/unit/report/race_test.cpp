#include "report/race.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "report/compare.h"
#include "support/sphere_scene.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

constexpr const char* kScene = R"(
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
Camera "perspective" "float fov" 50
WorldBegin
LightSource "point" "rgb I" [ 1 2 3 ] "point3 from" [ 1 1 2 ]
LightSource "point" "rgb I" [ 1 1 1 ] "point3 from" [ -3 1 2 ]
Translate 0 0 4
Shape "sphere" "float radius" 1.5
)";

World world() {
  return build(read_scene_text(kScene, "test.pbrt").scene,
               {.lights = {LightStrategy::uniform, LightStrategy::power}, .threads = 1});
}

RenderSettings method(LightStrategy lights, std::uint64_t seed = 3) {
  RenderSettings s;
  s.lights = lights;
  s.threads = 1;
  s.seed = seed;
  s.reproducible = true;
  s.aovs = {"Variance"};
  return s;
}

/// Large enough for blocks to differ.
World blocks_world() { return test::world_of(test::sphere_scene(60, 40), {.lights = {LightStrategy::power}, .threads = 1}); }

Image plain(const World& w, LightStrategy lights, int spp) {
  RenderSettings s = method(lights);
  s.spp = spp;
  return render(w, s).image;
}

Image black_picture(const World& w) {
  Image image = plain(w, LightStrategy::power, 1);
  for (Channel& c : image.channels) std::fill(c.values.begin(), c.values.end(), 0.0f);
  return image;
}

TEST_CASE("a race of equal samples ends with the pictures that plain renders give") {
  const World w = world();
  const Image black = black_picture(w);
  double last = 0;
  const auto runs =
      race(w, {method(LightStrategy::uniform), method(LightStrategy::power)}, {.seconds = std::nullopt, .samples = 21},
           {.measure = [&](const Image& i) { return measure_error(i, black); },
            .progress =
                [&](double f) {
                  CHECK(f >= last);
                  last = f;
                }});
  CHECK(last == 1);
  REQUIRE(runs.size() == 2);
  CHECK(runs[0].image.find("R")->values == plain(w, LightStrategy::uniform, 21).find("R")->values);
  CHECK(runs[1].image.find("B")->values == plain(w, LightStrategy::power, 21).find("B")->values);
  for (const RaceRun& run : runs) {
    std::vector<int> samples;
    for (const RaceCheckpoint& c : run.checkpoints) samples.push_back(c.samples);
    CHECK(samples == std::vector<int>{1, 2, 4, 8, 16, 21});
    CHECK(run.checkpoints[2].error.mse ==
          doctest::Approx(
              measure_error(plain(w, &run == &runs[0] ? LightStrategy::uniform : LightStrategy::power, 4), black).mse));
    CHECK(run.checkpoints.back().seconds >= run.checkpoints.front().seconds);
  }
}

TEST_CASE("a race of equal time stops at it, and gives up on what has no sample by four times that") {
  const World w = world();
  const auto measure = [](const Image&) { return ErrorMetrics{}; };
  const auto runs = race(w, {method(LightStrategy::uniform)}, {.seconds = 0.05, .samples = std::nullopt}, {.measure = measure});
  CHECK(runs[0].checkpoints.size() > 3);
  const auto hurried =
      race(w, {method(LightStrategy::uniform)}, {.seconds = 1e-9, .samples = std::nullopt}, {.measure = measure});
  CHECK(hurried[0].given_up);
  CHECK(hurried[0].checkpoints.empty());
}

TEST_CASE("compare: an unbiased pair, a reference with noise, and a biased one that the slope gives away") {
  const World w = world();
  const Reference reference = render_reference(w, method(LightStrategy::power, 99), {.relmse = 1e-5});
  CHECK(reference.relmse < 1e-5);
  CHECK(reference.samples >= 64);
  const ComparePlan plan{
      {{"a", "--lights uniform", method(LightStrategy::uniform)}, {"b", "--lights power", method(LightStrategy::power)}},
      {.seconds = std::nullopt, .samples = 64},
      {1, 2, 3, 4, 5}};
  const CompareResult result = compare(w, plan, reference);
  REQUIRE(result.variants.size() == 2);
  for (const VariantResult& v : result.variants) {
    CHECK(v.curve.size() == 7);
    CHECK(v.samples == 64);
    REQUIRE(v.slope_samples);
    CHECK(v.slope_samples->value < -0.95);
    CHECK(v.error.relmse > 0);
    CHECK(v.error.relmse < v.curve.front().relmse.value / 30);
  }
  CHECK(result.variants[0].efficiency->value == 1);
  CHECK(result.variants[1].efficiency->low < result.variants[1].efficiency->high);

  Reference wrong = reference;  // as if the methods lost light
  for (const char* name : {"R", "G", "B"}) {
    for (Channel& c : wrong.image.channels) {
      if (c.name == name)
        for (float& v : c.values) v *= 1.4f;
    }
  }
  wrong.relmse = 0;  // it looks perfect
  const CompareResult biased = compare(w, plan, wrong);
  CHECK(biased.variants[1].slope_samples->low > -1);
}

TEST_CASE("a slope that is too flat is a sign of bias, but not where a filter's bias is meant") {
  VariantResult v;
  v.slope = v.slope_samples = ConfidenceInterval{-0.5, -0.6, -0.4};
  CHECK(v.slope_note() == "flatter than -1: a sign of bias");
  v.as_rendered = "noisy";
  CHECK(v.slope_note().empty());
}

TEST_CASE("a filter makes every variant a second one, from two samples on, and its time counts") {
  const World w = world();
  const Image black = black_picture(w);
  const auto halved = [](const Image& image) {
    Image half = image;
    for (Channel& c : half.channels) {
      for (float& v : c.values) v /= 2;
    }
    return half;
  };
  const RaceControl control{.measure = [&](const Image& i) { return measure_error(i, black); }, .filter = halved};
  const auto runs = race(w, {method(LightStrategy::uniform)}, {.seconds = std::nullopt, .samples = 5}, control);
  REQUIRE(runs[0].checkpoints.size() == 4);  // 1, 2, 4, 5
  REQUIRE(runs[0].filtered.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(runs[0].filtered[i].samples == runs[0].checkpoints[i + 1].samples);
    CHECK(runs[0].filtered[i].seconds > runs[0].checkpoints[i + 1].seconds);
    CHECK(runs[0].filtered[i].error.mse == doctest::Approx(runs[0].checkpoints[i + 1].error.mse / 4));
  }

  const ComparePlan plan{.variants = {{"u", "--lights uniform", method(LightStrategy::uniform)}},
                         .budget = {.seconds = std::nullopt, .samples = 4},
                         .seeds = {1, 2, 3, 4, 5},
                         .filter = {.name = "halved", .option = "--halve", .aovs = {"Z"}, .apply = halved}};
  Reference reference;
  reference.image = black;
  const CompareResult result = compare(w, plan, reference);
  REQUIRE(result.variants.size() == 2);
  CHECK(result.variants[1].name == "u halved");
  CHECK(result.variants[1].options == "--lights uniform --halve");
  CHECK(result.variants[0].as_rendered.empty());
  CHECK(result.variants[1].as_rendered == "u");
  CHECK(result.variants[1].error.mse == doctest::Approx(result.variants[0].error.mse / 4));
  CHECK(result.variants[1].image.find("Z") == nullptr);
  CHECK(result.variants[0].curve.size() == 3);
  CHECK(result.variants[1].curve.size() == 2);
}

TEST_CASE("a method may put samples where the error is: as many in the mean as the others, whatever its own ends say") {
  const World w = blocks_world();
  RenderSettings adaptive = method(LightStrategy::power);
  adaptive.adaptive = true;
  adaptive.spp = 1;
  adaptive.error = 1e9;
  adaptive.error_max = 1e9;
  const auto runs = race(w, {method(LightStrategy::power), adaptive}, {.seconds = std::nullopt, .samples = 96},
                         {.measure = [](const Image&) { return ErrorMetrics(); }});
  REQUIRE(runs.size() == 2);
  CHECK(runs[0].report.samples == 96);
  CHECK(runs[1].report.samples == 96);
  CHECK(runs[0].report.least_samples == 96);
  CHECK(runs[1].report.least_samples < 96);
  CHECK(runs[1].report.most_samples > 96);

  RenderSettings alone = method(LightStrategy::power);
  alone.adaptive = true;
  alone.spp = 1 << 30;
  RenderJob job(w, alone);
  job.advance(96);
  CHECK(runs[1].image.find("R")->values == job.image().find("R")->values);
}

TEST_CASE("a comparison keeps the samples of each pixel where they differ") {
  const World w = blocks_world();
  ComparePlan plan{
      .variants = {{"uniform", "", method(LightStrategy::power)}, {"adaptive", "--adaptive", method(LightStrategy::power)}},
      .budget = {.seconds = std::nullopt, .samples = 96},
      .seeds = {5, 6}};
  plan.variants[1].settings.adaptive = true;
  RenderSettings best = method(LightStrategy::power, 77);
  best.spp = 256;
  const CompareResult result = compare(w, plan, as_reference(render(w, best).image, "best"));
  REQUIRE(result.variants.size() == 2);
  CHECK(result.variants[0].sample_counts.channels.empty());
  CHECK(result.variants[0].least_samples == 96);
  const VariantResult& v = result.variants[1];
  REQUIRE(v.sample_counts.channels.size() == 1);
  CHECK(v.sample_counts.width() == v.image.width());
  const std::vector<float>& counts = v.sample_counts.channels[0].values;
  CHECK(counts == v.image.find("SampleCount")->values);
  CHECK(*std::min_element(counts.begin(), counts.end()) >= static_cast<float>(v.least_samples));
  CHECK(*std::max_element(counts.begin(), counts.end()) <= static_cast<float>(v.most_samples));
  CHECK(v.least_samples < v.most_samples);
}

}  // namespace
}  // namespace tyndall
