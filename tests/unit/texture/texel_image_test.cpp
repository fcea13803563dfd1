#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/scratch.h"
#include "texture/texel_image.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

using namespace tyndall;
using doctest::Approx;
using Wrap = TexelImage::Wrap;

namespace {

/// 4 x 2 texels: red is x, green is y, blue is 1; alpha is x / 4.
TexelImage sample() {
  std::vector<Rgb> texels;
  std::vector<float> alpha;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) {
      texels.emplace_back(static_cast<float>(x), static_cast<float>(y), 1.0f);
      alpha.push_back(static_cast<float>(x) / 4);
    }
  return {4, 2, texels, alpha};
}

void check_rgb(Rgb c, Rgb expected) {
  for (int i = 0; i < 3; ++i) CHECK(c[i] == Approx(expected[i]).epsilon(1e-5));
}

Image image_of(std::vector<std::pair<std::string, std::vector<float>>> channels, int width, int height) {
  Image image;
  image.data = image.display = {0, 0, width, height};
  for (auto& [name, values] : channels) image.channels.push_back({name, std::move(values)});
  return image;
}

}  // namespace

TEST_CASE("texel centres give the texels themselves, for both filters") {
  const TexelImage image = sample();
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) {
      const Vec2 st{(static_cast<float>(x) + 0.5f) / 4, (static_cast<float>(y) + 0.5f) / 2};
      for (Wrap wrap : {Wrap::repeat, Wrap::black, Wrap::clamp}) {
        check_rgb(image.bilinear(st, wrap), image.texel(x, y));
        CHECK(image.nearest(st, wrap) == image.texel(x, y));
        CHECK(image.bilinear_alpha(st, wrap) == Approx(image.alpha(x, y)));
      }
    }
}

TEST_CASE("between centres the value is bilinear") {
  const TexelImage image = sample();
  check_rgb(image.bilinear({0.5f, 0.5f}, Wrap::repeat), {1.5f, 0.5f, 1});
  check_rgb(image.bilinear({0.4375f, 0.375f}, Wrap::clamp), {1.25f, 0.25f, 1});
  CHECK(image.bilinear_alpha({0.5f, 0.3f}, Wrap::clamp) == Approx(0.375));
}

TEST_CASE("wrap modes at and beyond the border") {
  const TexelImage image = sample();
  check_rgb(image.bilinear({0, 0.25f}, Wrap::repeat), {1.5f, 0, 1});  // half of texel 3, half of texel 0
  check_rgb(image.bilinear({0, 0.25f}, Wrap::clamp), {0, 0, 1});
  check_rgb(image.bilinear({0, 0.25f}, Wrap::black), {0, 0, 0.5f});
  check_rgb(image.bilinear({1.125f, 0.25f}, Wrap::repeat), image.texel(0, 0));
  check_rgb(image.bilinear({-0.125f, 1.25f}, Wrap::repeat), image.texel(3, 0));
  check_rgb(image.bilinear({7, -3}, Wrap::clamp), image.texel(3, 0));
  check_rgb(image.bilinear({7, 0.5f}, Wrap::black), {});
  check_rgb(image.bilinear({0.5f, -7}, Wrap::black), {});
  CHECK(image.nearest({-0.01f, 0.25f}, Wrap::repeat) == image.texel(3, 0));
  CHECK(image.nearest({-0.01f, 0.25f}, Wrap::clamp) == image.texel(0, 0));
  CHECK(image.nearest({-0.01f, 0.25f}, Wrap::black) == Rgb());
  CHECK(image.nearest({1.0f, 1.0f}, Wrap::clamp) == image.texel(3, 1));
  CHECK(image.bilinear_alpha({1.2f, 0.5f}, Wrap::black) == 0.0f);
}

TEST_CASE("no coordinate reads outside, and one texel is enough") {
  const TexelImage image = sample(), one(1, 1, {Rgb(0.5f)});
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (float s : {0.0f, -0.0f, 1.0f, 1e-40f, -1e-40f, -1e-9f, 0.99999994f, 1e9f, -1e9f, 3e38f, -3e38f, inf, -inf, nan})
    for (float t : {0.3f, s})
      for (Wrap wrap : {Wrap::repeat, Wrap::black, Wrap::clamp}) {
        const Rgb a = image.bilinear({s, t}, wrap), b = image.nearest({s, t}, wrap);
        CHECK(is_finite(a));
        CHECK(max_component(a) <= 3);
        CHECK(max_component(b) <= 3);
        if (wrap != Wrap::black) CHECK(one.bilinear({s, t}, wrap).r == Approx(0.5));
      }
}

