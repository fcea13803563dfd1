#include "tyndall/slice.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <numeric>

#include "session/memory_plan.h"
#include "support/same_pixels.h"
#include "support/sphere_scene.h"

using namespace tyndall;

namespace {

const std::string kScene = test::sphere_scene(40, 36);

RenderSettings settings_of(int spp, std::optional<SliceChoice> slice = {}) {
  RenderSettings s;
  s.spp = spp;
  s.threads = 2;
  s.reproducible = true;
  for (const std::string_view aov : aov_names()) s.aovs.emplace_back(aov);
  s.slice = slice;
  return s;
}

std::string refusal(const RenderSettings& settings) {
  try {
    sample_range(settings);
  } catch (const Error& e) {
    CHECK(e.failure() == Failure::usage);
    return e.what();
  }
  return "none";
}

/// As a file holds it: channels by name.
Image sorted(Image image) {
  std::sort(image.channels.begin(), image.channels.end(), [](const Channel& a, const Channel& b) { return a.name < b.name; });
  return image;
}

}  // namespace

TEST_CASE("slices are all samples, each once, in parts of about one size that begin at multiples of 16") {
  for (const int spp : {16, 100, 1024, 12345, 1 << 30, std::numeric_limits<int>::max()}) {
    for (const int count : {1, 2, 3, 7, 16, 64, 1000}) {
      if (spp < 16 * count) continue;
      int end = 0;
      for (int i = 1; i <= count; ++i) {
        const SampleRange range = sample_range(settings_of(spp, SliceChoice{i, count}));
        REQUIRE(range.first == end);
        REQUIRE(range.first % 16 == 0);
        REQUIRE(std::abs(range.count - static_cast<double>(spp) / count) <= 16);
        end = range.first + range.count;
      }
      REQUIRE(end == spp);
    }
  }
  CHECK(sample_range(settings_of(100)) == SampleRange{0, 100});
}

