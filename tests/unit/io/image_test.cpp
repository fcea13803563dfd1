#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "io/image_decode.h"
#include "support/scratch.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

using namespace tyndall;
using doctest::Approx;
using test::read_bytes;
using test::Scratch;
using test::write_bytes;

namespace {

const std::string kData = TYNDALL_SOURCE_DIR "/tests/unit/io/data/";

double srgb(double stored) { return stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4); }

std::string reason(const std::string& path) {
  try {
    read_image(path);
  } catch (const Error& error) {
    CHECK(error.failure() == Failure::scene);
    return error.what();
  }
  return {};
}

/// A picture of 3 x 2 pixels in shades of grey: 0, 40 ... 200 of 255.
Image grey_ramp() {
  Image image;
  image.data = image.display = {0, 0, 3, 2};
  for (const char* name : {"R", "G", "B"}) {
    Channel& c = image.add_channel(name);
    for (std::size_t i = 0; i < 6; ++i) c.values[i] = static_cast<float>(srgb(static_cast<double>(i) * 40 / 255));
  }
  return image;
}

std::string bmp_3x1(unsigned char b, unsigned char g, unsigned char r) {
  std::string file =
      std::string("BM") + std::string("\x42\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x03\0\0\0\x01\0\0\0\x01\0\x18\0", 28);
  file += std::string(24, '\0');
  for (int i = 0; i < 3; ++i) file += {static_cast<char>(b), static_cast<char>(g), static_cast<char>(r)};
  return file + std::string(3, '\0');
}

}  // namespace

TEST_CASE("an Image finds its channels and colours") {
  Image image;
  image.data = {2, 2, 5, 4};
  image.add_channel("R");
  image.add_channel("G");
  CHECK(image.width() == 3);
  CHECK(image.height() == 2);
  CHECK(image.channels[0].values == std::vector<float>(6, 0.0f));
  CHECK(image.find("B") == nullptr);
  CHECK_THROWS_AS(image.rgb(0, 0), Error);
  image.add_channel("Y").values[4] = 7;
  CHECK(image.rgb(1, 1) == Rgb(7.0f));
  image.add_channel("B").values[4] = 3;
  CHECK(image.rgb(1, 1) == Rgb(0, 0, 3));
}

TEST_CASE("a PNG comes back within its 8 bits, brighter by its exposure") {
  const Scratch folder;
  write_png(grey_ramp(), folder / "a.png");
  const Image image = read_image(folder / "a.png");
  REQUIRE(image.channels.size() == 3);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(image.find("G")->values[i] == Approx(srgb(static_cast<double>(i) * 40 / 255)).epsilon(1e-5));
    CHECK(read_image(folder / "a.png", "linear").find("G")->values[i] == Approx(static_cast<double>(i) * 40 / 255));
  }
  write_png(grey_ramp(), folder / "b.png", {.exposure = 1});
  const Image brighter = read_image(folder / "b.png");
  CHECK(brighter.rgb(1, 1).r == Approx(2 * srgb(160. / 255)).epsilon(0.01));
  CHECK(brighter.rgb(2, 1).r == 1.0f);
  CHECK(folder.file_count() == 2);
}

TEST_CASE("PNG output takes NaN and negative values for black and repeats its bytes") {
  const Scratch folder;
  Image image = grey_ramp();
  image.channels[0].values = {std::nanf(""), -1, kInfinity, 0, 0, 0};
  write_png(image, folder / "a.png");
  write_png(image, folder / "b.png");
  CHECK(read_bytes(folder / "a.png") == read_bytes(folder / "b.png"));
  const Image back = read_image(folder / "a.png");
  CHECK(back.find("R")->values == std::vector<float>{0, 0, 1, 0, 0, 0});
  CHECK_THROWS_AS(write_png(image, folder / "none/a.png"), Error);
  CHECK(encode_png(image) == read_bytes(folder / "a.png"));
  CHECK(encode_png(image, {.exposure = 1}) != read_bytes(folder / "a.png"));
  CHECK_THROWS_WITH_AS(encode_png({}), "cannot be written: the image has no pixels", Error);
  CHECK_THROWS_WITH_AS(write_png({}, "b.png"), "b.png: cannot be written: the image has no pixels", Error);
}