TEST_CASE("the average is the texels' mean") {
  check_rgb(sample().average(), {1.5f, 0.5f, 1});
  CHECK(TexelImage().average() == Rgb());
}

TEST_CASE("channels: colour, grey, a single one; opaque alpha is dropped") {
  const TexelImage grey = TexelImage::from(image_of({{"Y", {0.25f, -1}}}, 2, 1), "f");
  CHECK(grey.texel(0, 0) == Rgb(0.25f));
  CHECK(grey.texel(1, 0) == Rgb(-1.0f));  // of a height
  CHECK(TexelImage::from(image_of({{"depth", {4}}}, 1, 1), "f").texel(0, 0) == Rgb(4.0f));
  CHECK_FALSE(TexelImage::from(image_of({{"Y", {1, 1}}, {"A", {1, 1}}}, 2, 1), "f").has_alpha());
  CHECK_FALSE(TexelImage::from(image_of({{"Y", {1, 1}}, {"A", {1, 0.5f}}}, 2, 1), "f").has_alpha());  // as in pbrt-v4
  CHECK_THROWS_AS(TexelImage::from(image_of({{"R", {1}}, {"G", {1}}}, 1, 1), "f"), Error);
}

TEST_CASE("NaN and infinity are errors that name the file and the pixel") {
  try {
    TexelImage::from(image_of({{"Y", {0, 0, 0, 0, kInfinity, std::nanf("")}}}, 3, 2), "sky.exr");
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.failure() == Failure::scene);
    const std::string text = error.what();
    CHECK(text.starts_with("sky.exr: 2 values of channel Y"));
    CHECK(text.find("pixel 1, 1") != std::string::npos);
  }
}

TEST_CASE("load: negative light does not exist") {
  const test::Scratch folder;
  write_exr(image_of({{"R", {-1}}, {"G", {2}}, {"B", {-3}}}, 1, 1), folder / "negative.exr");
  CHECK(TexelImage::load(folder / "negative.exr").texel(0, 0) == Rgb(0, 2, 0));
}

TEST_CASE("load: the matrix applies, unless the file states its chromaticities") {
  const test::Scratch folder;
  Image image = image_of({{"R", {1}}, {"G", {2}}, {"B", {3}}}, 1, 1);
  write_exr(image, folder / "plain.exr");
  const std::array<float, 9> swap{0, 0, 1, 0, 1, 0, 1, 0, 0};
  CHECK(TexelImage::load(folder / "plain.exr").texel(0, 0) == Rgb(1, 2, 3));
  CHECK(TexelImage::load(folder / "plain.exr", "", swap).texel(0, 0) == Rgb(3, 2, 1));
  image.chromaticities = Chromaticities{};
  write_exr(image, folder / "rec709.exr");
  CHECK(TexelImage::load(folder / "rec709.exr", "", swap).texel(0, 0) == Rgb(1, 2, 3));
  image.chromaticities = Chromaticities{{0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f}};
  for (Channel& c : image.channels) c.values = {1};
  image.channels[2].values = {0};
  write_exr(image, folder / "rec2020.exr");
  const Rgb yellow = TexelImage::load(folder / "rec2020.exr").texel(0, 0);
  CHECK(yellow.r == Approx(1.0728).epsilon(1e-3));
  CHECK(yellow.b < 0);
}

TEST_CASE("octahedral wrap comes in again through the same edge, mirrored about its middle") {
  const TexelImage image = sample();
  const auto at = [&](float x, float y) { return image.nearest({(x + 0.5f) / 4, (y + 0.5f) / 2}, Wrap::octahedral); };
  CHECK(at(2, 1) == image.texel(2, 1));
  CHECK(at(4, 0) == image.texel(3, 1));
  CHECK(at(5, 1) == image.texel(2, 0));
  CHECK(at(1, 2) == image.texel(2, 1));
  CHECK(at(-1, 0) == image.texel(1, 1));  // not 0: as in pbrt-v4
  check_rgb(image.bilinear({1, 0.25f}, Wrap::octahedral), (image.texel(3, 0) + image.texel(3, 1)) * 0.5f);
  for (const float far : {-1e9f, -1.0f, 2.0f, 1e9f, std::numeric_limits<float>::quiet_NaN()})
    for (const float other : {-1e9f, 0.3f, 1e9f}) {
      CHECK(is_finite(image.bilinear({far, other}, Wrap::octahedral)));
      CHECK(image.nearest({far, other}, Wrap::octahedral).b == 1);
    }
}
