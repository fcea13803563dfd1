#include "report/regress_judge.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "report/regress_reference.h"
#include "tyndall/error.h"

using namespace tyndall;

namespace {

constexpr int kSize = 32;

/// What a picture is: noise is 10 % of its values.
struct Truth {
  double radiance = 1, albedo = 0.5, depth = 4;
};

Image noisy_render(const Truth& truth, unsigned seed) {
  std::mt19937 rng(seed);
  std::normal_distribution<double> normal;
  Image image;
  image.data = image.display = {0, 0, kSize, kSize};
  const auto fill = [&](const char* name, double mean, double noise) {
    for (float& v : image.add_channel(name).values) v = static_cast<float>(mean * (1 + noise * normal(rng)));
  };
  for (const char* name : {"R", "G", "B"}) fill(name, truth.radiance, 0.1);
  fill("A", 1, 0);
  for (const char* name : {"Albedo.R", "Albedo.G", "Albedo.B"}) fill(name, truth.albedo, 0.1);
  fill("Z", truth.depth, 0.1);
  fill("Variance.R", 1, 0);
  fill("SampleCount", 64, 0);
  return image;
}

Image mean_of(const Truth& truth, unsigned first_seed, int runs) {
  RunMeans means;
  for (int k = 0; k < runs; ++k) means.add(noisy_render(truth, first_seed + static_cast<unsigned>(k)));
  return means.result(64);
}

const LayerTest& named(const std::vector<LayerTest>& tests, const std::string& what) {
  for (const LayerTest& t : tests) {
    if (t.what == what) return t;
  }
  FAIL("no test of " << what);
  return tests.front();
}

}  // namespace

TEST_CASE("each light group is a layer") {
  Image image;
  for (const char* name : {"LightGroup.key.R", "LightGroup.key.G", "LightGroup.sky.R", "R", "A", "N.X", "N.Y", "Z"})
    image.add_channel(name);
  const std::vector<Layer> layers = layers_of(image);
  std::vector<std::string> names;
  for (const Layer& layer : layers) names.push_back(layer.name);
  CHECK(names == std::vector<std::string>{"RGB", "LightGroup.key", "LightGroup.sky", "A", "N", "Z"});
  CHECK(layers[1].channels[0] == "LightGroup.key.R");
  CHECK(layers[1].channels[1] == "LightGroup.key.G");
  CHECK(layers[2].channels[0] == "LightGroup.sky.R");
  CHECK(layers[4].channels[1] == "N.Y");
}

TEST_CASE("runs give a mean and the variance of the mean for every channel") {
  const Image image = mean_of({}, 1, 400);
  const RunCounts counts = run_counts(image, "x.exr");
  CHECK(counts.runs == 400);
  CHECK(counts.spp == 64);
  REQUIRE(image.find("Variance.Albedo.G") != nullptr);
  CHECK(image.find("SampleCount") == nullptr);
  double mean = 0, variance = 0;
  for (int i = 0; i < kSize * kSize; ++i) {
    mean += image.find("Albedo.G")->values[i] / (kSize * kSize);
    variance += image.find("Variance.Albedo.G")->values[i] / (kSize * kSize);
  }
  CHECK(mean == doctest::Approx(0.5).epsilon(0.001));
  CHECK(variance / (0.05 * 0.05 / 400) == doctest::Approx(1).epsilon(0.02));
  CHECK(image.find("Variance.A")->values[0] == 0);
}

TEST_CASE("runs must be alike, and a reference must say how many it was made of") {
  RunMeans means;
  means.add(noisy_render({}, 1));
  Image other = noisy_render({}, 2);
  other.channels.pop_back();
  other.channels.pop_back();
  other.channels.pop_back();  // Z
  CHECK_THROWS_AS(means.add(other), Error);
  CHECK_THROWS_WITH_AS(run_counts(noisy_render({}, 1), "x.exr"), doctest::Contains("x.exr"), Error);
}

TEST_CASE("channels form layers") {
  const std::vector<Layer> layers = layers_of(mean_of({}, 1, 2));
  REQUIRE(layers.size() == 4);
  CHECK(layers[0].name == "RGB");
  CHECK(layers[0].channels == std::array<std::string, 3>{"R", "G", "B"});
  CHECK(layers[2].channels == std::array<std::string, 3>{"Albedo.R", "Albedo.G", "Albedo.B"});
  CHECK(layers[3].channels == std::array<std::string, 3>{"Z", "", ""});
}

TEST_CASE("what is the same passes in every layer, whatever the noise") {
  for (unsigned trial = 0; trial < 20; ++trial) {
    for (const LayerTest& t : judge(mean_of({}, 1000 * trial, 4), mean_of({}, 1000 * trial + 500, 16), 1e-4)) {
      CHECK_MESSAGE(t.same, "trial ", trial, " ", t.what, ": ", t.verdict);
    }
  }
}

TEST_CASE("one layer that is 1 % off is found, and no other") {
  const Image reference = mean_of({}, 500, 16);
  for (const auto& [what, truth] :
       {std::pair{"RGB", Truth{.radiance = 1.01}}, {"Albedo", Truth{.albedo = 0.505}}, {"Z", Truth{.depth = 4.04}}}) {
    for (const LayerTest& t : judge(mean_of(truth, 1, 4), reference, 1e-4)) {
      CHECK_MESSAGE(t.same == (t.what != what), what, " is off: ", t.what, ": ", t.verdict);
    }
  }
}

TEST_CASE("a layer that only one side has, and a value that is no number, differ") {
  const Image reference = mean_of({}, 500, 16);
  Image render = mean_of({}, 1, 4);
  render.channels[0].values[5] = std::numeric_limits<float>::quiet_NaN();
  CHECK_FALSE(named(judge(render, reference, 1e-4), "RGB").same);

  std::erase_if(render.channels, [](const Channel& c) { return c.name == "Z"; });
  CHECK_FALSE(named(judge(render, reference, 1e-4), "Z").same);
  CHECK_FALSE(named(judge(reference, render, 1e-4), "Z").same);
}
