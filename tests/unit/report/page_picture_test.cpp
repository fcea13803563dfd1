#include "report/page_picture.h"

#include <doctest/doctest.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <random>

#include "tyndall/error.h"

using namespace tyndall;

namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

/// By the definition of binary16.
double from_half(std::uint16_t half) {
  const int exponent = (half >> 10) & 31, fraction = half & 1023;
  const double sign = half & 0x8000 ? -1 : 1;
  if (exponent == 31) return fraction ? std::nan("") : sign * std::numeric_limits<double>::infinity();
  return sign * (exponent ? std::ldexp(1024 + fraction, exponent - 25) : std::ldexp(fraction, -24));
}

std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  return bytes;
}

Image noise(int width, int height) {
  std::mt19937 engine(1);
  std::lognormal_distribution<float> values(0, 1);
  Image image;
  image.data = image.display = {0, 0, width, height};
  for (const char* name : {"B", "G", "R"})
    for (float& v : image.add_channel(name).values) v = values(engine);
  return image;
}

}  // namespace

TEST_CASE("every half float comes back as itself") {
  for (int bits = 0; bits < 65536; ++bits) {
    const double value = from_half(static_cast<std::uint16_t>(bits));
    if (std::isnan(value))
      CHECK(std::isnan(from_half(to_half(static_cast<float>(value)))));
    else
      REQUIRE(to_half(static_cast<float>(value)) == bits);
  }
}

TEST_CASE("floats go to the nearest half float, ties to even, and stay in range") {
  for (int bits = 0; bits < 0x7bff; ++bits) {
    const double low = from_half(static_cast<std::uint16_t>(bits)), high = from_half(static_cast<std::uint16_t>(bits + 1));
    const auto middle = static_cast<float>((low + high) / 2);  // exact
    REQUIRE(to_half(middle) == bits + (bits & 1));
    REQUIRE(to_half(std::nextafter(middle, 0.0f)) == bits);
    REQUIRE(to_half(std::nextafter(middle, kInf)) == bits + 1);
  }
  CHECK(to_half(65519) == 0x7bff);
  CHECK(to_half(65520) == 0x7bff);
  CHECK(to_half(-1e30f) == 0xfbff);
  CHECK(to_half(kInf) == 0x7c00);
  CHECK(to_half(1e-30f) == 0);
  CHECK(std::isnan(from_half(to_half(std::nanf("")))));
}

TEST_CASE("base64: the vectors of RFC 4648") {
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string("\xff\xfe\x00", 3)) == "//4A");
}

TEST_CASE("a picture unfolds to the planes it was made of, R first") {
  const Image image = noise(13, 7);
  const std::string packed = from_base64(encode_picture(image));
  std::string bytes(6 * 13 * 7, '\0');
  uLongf size = bytes.size();
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                     packed.size()) == Z_OK);
  REQUIRE(size == bytes.size());
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 91; ++i) {
      const auto high = static_cast<unsigned char>(bytes[182 * k + i]),
                 low = static_cast<unsigned char>(bytes[182 * k + 91 + i]);
      const float value = image.channels[2 - k].values[i];
      REQUIRE(from_half(static_cast<std::uint16_t>(high << 8 | low)) == doctest::Approx(value).epsilon(5e-4));
    }
  }
}

TEST_CASE("even a noisy picture takes less than seven bytes a pixel") {
  CHECK(encode_picture(noise(320, 180)).size() < 7 * 320 * 180);
}

TEST_CASE("a picture without pixels or colour is refused") {
  CHECK_THROWS_AS(encode_picture(Image{}), Error);
  Image depth;
  depth.data = {0, 0, 2, 2};
  depth.add_channel("Z");
  CHECK_THROWS_AS(encode_picture(depth), Error);
}
