#include "tyndall/image_format.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "io/exr.h"
#include "io/exr_layout.h"
#include "support/scratch.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

using doctest::Approx;
using test::Scratch;

/// A render's channels, out of order, with what halves cannot hold.
Image sample() {
  Image image;
  image.data = {3, -2, 20, 9};
  image.display = {0, 0, 32, 16};
  for (const char* name : {"Albedo.B", "R", "Z", "Albedo.G", "Variance.R", "B", "A", "Albedo.R", "G", "P.X"}) {
    std::vector<float>& values = image.add_channel(name).values;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = std::sin(static_cast<float>(i * image.channels.size())) * 3 + 3.1f;
  }
  image.attributes["tyndall/samples"] = 4;
  return image;
}

bool same_channels(const Image& a, const Image& b) {
  if (a.channels.size() != b.channels.size()) return false;
  for (const Channel& c : a.channels)
    if (!b.find(c.name) || b.find(c.name)->values != c.values) return false;
  return true;
}

TEST_CASE("every lossless packing of an EXR comes back bit by bit, in one part or several") {
  const Scratch folder;
  const Image image = sample();
  for (const auto c :
       {ExrCompression::none, ExrCompression::rle, ExrCompression::zips, ExrCompression::zip, ExrCompression::piz}) {
    for (const bool parts : {false, true}) {
      write_exr(image, folder / "a.exr", {.compression = c, .parts = parts});
      const ExrFile file = read_exr(folder / "a.exr");
      CHECK(file.compression == exr_compression_names()[static_cast<std::size_t>(c)]);
      CHECK(file.parts == (parts ? 5 : 1));
      CHECK(same_channels(image, file.image));
      CHECK(file.image.data == image.data);
      CHECK(file.image.display == image.display);
      CHECK(file.image.attributes == image.attributes);
      CHECK(read_exr_header(folder / "a.exr").channels.size() == image.channels.size());
    }
  }
}

TEST_CASE("lossy packing keeps windows, channels and about the values") {
  const Scratch folder;
  const Image image = sample();
  for (const auto c : {ExrCompression::dwaa, ExrCompression::dwab}) {
    write_exr(image, folder / "a.exr", {.half = true, .compression = c});
    const ExrFile file = read_exr(folder / "a.exr");
    CHECK(file.compression == exr_compression_names()[static_cast<std::size_t>(c)]);
    CHECK(file.image.find("Z")->values == image.find("Z")->values);  // no colour: packed without loss
    const auto &r = image.find("R")->values, &read = file.image.find("R")->values;
    for (std::size_t i = 0; i < r.size(); ++i) CHECK(read[i] == Approx(r[i]).epsilon(0.5));
  }
}

TEST_CASE("the parts of a file are the groups of its channels, the picture first") {
  const Image image = sample();
  const auto parts = parts_of(image, true);
  REQUIRE(parts.size() == 5);
  CHECK(parts[0].name == "rgba");
  CHECK(parts[0].channels == std::vector<std::size_t>{1, 5, 6, 8});
  CHECK(parts[1].name == "Albedo");
  CHECK(parts[1].channels == std::vector<std::size_t>{0, 3, 7});
  CHECK(parts[2].name == "Z");
  CHECK(parts_of(image, false).size() == 1);
}

TEST_CASE("parts that another program wrote are read together, or refused") {
  const Image image = read_image(TYNDALL_SOURCE_DIR "/tests/unit/io/data/multi_part.exr");
  REQUIRE(image.channels.size() == 2);  // both parts have a channel Y
  CHECK(image.channels[0].name == "Y");
  CHECK(image.channels[1].name == "b.Y");

  const Scratch folder;
  write_exr(sample(), folder / "a.exr", {.parts = true});
  std::string bytes = read_file(folder / "a.exr");
  const std::string key("dataWindow\0box2i\0\x10\0\0\0", 21);
  const std::size_t second = bytes.find(key, bytes.find(key) + 1);
  REQUIRE(second != std::string::npos);
  bytes[second + key.size() + 8] = 18;  // one column less
  write_file(bytes, folder / "other.exr");
  CHECK_THROWS_WITH_AS(
      read_exr(folder / "other.exr"),
      ((folder / "other.exr") + ": has parts of different data windows, which are not read; save the one you want by itself")
          .c_str(),
      Error);
}

