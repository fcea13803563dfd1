#include "report/relight.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tyndall/error.h"

using namespace tyndall;

namespace {

void set(Image& image, const std::string& name, std::vector<float> values) {
  image.add_channel(name).values = std::move(values);
}

/// Two pixels, groups "key" and "default", G and B as R.
Image image_of(const std::vector<float>& key, const std::vector<float>& rest) {
  Image image;
  image.data = image.display = {0, 0, 2, 1};
  for (const std::string c : {"R", "G", "B"}) {
    set(image, c, {key[0] + rest[0], key[1] + rest[1]});
    set(image, "LightGroup.key." + c, key);
    set(image, "LightGroup.default." + c, rest);
  }
  image.attributes["tyndall/samples"] = 4;
  return image;
}

const std::vector<float>& of(const Image& image, const std::string& channel) { return image.find(channel)->values; }

std::string refusal(Image image, const std::vector<GroupFactor>& factors, Failure expected) {
  try {
    relight(std::move(image), factors, "hall.exr");
  } catch (const Error& e) {
    CHECK(e.failure() == expected);
    return e.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("relight: the picture is the sum of the groups times their factors; what is not named stays") {
  const Image image = image_of({1, 2}, {4, 8});
  const Relit relit = relight(image, std::vector<GroupFactor>{{"key", {2, 0.5f, 0}}});
  CHECK(of(relit.image, "R") == std::vector<float>{6, 12});
  CHECK(of(relit.image, "G") == std::vector<float>{4.5f, 9});
  CHECK(of(relit.image, "B") == std::vector<float>{4, 8});
  CHECK(of(relit.image, "LightGroup.key.R") == std::vector<float>{2, 4});
  CHECK(of(relit.image, "LightGroup.default.R") == std::vector<float>{4, 8});
  CHECK(*relit.image.attribute<std::string>("tyndall/relight") == "key=2,0.5,0 default=1,1,1");
  CHECK(*relit.image.attribute<int>("tyndall/samples") == 4);
  // Again: factors add up in the header, and the mix goes by what is there.
  const Relit again = relight(relit.image, std::vector<GroupFactor>{{"default", Rgb(0)}});
  CHECK(of(again.image, "R") == std::vector<float>{2, 4});
  CHECK(*again.image.attribute<std::string>("tyndall/relight") == "key=2,0.5,0 default=1,1,1; key=1,1,1 default=0,0,0");
}

TEST_CASE("relight: factors of 1 leave every bit, also where groups do not sum to the last") {
  Image image = image_of({1, 2}, {4, 8});
  image.channels[0].values = {std::nextafter(5.0f, 6.0f), 10};
  const Relit relit = relight(image, {});
  for (const Channel& c : image.channels) CHECK(of(relit.image, c.name) == c.values);
}

// Even samples 3 and 1, odd ones 5 and 1 for the groups in pixel 0: means 4 and 1 over four samples.
TEST_CASE("relight: variance by replicates is what a render tells") {
  Image image = image_of({4, 2}, {1, 2});
  for (const std::string c : {"R", "G", "B"}) {
    set(image, "Replicate." + c, {4, 4});
    set(image, "Replicate.LightGroup.key." + c, {3, 2});
    set(image, "Replicate.LightGroup.default." + c, {1, 2});
    set(image, "Variance." + c, {1, 0});
    set(image, "Variance.LightGroup.key." + c, {1, 0});
    set(image, "Variance.LightGroup.default." + c, {0, 0});
  }
  set(image, "Replicate.SampleCount", {2, 2});
  const Relit relit = relight(image, std::vector<GroupFactor>{{"key", Rgb(3)}});
  CHECK(of(relit.image, "R") == std::vector<float>{13, 8});
  CHECK(of(relit.image, "Replicate.R") == std::vector<float>{10, 8});
  CHECK(of(relit.image, "Variance.R")[0] == doctest::Approx(9));  // halves 10 and 16: (6/2)^2
  CHECK(of(relit.image, "Variance.LightGroup.key.R")[0] == doctest::Approx(9));
}

TEST_CASE("relight: without replicates the variance is a bound, exact for one factor and for one group") {
  const auto variance_with = [](std::vector<GroupFactor> factors) {
    Image image = image_of({4, 2}, {1, 2});
    for (const std::string c : {"R", "G", "B"}) {
      set(image, "Variance." + c, {5, 1});
      set(image, "Variance.LightGroup.key." + c, {4, 1});
      set(image, "Variance.LightGroup.default." + c, {1, 4});
    }
    return of(relight(image, factors).image, "Variance.R");
  };
  CHECK(variance_with({{"key", Rgb(2)}, {"default", Rgb(2)}})[0] == doctest::Approx(20));
  CHECK(variance_with({{"key", Rgb(3)}, {"default", Rgb(0)}})[0] == doctest::Approx(36));
  CHECK(variance_with({{"key", Rgb(0)}})[1] == doctest::Approx(4));
  // 2 key + default: at most (sqrt 5 + 2)^2 by all light and one key more, (2 sqrt 5 + 1)^2, or (2 x 2 + 1)^2.
  CHECK(variance_with({{"key", Rgb(2)}})[0] == doctest::Approx(std::pow(std::sqrt(5.0) + 2, 2)));
  // Of (1 + 2)^2 = 9, 2 sqrt 1 + 2, and 2 x 1 + 2 the least.
  CHECK(variance_with({{"key", Rgb(2)}})[1] == doctest::Approx(4));
}

TEST_CASE("relight: light that is not known by groups is scaled with all of them or left out, the rest is kept") {
  Image image = image_of({1, 2}, {4, 8});
  set(image, "SurfaceDirect.R", {1, 1});
  set(image, "Replicate.Emission.R", {1, 1});
  set(image, "Mse.R", {1, 1});
  set(image, "Albedo.R", {0.5f, 0.25f});
  const Relit relit = relight(image, std::vector<GroupFactor>{{"key", Rgb(2)}});
  CHECK(relit.left_out == std::vector<std::string>{"SurfaceDirect", "Emission", "Mse"});
  CHECK_FALSE(relit.image.find("SurfaceDirect.R"));
  CHECK(of(relit.image, "Albedo.R") == std::vector<float>{0.5f, 0.25f});
  const Relit all = relight(image, std::vector<GroupFactor>{{"key", Rgb(3)}, {"default", Rgb(3)}});
  CHECK(all.left_out.empty());
  CHECK(of(all.image, "SurfaceDirect.R") == std::vector<float>{3, 3});
  CHECK(of(all.image, "Mse.R") == std::vector<float>{9, 9});
}

TEST_CASE("relight: what cannot be mixed is refused with what to do") {
  const Image image = image_of({1, 2}, {4, 8});
  CHECK(refusal(image, {{"sky", Rgb(2)}}, Failure::usage) == "hall.exr has no light group \"sky\"; it has key, default");
  CHECK(refusal(image, {{"key", Rgb(2)}, {"key", Rgb(1)}}, Failure::usage) ==
        "light group \"key\" is given two factors; give one");
  Image plain;
  plain.data = plain.display = {0, 0, 2, 1};
  for (const char* c : {"R", "G", "B"}) plain.add_channel(c);
  CHECK(refusal(plain, {}, Failure::scene).find("has no light groups") != std::string::npos);
  Image slice = image;
  slice.attributes["tyndall/slice"] = std::string("1/2 of 32 samples 0..16");
  CHECK(refusal(slice, {}, Failure::scene).find("merge all slices first") != std::string::npos);
}

TEST_CASE("relight: factors as text") {
  CHECK(parse_group_factor("key=1.5").group == "key");
  CHECK(parse_group_factor("key=1.5").factor == Rgb(1.5f));
  CHECK(parse_group_factor("a-b_1=0.25,0,1e2").factor == Rgb{0.25f, 0, 100});
  for (const char* bad : {"key", "=1", "key=", "key=1,2", "key=1,2,3,4", "key=-1", "key=nan", "key=inf", "key=1,,2", "key=1 ",
                          "key=1,2,3,", "key=x"}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(parse_group_factor(bad), Error);
  }
}
