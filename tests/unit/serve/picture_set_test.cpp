#include "serve/picture_set.h"

#include <doctest/doctest.h>

#include <cmath>

#include "report/page_picture.h"

namespace tyndall {
namespace {

std::shared_ptr<const Image> image_of(const std::vector<std::string>& channels) {
  auto image = std::make_shared<Image>();
  image->data = image->display = {0, 0, 2, 1};
  float value = 0;
  for (const std::string& name : channels)
    for (float& v : image->add_channel(name).values) v = value++;
  return image;
}

std::string names_of(const std::vector<ServedPicture>& pictures) {
  std::string names;
  for (const ServedPicture& p : pictures) names += p.name + std::to_string(p.channels.size()) + " ";
  return names;
}

TEST_CASE("picture set: R G B and AOVs, each by its name") {
  CHECK(names_of(pictures_of(image_of({"R", "G", "B", "A", "Albedo.R", "Albedo.G", "Albedo.B", "N.X", "N.Y", "N.Z", "Z", "Zvol",
                                       "SurfaceCount", "VolumeCount", "SampleCount", "LightGroup.key.R", "LightGroup.key.G",
                                       "LightGroup.key.B"}))) == "rendered3 Albedo3 N3 Z1 Zvol1 SampleCount1 LightGroup.key3 ");
}

TEST_CASE("picture set: denoised stands beside rendered, replicates and sums are left out") {
  CHECK(names_of(pictures_of(image_of({"R", "G", "B", "Mse.R", "Mse.G", "Mse.B", "noisy.R", "noisy.G", "noisy.B", "Replicate.R",
                                       "Sum.0.high"}))) == "rendered3 denoised3 Mse3 ");
}

TEST_CASE("picture set: planes one after the other, as halves, low byte first") {
  const auto image = image_of({"R", "G", "B"});
  const std::string bytes = halves_of(pictures_of(image).at(0));
  REQUIRE(bytes.size() == 12);
  for (std::size_t i = 0; i < 6; ++i) {
    const int half = static_cast<unsigned char>(bytes[2 * i]) | static_cast<unsigned char>(bytes[2 * i + 1]) << 8;
    CHECK(half == to_half(static_cast<float>(i)));
  }
}

}  // namespace
}  // namespace tyndall