TEST_CASE("16-bit, palette, transparent, grey and interlaced PNG") {
  const Image wide = read_image(kData + "rgb16.png", "linear");
  CHECK(wide.rgb(0, 0).g == Approx(0x4000 / 65535.0).epsilon(1e-6));
  CHECK(wide.rgb(0, 0).b == Approx(0x8001 / 65535.0).epsilon(1e-6));
  CHECK(wide.rgb(1, 0).b == Approx(1 / 65535.0).epsilon(1e-6));
  CHECK(read_image(kData + "rgb16.png").rgb(0, 0).g == Approx(srgb(0x4000 / 65535.0)).epsilon(1e-5));

  const Image palette = read_image(kData + "palette2.png");
  CHECK(palette.rgb(0, 0) == Rgb(1, 0, 0));
  CHECK(palette.rgb(1, 0) == Rgb(0, 0, 1));
  REQUIRE(palette.find("A"));
  CHECK(palette.find("A")->values[1] == Approx(128 / 255.0));
  const Image of_texture = read_image(kData + "palette2.png", "sRGB");  // decodes alpha too, as in pbrt-v4
  CHECK(of_texture.find("A")->values[1] == Approx(srgb(128 / 255.0)).epsilon(1e-5));

  const Image grey = read_image(kData + "grey_interlaced.png", "gamma 2");
  REQUIRE(grey.channels.size() == 1);
  for (std::size_t i = 0; i < 45; ++i)
    CHECK(grey.channels[0].values[i] == Approx(std::pow(static_cast<double>(i) * 5 / 255, 2)).epsilon(1e-5));
}

TEST_CASE("JPEG, BMP, TGA and HDR") {
  const Image jpeg = read_image(kData + "halves.jpg", "linear");
  CHECK(jpeg.width() == 16);
  CHECK(jpeg.rgb(0, 4).g == Approx(200 / 255.0).epsilon(0.02));
  CHECK(jpeg.rgb(15, 4).g == Approx(50 / 255.0).epsilon(0.05));

  const Scratch folder;
  write_bytes(folder / "a.bmp", bmp_3x1(255, 51, 0));
  CHECK(read_image(folder / "a.bmp", "linear").rgb(2, 0) == Rgb(0, 51 / 255.0f, 1));

  std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x18\0", 18);  // 2 x 1, 24 bit
  tga += {char(0), char(51), char(255), char(255), char(255), char(255)};
  write_bytes(folder / "a.tga", tga);
  CHECK(read_image(folder / "a.tga", "linear").rgb(0, 0) == Rgb(1, 51 / 255.0f, 0));
  std::string with_alpha("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x20\x08", 18);  // 1 x 1, 32 bit
  with_alpha += {char(0), char(51), char(255), char(7)};
  write_bytes(folder / "b.tga", with_alpha);
  CHECK(read_image(folder / "b.tga", "linear").rgb(0, 0) == Rgb(1, 51 / 255.0f, 0));
  CHECK_FALSE(read_image(folder / "b.tga").find("A"));

  const std::string hdr = std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n") +
                          std::string("\x80\x40\x20\x81", 4) + std::string("\x80\x80\x80\x8a", 4);
  write_bytes(folder / "a.hdr", hdr);
  const Image radiance = read_image(folder / "a.hdr");
  CHECK(radiance.rgb(0, 0) == Rgb(1, 0.5f, 0.25f));
  CHECK(radiance.rgb(1, 0) == Rgb(512.0f));
}

TEST_CASE("PFM: rows from the bottom, either byte order, scaled") {
  const Scratch folder;
  const std::string one("\0\0\x80\x3f", 4), two("\0\0\0\x40", 4), eno("\x3f\x80\0\0", 4);
  write_bytes(folder / "colour.pfm", "PF\n1 2\n-1.0\n" + one + two + two + two + one + one);
  const Image colour = read_image(folder / "colour.pfm");
  CHECK(colour.rgb(0, 0) == Rgb(2, 1, 1));
  CHECK(colour.rgb(0, 1) == Rgb(1, 2, 2));
  CHECK(read_image_size(folder / "colour.pfm").height == 2);
  write_bytes(folder / "grey.pfm", "Pf 2 1 3\n" + eno + eno);
  CHECK(read_image(folder / "grey.pfm").rgb(1, 0) == Rgb(3));
  for (const std::string head : {"PF\n1 x\n-1\n", "PF\n1 0\n-1\n", "PF\n1 70000\n-1\n", "PF\n1 1\n0\n", "PF\n1 2\n-1\n"}) {
    write_bytes(folder / "bad.pfm", head + one + one + one);
    CHECK(reason(folder / "bad.pfm").find("bad.pfm: cannot be read") != std::string::npos);
  }
}