TEST_CASE("slices that cannot be are refused with what to do") {
  CHECK(refusal(settings_of(64, SliceChoice{0, 4})) == "slice 0/4 cannot be; give I/N with I from 1 to N, and N up to 100000");
  CHECK(refusal(settings_of(64, SliceChoice{5, 4})).find("slice 5/4 cannot be") == 0);
  CHECK(refusal(settings_of(1 << 30, SliceChoice{1, 100'001})).find("slice 1/100001 cannot be") == 0);
  CHECK(refusal(settings_of(16, SliceChoice{1, 4})).find("is empty") != std::string::npos);
  RenderSettings settings = settings_of(64, SliceChoice{1, 4});
  settings.error = 0.1;
  CHECK(refusal(settings).find("give it to merge") != std::string::npos);
}

// Nineteen passes of odd sizes in the whole, four jobs of their own in the parts.
TEST_CASE("the sum of all slices is the render of all samples, bit for bit, in every AOV and in any order") {
  const World world = test::world_of(kScene, {.threads = 2});
  RenderJob whole(world, settings_of(100));
  for (int done = 0; done < 100; done += 7) whole.advance(std::min(7, 100 - done));
  std::vector<Image> parts;
  for (const int i : {3, 1, 4, 2}) parts.push_back(render(world, settings_of(100, SliceChoice{i, 4})).image);

  SliceSum sum(parts.front(), "part");
  for (const Image& part : parts) sum.add(part, "part");
  CHECK(sum.samples() == 100);
  CHECK(sum.estimated_relmse() == whole.estimated_relmse());
  CHECK(test::same_bits(sorted(sum.image(false)), sorted(whole.image())));
}

TEST_CASE("what is there of the slices is the picture of so many samples, with the variance of these") {
  const World world = test::world_of(kScene, {.threads = 2});
  RenderSettings settings = settings_of(64, SliceChoice{1, 2});
  settings.aovs = {"Z"};
  const Image part = render(world, settings).image;
  SliceSum sum(part, "part");
  sum.add(part, "part");
  RenderSettings half = settings_of(32);
  half.aovs = {"Z", "Variance", "SampleCount"};
  CHECK(test::same_bits(sorted(sum.image(true)), sorted(render(world, half).image)));
  CHECK(sum.image(false).find("Variance.R") == nullptr);
}

TEST_CASE("a slice tells which samples are in it, and whether these are all of its share") {
  const World world = test::world_of(kScene, {.threads = 2});
  RenderJob job(world, settings_of(64, SliceChoice{2, 2}));
  job.advance(6);
  const auto stopped = slice_info(job.image(), "part");
  REQUIRE(stopped);
  CHECK(stopped->choice == SliceChoice{2, 2});
  CHECK(stopped->total == 64);
  CHECK(stopped->range == SampleRange{32, 6});
  CHECK_FALSE(stopped->complete());
  job.advance(26);
  CHECK(slice_info(job.image(), "part")->complete());
  CHECK_FALSE(slice_info(render(world, settings_of(16)).image, "whole"));

  Image damaged = job.image();
  for (const char* text :
       {"", "3/2 of 64 samples 32..64", "2/2 of 64 samples 64..32", "2/2 of 64 samples 32..64 more",
        "2/2 of 64 samples -2147483648..64", "1/2147483647 of 2147483647 samples 0..64", "2/2 of 99999999999 samples 32..64"}) {
    damaged.attributes["tyndall/slice"] = std::string(text);
    CHECK_THROWS_AS(slice_info(damaged, "part"), Error);
  }
}

TEST_CASE("a slice has as many sums as were planned, and about as many channels") {
  Scene scene = read_scene_text(kScene + "LightSource \"point\" \"string lightgroup\" \"key\"\n", "test.pbrt").scene;
  scene.settings = settings_of(16, SliceChoice{1, 1});
  const Image image = render(build(scene, {.threads = 2}), scene.settings).image;
  std::size_t channels = 0, sums = 0;
  for (const Channel& c : image.channels) {
    if (c.name.find("Crypto") != std::string::npos) continue;
    (c.name.starts_with("Sum.") ? sums : channels) += 1;
  }
  CHECK(sums == 3 * film_numbers(scene).sums);
  CHECK(channels <= film_numbers(scene).channels);
  CHECK(static_cast<double>(channels) > 0.9 * static_cast<double>(film_numbers(scene).channels));
}

TEST_CASE("a slice of which one bit has changed is refused, and what was added stays") {
  const World world = test::world_of(kScene, {.threads = 2});
  const Image good = render(world, settings_of(32, SliceChoice{1, 2})).image;
  Image bad = render(world, settings_of(32, SliceChoice{2, 2})).image;
  SliceSum sum(good, "good");
  sum.add(good, "good");
  const Image before = sum.image(true);
  for (Channel& c : bad.channels) {
    if (c.name == "Sum.4.high") c.values[700] = std::nextafter(c.values[700], 0.0f);
  }
  CHECK_THROWS_WITH_AS(sum.add(bad, "bad.exr"),
                       "bad.exr: is damaged: its sums do not fit their checksum; render the slice again", Error);
  CHECK(sum.samples() == 16);
  CHECK(test::same_bits(sum.image(true), before));
}

TEST_CASE("slices with a time end at even samples of their own ranges") {
  const World world = test::world_of(kScene, {.threads = 2});
  RenderSettings settings = settings_of(std::numeric_limits<int>::max(), SliceChoice{3, 4});
  settings.time = 0.05;
  const auto info = slice_info(render(world, settings).image, "part");
  REQUIRE(info);
  CHECK(info->range.first == 1 << 30);
  CHECK(info->range.count % 2 == 0);
  CHECK(info->complete());
}

TEST_CASE("a slice with a time that was stopped is not complete, though its samples count") {
  const World world = test::world_of(kScene, {.threads = 2});
  RenderSettings settings = settings_of(std::numeric_limits<int>::max(), SliceChoice{1, 4});
  settings.time = 600;
  std::atomic<bool> stop = false;
  RenderControl control{.progress = [&](const Progress& p) { stop = p.samples_done > 0; }, .stop = &stop};
  const Image part = render(world, settings, control).image;
  const auto info = slice_info(part, "part");
  REQUIRE(info);
  CHECK(info->range.count > 0);
  CHECK_FALSE(info->complete());
  CHECK_FALSE(holds_slice(part, world, settings));
  SliceSum sum(part, "part");
  sum.add(part, "part");
  CHECK(sum.samples() == info->range.count);
}

TEST_CASE("a slice whose sums have other names, or whose AOVs are not known, is refused") {
  const World world = test::world_of(kScene, {.threads = 2});
  Image part = render(world, settings_of(32, SliceChoice{1, 2})).image;
  SliceSum sum(part, "part");
  Image other = part;
  for (Channel& c : other.channels) {
    if (c.name == "Sum.4.high") c.name = "Sum.99.high";
  }
  CHECK_THROWS_AS(sum.add(other, "other.exr"), Error);
  part.attributes["tyndall/aov"] = std::string("Smell");
  CHECK_THROWS_WITH_AS(SliceSum(part, "part.exr"),
                       "part.exr: attribute tyndall/aov names channels that this Tyndall does not know; render the slice again",
                       Error);
}
