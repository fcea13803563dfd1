/// Mattes: kept beside a picture whose bits do not know of them, each covers what it is the matte of.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <map>

#include "support/measure.h"
#include "support/sanitized.h"
#include "support/scene_text.h"
#include "tyndall/cryptomatte.h"
#include "tyndall/io.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

const std::vector<std::string> kAll{"CryptoObject", "CryptoMaterial", "CryptoMedium"};

/// As the specification says how a matte is taken out of an image: the name's hash as a float, compared with the ids of all
/// ranks. Written anew, and not by what wrote the image.
class Decoder {
 public:
  Decoder(const Image& image, const std::string& layer) : image_(image), layer_(layer) {}

  std::vector<float> matte(const std::string& name) const {
    std::uint32_t bits = hash(name);
    const std::uint32_t exponent = bits >> 23 & 255;
    if (exponent == 0 || exponent == 255) bits ^= 1u << 23;
    return covered(std::bit_cast<float>(bits));
  }
  /// Of all ids together.
  std::vector<float> anybody() const { return covered(std::nullopt); }

 private:
  static std::uint32_t hash(const std::string& name) {
    const auto rotated = [](std::uint32_t x, int r) { return (x << r) | (x >> (32 - r)); };
    std::uint32_t h = 0;
    for (std::size_t at = 0; at < name.size(); at += 4) {
      std::uint32_t k = 0;
      const std::size_t count = std::min<std::size_t>(4, name.size() - at);
      for (std::size_t i = 0; i < count; ++i) k |= std::uint32_t{static_cast<unsigned char>(name[at + i])} << (8 * i);
      k *= 0xcc9e2d51;
      k = rotated(k, 15);
      k *= 0x1b873593;
      h ^= k;
      if (count == 4) h = rotated(h, 13) * 5 + 0xe6546b64;
    }
    h ^= static_cast<std::uint32_t>(name.size());
    h ^= h >> 16;
    h *= 0x85ebca6b;
    h ^= h >> 13;
    h *= 0xc2b2ae35;
    return h ^ (h >> 16);
  }

  std::vector<float> covered(std::optional<float> id) const {
    std::vector<float> sum(image_.data.size());
    for (const char* level : {"00", "01", "02"}) {
      for (const auto& [ids, coverage] : {std::pair{".R", ".G"}, std::pair{".B", ".A"}}) {
        const Channel *a = image_.find(layer_ + level + ids), *b = image_.find(layer_ + level + coverage);
        REQUIRE(a);
        REQUIRE(b);
        for (std::size_t i = 0; i < sum.size(); ++i) {
          if (!id || a->values[i] == *id) sum[i] += b->values[i];
        }
      }
    }
    return sum;
  }

  const Image& image_;
  std::string layer_;
};

double mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += static_cast<double>(v);
  return sum / static_cast<double>(values.size());
}

std::string named(const std::string& name, const std::string& text) {
  return block("Attribute \"shape\" \"string name\" \"" + name + "\"\n" + text);
}

std::string square(float x0, float x1, float z) {
  const std::string a = number(x0), b = number(x1), c = number(z);
  return "Shape \"trianglemesh\" \"point3 P\" [" + a + " -1 " + c + " " + b + " -1 " + c + " " + b + " 1 " + c + " " + a +
         " 1 " + c + "] \"integer indices\" [0 1 2 0 2 3]\n";
}

/// A frame that is the square from -1 to 1.
View window(int resolution) {
  return {.eye = {0, 0, -4}, .look = {}, .half_width = 1, .resolution = resolution, .max_depth = 3};
}

}  // namespace

TEST_CASE("mattes leave the picture as it is, bit for bit") {
  constexpr int kSpp = kSanitized ? 2 : 5;
  const Coefficients smoke{.sigma_a = {0.2f, 0.1f, 0.4f}, .sigma_s = {2, 1, 0.6f}, .g = 0.5f, .Le = {0.1f, 0, 0}};
  const std::string scene =
      view({.eye = {1.6f, 1.2f, -3.2f}, .look = {0, -0.1f, 0}, .fov_degrees = 42, .resolution = 24, .max_depth = 5}) +
      point_light({1.5f, 2, -1.5f}, 6) + emitting_square({-1.2f, 0.8f, 1.4f}, 0.5f, 4) + environment(0.15f) +
      diffuse_plane(1.8f, 4, 0.6f) + homogeneous("m", smoke) + medium_box("m", "", {{-1, -1, -1}, {1, 1, 1}});
  for (const ReuseStrategy reuse : {ReuseStrategy::off, ReuseStrategy::pixels}) {
    Subject subject(scene, {.reuse = reuse});
    const std::vector<std::string> others{"Albedo", "Z", "Transmittance", "Variance"};
    std::vector<std::string> all = others;
    all.insert(all.end(), kAll.begin(), kAll.end());
    const Image with = subject.render(kSpp, 3, all), without = subject.render(kSpp, 3, others);
    CHECK(with.channels.size() == without.channels.size() + 36);
    for (const Channel& c : without.channels) CHECK_MESSAGE(with.find(c.name)->values == c.values, c.name);
    CHECK(subject.faults() == "");
  }
}

