#include <doctest/doctest.h>

#include <cstring>

#include "support/scratch.h"
#include "tyndall/deep_image.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

using namespace tyndall;
using test::read_bytes;
using test::Scratch;
using test::write_bytes;

namespace {

/// A crop of a larger frame, some pixels without a sample.
DeepImage ramp(int width, int height) {
  DeepImage image;
  image.data = {-3, 5, width - 3, height + 5};
  image.display = {0, 0, 100, 90};
  for (std::size_t pixel = 0; pixel < image.data.size(); ++pixel) {
    image.counts.push_back(static_cast<std::uint32_t>(pixel * 7 % 5));
    for (std::uint32_t i = 0; i < image.counts.back(); ++i) {
      const float z = static_cast<float>(i) + 0.5f;
      image.samples.push_back({z, i % 2 ? z : z + 0.25f, {0.1f * z, -1, 1e-42f, 0.5f}});
    }
  }
  image.attributes["software"] = std::string("Tyndall");
  image.attributes["tyndall/samples"] = 64;
  image.chromaticities = Chromaticities{{0.708f, 0.292f}, {0.17f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.329f}};
  return image;
}

std::string refusal(const std::string& path) {
  try {
    read_deep_exr(path);
  } catch (const Error& error) {
    CHECK(error.failure() == Failure::scene);
    return error.what();
  }
  return "read";
}

}  // namespace

TEST_CASE("a deep EXR comes back as it was written, bit by bit") {
  const Scratch folder;
  const DeepImage image = ramp(13, 9);
  write_deep_exr(image, folder / "a.exr");
  CHECK(folder.file_count() == 1);
  CHECK(is_deep_exr(folder / "a.exr"));
  const DeepImage read = read_deep_exr(folder / "a.exr");
  CHECK(read.data == image.data);
  CHECK(read.display == image.display);
  CHECK(read.counts == image.counts);
  REQUIRE(read.samples.size() == image.samples.size());
  CHECK(std::memcmp(read.samples.data(), image.samples.data(), image.samples.size() * sizeof image.samples[0]) == 0);
  CHECK(read.attributes == image.attributes);
  REQUIRE(read.chromaticities);
  CHECK(read.chromaticities->red.x == 0.708f);
}

TEST_CASE("a deep image of no samples at all is one") {
  const Scratch folder;
  DeepImage image = ramp(300, 200);
  image.counts.assign(image.counts.size(), 0);
  image.samples.clear();
  write_deep_exr(image, folder / "a.exr");
  CHECK(read_deep_exr(folder / "a.exr").counts == image.counts);
}

TEST_CASE("flat and deep files are told apart") {
  const Scratch folder;
  Image flat;
  flat.data = flat.display = {0, 0, 4, 4};
  for (const char* name : {"R", "G", "B", "A"}) flat.add_channel(name);
  write_exr(flat, folder / "flat.exr");
  CHECK_FALSE(is_deep_exr(folder / "flat.exr"));
  CHECK_FALSE(is_deep_exr(folder / "missing.exr"));
  CHECK(refusal(folder / "flat.exr").starts_with(folder / "flat.exr:"));
  write_deep_exr(ramp(3, 2), folder / "deep.exr");
  CHECK_THROWS_WITH_AS(read_image(folder / "deep.exr"), doctest::Contains("tyndall flatten"), Error);
  CHECK(describe(folder / "deep.exr").kind == "deep OpenEXR image");
}

TEST_CASE("a deep image whose counts are wrong is not written, and what stood there stays") {
  const Scratch folder;
  DeepImage image = ramp(4, 3);
  write_deep_exr(image, folder / "a.exr");
  const std::string before = read_bytes(folder / "a.exr");
  image.counts[2] += 1;
  CHECK_THROWS_AS(write_deep_exr(image, folder / "a.exr"), Error);
  image = ramp(4, 3);
  image.counts.pop_back();
  CHECK_THROWS_AS(write_deep_exr(image, folder / "a.exr"), Error);
  CHECK(read_bytes(folder / "a.exr") == before);
  CHECK(folder.file_count() == 1);
}

TEST_CASE("a damaged deep file is refused or read, and nothing else") {
  const Scratch folder;
  write_deep_exr(ramp(13, 9), folder / "a.exr");
  const std::string bytes = read_bytes(folder / "a.exr");
  for (std::size_t length = 0; length < bytes.size(); length += 3) {
    write_bytes(folder / "cut.exr", bytes.substr(0, length));
    CHECK(refusal(folder / "cut.exr").starts_with(folder / "cut.exr:"));
  }
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string other = bytes;
    other[at] = static_cast<char>(other[at] ^ (1 << at % 8));
    write_bytes(folder / "flipped.exr", other);
    const std::string said = refusal(folder / "flipped.exr");
    CHECK((said == "read" || said.starts_with(folder / "flipped.exr:")));
  }
}