TEST_CASE("halves hold colours to 11 bits, and what is no colour stays a float") {
  const Scratch folder;
  Image image = sample();
  Channel& r = image.channels[1];
  r.values[0] = 1e6f;
  r.values[1] = -kInfinity;
  r.values[2] = std::nanf("");
  r.values[3] = 1 + 0x1p-12f;
  r.values[4] = 65519.9f;
  write_exr(image, folder / "a.exr", {.half = true});
  const ExrFile file = read_exr(folder / "a.exr");
  for (std::size_t i = 0; i < file.image.channels.size(); ++i) {
    const std::string& name = file.image.channels[i].name;
    const bool colour = name != "Z" && name != "P.X" && name != "Variance.R";
    CHECK_MESSAGE(file.channel_types[i] == (colour ? "half" : "float"), name);
    if (!colour) CHECK(file.image.channels[i].values == image.find(name)->values);
  }
  const std::vector<float>& read = file.image.find("R")->values;
  CHECK(read[0] == 65504);
  CHECK(read[1] == -65504);
  CHECK(std::isnan(read[2]));
  CHECK(read[3] == 1);
  CHECK(read[4] == 65504);
  for (std::size_t i = 5; i < read.size(); ++i) CHECK(std::abs(read[i] - r.values[i]) <= r.values[i] * 0x1p-11f);
}

TEST_CASE("a file of several parts that is damaged or cut off is refused") {
  const Scratch folder;
  write_exr(sample(), folder / "a.exr", {.parts = true});
  const std::string bytes = read_file(folder / "a.exr");
  for (std::size_t size = 0; size < bytes.size(); size += bytes.size() / 60 + 1) {
    write_file(bytes.substr(0, size), folder / "cut.exr");
    CHECK_THROWS_AS(read_exr(folder / "cut.exr"), Error);
  }
}

TEST_CASE("a map of floats comes back, grey and coloured, whichever way is up") {
  const Scratch folder;
  const Image image = sample();
  write_pfm(image, folder / "a.pfm");
  const Image read = read_image(folder / "a.pfm");
  REQUIRE(read.channels.size() == 3);
  for (const char* name : {"R", "G", "B"}) CHECK(read.find(name)->values == image.find(name)->values);
  Image grey;
  grey.data = {0, 0, 3, 2};
  grey.add_channel("Y").values = {1, 2, 3, 4, 5, 6};
  write_pfm(grey, folder / "grey.pfm");
  CHECK(read_image(folder / "grey.pfm").find("Y")->values == grey.find("Y")->values);
  CHECK_THROWS_AS(write_pfm({}, folder / "none.pfm"), Error);
}

TEST_CASE("the ending says what is written") {
  const Scratch folder;
  const Image image = sample();
  for (const char* name : {"a.exr", "a.png", "a.pfm"}) {
    CHECK(is_written_image(folder / name));
    write_image(image, folder / name, {.exr = {.half = true}, .png = {.exposure = 1}});
    CHECK(read_image(folder / name).width() == image.width());
  }
  CHECK(describe(folder / "a.png").kind == "PNG image");
  CHECK(describe(folder / "a.png").properties[0].value == "8-bit RGB, taken as sRGB");
  CHECK(describe(folder / "a.pfm").kind == "portable float map");
  CHECK(describe(folder / "a.pfm").properties[0].value == "32-bit float RGB");
  CHECK(!is_written_image("a.tif"));
  CHECK_THROWS_WITH_AS(write_image(image, "a.tif"),
                       "a.tif: is no image that can be written; give a name that ends in .exr, .png or .pfm", Error);
  CHECK(folder.file_count() == 3);
}

// ------------------------------------------------------------------------------------------------ views