TEST_CASE("objects and materials cover the part of a pixel that shows them, by the pixel's filter") {
  const std::string scene =
      view(window(10)) + environment(1) +
      "MakeNamedMaterial \"red\" \"string type\" \"diffuse\"\nMakeNamedMaterial \"w\xc3\xa4nde\" \"string type\" "
      "\"conductor\"\n" +
      named("left", "NamedMaterial \"red\"\n" + square(-1, -0.25f, 0)) +
      named("right", "NamedMaterial \"w\xc3\xa4nde\"\n" + square(-0.25f, 0.5f, 0.1f)) +
      named("strip", "NamedMaterial \"red\"\n" + square(-0.01f, 0.03f, -0.5f));
  const Image image = Subject(scene).render(fewer(1024), 1, kAll);
  const Decoder objects(image, "CryptoObject"), materials(image, "CryptoMaterial");
  const auto left = objects.matte("left"), right = objects.matte("right"), strip = objects.matte("strip");
  const double precision = 0.01 * kCoarser;
  // Pixels are 0.2 wide; the camera looks along +z with x to the left or right, which the sums do not tell.
  CHECK(mean(left) == doctest::Approx(0.375).epsilon(precision));
  CHECK(mean(right) == doctest::Approx(0.375 - 0.02).epsilon(precision));
  CHECK(mean(strip) == doctest::Approx(0.02).epsilon(3 * precision));
  CHECK(mean(objects.anybody()) == doctest::Approx(0.75).epsilon(precision));
  CHECK(mean(materials.matte("red")) == doctest::Approx(0.395).epsilon(precision));
  CHECK(mean(materials.matte("w\xc3\xa4nde")) == doctest::Approx(0.355).epsilon(precision));
  CHECK(mean(Decoder(image, "CryptoMedium").anybody()) == 0);
  for (std::size_t i = 0; i < left.size(); ++i) {
    const double both = static_cast<double>(left[i]) + static_cast<double>(right[i]) + static_cast<double>(strip[i]);
    CHECK(both <= 1.0001);
    CHECK(static_cast<double>(image.find("A")->values[i]) == doctest::Approx(both).epsilon(1e-5));
  }
}

TEST_CASE("smoke covers by its opacity, and what is behind it by what is left") {
  const Coefficients smoke{.sigma_a = Rgb(0.2f), .sigma_s = {0.3f, 0.1f, 0.5f}};
  Grid even{{{-3, -3, -1}, {3, 3, 1}}, 4, 4, 8, std::vector<float>(128, 1)};
  const double length = 1.6, through = (std::exp(-0.5 * length) + std::exp(-0.3 * length) + std::exp(-0.7 * length)) / 3;
  for (const bool grid : {false, true}) {
    const std::string scene =
        view(window(8)) + environment(1) + (grid ? uniform_grid("smoke", smoke, even) : homogeneous("smoke", smoke)) +
        medium_box("smoke", "", {{-2, -2, -0.8f}, {0, 2, 0.8f}}) + named("wall", diffuse_plane(2, 3, 0.5f));
    const Image image = Subject(scene).render(fewer(400), 1, kAll);
    const auto in_smoke = Decoder(image, "CryptoMedium").matte("smoke"), wall = Decoder(image, "CryptoObject").matte("wall");
    for (std::size_t i = 0; i < wall.size(); ++i) {
      const bool smoky = in_smoke[i] > 0;
      CHECK(static_cast<double>(wall[i]) == doctest::Approx(smoky ? through : 1).epsilon(grid ? 0.02 * kCoarser : 1e-5));
      CHECK(static_cast<double>(wall[i]) + static_cast<double>(in_smoke[i]) == doctest::Approx(1).epsilon(1e-5));
    }
    CHECK(mean(in_smoke) == doctest::Approx(0.5 * (1 - through)).epsilon(0.02 * kCoarser));
  }
}

TEST_CASE("the manifest names everybody: by name, by object, by number") {
  const std::string scene = view(window(4)) + environment(1) + "ObjectBegin \"tree\"\n" + square(-1, 0, 0) +
                            "Shape \"sphere\" \"string name\" \"apple\" \"float radius\" 0.1\nObjectEnd\n" +
                            square(0.2f, 0.4f, 0) + block("Translate 0.5 0 0\nObjectInstance \"tree\"\n") +
                            block("Translate 0.6 0 1\nObjectInstance \"tree\"\n") + named("floor", square(-1, 1, 5)) +
                            homogeneous("fog", {.sigma_s = Rgb(1)}) + medium_box("fog", "", {{-1, -1, 2}, {1, 1, 3}});
  const Image image = Subject(scene).render(4, 1, kAll);
  const auto manifest = [&](const char* layer) { return *image.attribute<std::string>(manifest_attribute(layer)); };
  for (const char* name : {"apple", "tree", "shape.1", "floor"}) {
    char hex[9];
    std::snprintf(hex, sizeof hex, "%08x", matte_id(name));
    CHECK(manifest("CryptoObject").find("\"" + std::string(name) + "\":\"" + hex + "\"") != std::string::npos);
  }
  CHECK(manifest("CryptoMedium").find("\"fog\":") != std::string::npos);
  CHECK(manifest("CryptoMaterial").find("\"material.0\":") != std::string::npos);
  CHECK(mean(Decoder(image, "CryptoObject").matte("tree")) > 0.3);
}
