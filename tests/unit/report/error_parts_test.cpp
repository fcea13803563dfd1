/// Shares of a picture's error, of pictures whose noise is known.
#include "report/error_parts.h"

#include <doctest/doctest.h>

#include <string>

namespace tyndall {
namespace {

constexpr int kPixels = 2;

Image with_channels(const std::string& prefix, float value) {
  Image image;
  image.data = image.display = {0, 0, kPixels, 1};
  for (const char* color : {"R", "G", "B"}) {
    image.add_channel(prefix + color);
    image.channels.back().values.assign(kPixels, value);
  }
  return image;
}

/// Every part has the value 1, but direct light of surfaces and indirect light of media.
Image picture(float surface, float medium) {
  Image image;
  image.data = image.display = {0, 0, kPixels, 1};
  for (const std::string part : kLightParts) {
    const float value = part == "SurfaceDirect" ? surface : part == "VolumeIndirect" ? medium : 1;
    for (const Channel& c : with_channels(part + ".", value).channels) image.channels.push_back(c);
  }
  return image;
}

TEST_CASE("a picture's error has the shares of the parts that differ from seed to seed") {
  const Image reference = with_channels("", 2);
  ErrorParts parts(reference);
  CHECK_FALSE(parts.shares());
  parts.add(picture(1, 1));
  CHECK_FALSE(parts.shares());  // one picture does not differ
  parts.add({});                // given up
  parts.add(picture(2, 1.5f));
  parts.add(picture(1, 1));
  const auto shares = parts.shares();
  REQUIRE(shares);
  CHECK((*shares)[1] == doctest::Approx(0.8));  // surfaces, direct: differences of 1 against 0.5, squared
  CHECK((*shares)[4] == doctest::Approx(0.2));
  CHECK((*shares)[0] == 0);
}

TEST_CASE("differences count as relMSE counts them: against the reference's brightness") {
  Image reference = with_channels("", 10);
  for (Channel& c : reference.channels) c.values[1] = 0;
  ErrorParts parts(reference);
  Image first = picture(0, 0), second = picture(0, 0);
  for (Channel& c : second.channels) {
    if (c.name.starts_with("SurfaceDirect")) c.values[0] = 10;  // where it is bright
    if (c.name.starts_with("VolumeIndirect")) c.values[1] = 0.1f;
  }
  parts.add(first);
  parts.add(second);
  const auto shares = parts.shares();
  REQUIRE(shares);
  CHECK((*shares)[1] == doctest::Approx(0.5).epsilon(1e-3));
  CHECK((*shares)[4] == doctest::Approx(0.5).epsilon(1e-3));
}

}  // namespace
}  // namespace tyndall