TEST_CASE("all views take black to black, light to more light, and stay in [0, 1]") {
  for (const DisplayView view : {DisplayView::srgb, DisplayView::filmic, DisplayView::agx}) {
    CHECK(max_component(displayed(Rgb(0.0f), view)) < 0.002f);
    float last = -1;
    for (float stops = -14; stops < 10; stops += 0.25f) {
      const Rgb c = displayed(Rgb(std::exp2(stops)), view);
      CHECK(c.g >= last);
      CHECK(c.g <= 1);
      last = c.g;
    }
    for (const float odd : {-1.0f, -kInfinity, std::nanf("")}) CHECK(max_component(displayed(Rgb(odd), view)) < 0.002f);
    const Rgb bright = displayed(Rgb(kInfinity), view);
    CHECK(bright.r > 0.97f);
    CHECK(bright.r <= 1);
  }
}

TEST_CASE("views give the values of their sources") {
  CHECK(displayed({0.5f, 2, 0.001f}, DisplayView::srgb).r == Approx(0.735357).epsilon(1e-5));
  CHECK(displayed({0.5f, 2, 0.001f}, DisplayView::srgb).g == Approx(1).epsilon(1e-6));
  CHECK(displayed({0.5f, 2, 0.001f}, DisplayView::srgb).b == Approx(0.01292).epsilon(1e-5));

  // Hable, by hand in double precision; 5.6 is white.
  const auto f = [](double x) { return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3; };
  const double linear = f(2 * 0.18) / f(11.2);
  CHECK(displayed(Rgb(0.18f), DisplayView::filmic).r == Approx(1.055 * std::pow(linear, 1 / 2.4) - 0.055).epsilon(1e-4));
  CHECK(displayed(Rgb(5.6f), DisplayView::filmic).r == Approx(1).epsilon(1e-4));

  // AgX: 0.18 lies 10 of its 16.5 stops above the lowest, where the polynomial is 0.4614 (by hand, in double precision).
  const double x = (std::log2(0.18) + 12.47393) / 16.5;
  const double grey = ((((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x) - 0.00232;
  CHECK(displayed(Rgb(0.18f), DisplayView::agx).g == Approx(grey).epsilon(2e-3));  // the matrices' rows sum to 1 within 2e-4
  // Colours as bright as this one go to white, where the other views keep a pure channel.
  const Rgb blue = displayed({0, 0, 50}, DisplayView::agx);
  CHECK(blue.r > 0.3f);
  CHECK(blue.b > blue.r);
  CHECK(displayed({0, 0, 50}, DisplayView::filmic).r < 1e-5f);
}

TEST_CASE("a PNG shows colours of other primaries as they are") {
  const Scratch folder;
  Image image;
  image.data = image.display = {0, 0, 1, 1};
  // Rec.709's (0.25, 0.5, 0.125) in Rec.2020.
  const float in_2020[] = {0.25f * 0.627404f + 0.5f * 0.329283f + 0.125f * 0.043313f,
                           0.25f * 0.069097f + 0.5f * 0.919540f + 0.125f * 0.011362f,
                           0.25f * 0.016391f + 0.5f * 0.088013f + 0.125f * 0.895595f};
  for (int i = 0; i < 3; ++i) image.add_channel(std::string(1, "RGB"[i])).values = {in_2020[i]};
  image.chromaticities = Chromaticities{{0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f}};
  write_png(image, folder / "a.png");
  const Rgb shown = read_image(folder / "a.png").rgb(0, 0);
  CHECK(shown.r == Approx(0.25).epsilon(0.02));
  CHECK(shown.g == Approx(0.5).epsilon(0.02));
  CHECK(shown.b == Approx(0.125).epsilon(0.02));
}

TEST_CASE("a PNG shows light without bounds as white") {
  const Scratch folder;
  Image image;
  image.data = image.display = {0, 0, 1, 1};
  const float light[] = {1e6f, 1e30f, 1e-9f};
  for (int i = 0; i < 3; ++i) image.add_channel(std::string(1, "RGB"[i])).values = {light[i]};
  image.chromaticities = Chromaticities();
  for (const DisplayView view : {DisplayView::srgb, DisplayView::filmic, DisplayView::agx}) {
    write_png(image, folder / "a.png", {.exposure = 64, .view = view});
    const Rgb shown = read_image(folder / "a.png").rgb(0, 0);
    CHECK(std::min({shown.r, shown.g, shown.b}) > 0.9f);
  }
}

}  // namespace
}  // namespace tyndall