TEST_CASE("files that are cut off or no images are refused with their name") {
  const Scratch folder;
  write_png(grey_ramp(), folder / "a.png");
  write_bytes(folder / "a.bmp", bmp_3x1(1, 2, 3));
  write_bytes(folder / "a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + std::string(8, '\x80'));
  for (const std::string& path : {folder / "a.png", folder / "a.bmp", folder / "a.hdr", kData + "halves.jpg"}) {
    CAPTURE(path);
    const std::string bytes = read_bytes(path);
    const std::size_t padding = path.ends_with("bmp") ? 3 : 0;  // of its only row
    const std::string cut = folder / "cut";
    for (std::size_t length = 0; length + padding < bytes.size(); ++length) {
      CAPTURE(length);
      write_bytes(cut, bytes.substr(0, length));
      const std::string text = reason(cut);
      CHECK(text.starts_with(cut + ": "));
      CHECK(std::count(text.begin(), text.end(), '\n') < 3);
    }
  }
  CHECK(reason(folder / "none.png").starts_with(folder / "none.png"));
  write_bytes(folder / "text.png", "no image at all, but a few words that are long enough");
  CHECK(reason(folder / "text.png").find("text.png") != std::string::npos);
}

TEST_CASE("a flipped byte of a PNG is noticed") {
  const Scratch folder;
  write_png(grey_ramp(), folder / "a.png");
  const std::string bytes = read_bytes(folder / "a.png");
  for (std::size_t at = 8; at < bytes.size() - 4; ++at) {  // the last chunk's checksum guards nothing
    CAPTURE(at);
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    write_bytes(folder / "flipped.png", flipped);
    if (reason(folder / "flipped.png").empty()) {
      const Image image = read_image(folder / "flipped.png");
      CHECK(image.find("R")->values == read_image(folder / "a.png").find("R")->values);
    }
  }
}

TEST_CASE("encodings are parsed as pbrt names them") {
  CHECK(parse_encoding("", "f").kind == Encoding::Kind::srgb);
  CHECK(parse_encoding("sRGB", "f").kind == Encoding::Kind::srgb);
  CHECK(parse_encoding("linear", "f").kind == Encoding::Kind::linear);
  CHECK(parse_encoding("gamma 1.8", "f").gamma == 1.8f);
  for (const char* wrong : {"srgb2", "gamma", "gamma ", "gamma x", "gamma -1", "gamma 0", "gamma 2.2 "})
    CHECK_THROWS_AS(parse_encoding(wrong, "f"), Error);
  CHECK(Encoding{}.decode(1) == 1.0f);
  CHECK(Encoding{}.decode(0.5f) == Approx(0.21404).epsilon(1e-4));
}

TEST_CASE("describe names an image's channels and their range") {
  const Scratch folder;
  Image image = grey_ramp();
  image.channels[0].values[3] = std::nanf("");
  write_exr(image, folder / "a.exr");
  const Description d = describe(folder / "a.exr");
  CHECK(d.kind == "OpenEXR image");
  const auto value = [&](const std::string& subject, const std::string& name) {
    for (const Property& p : d.properties)
      if (p.subject == subject && p.name == name) return p.value;
    return std::string("none");
  };
  CHECK(value("image", "data window") == "3 x 2 at 0, 0");
  CHECK(value("image", "compression") == "zip");
  CHECK(value("R", "type") == "float");
  CHECK(value("R", "values").find("1 NaN or infinite") != std::string::npos);
  CHECK(value("G", "values").find("min 0, max 0.57") != std::string::npos);
  CHECK_THROWS_AS(describe(folder / "none.exr"), Error);
}
