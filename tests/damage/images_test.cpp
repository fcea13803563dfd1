/// Damaged pictures: read, or refused in one line.
#include <doctest/doctest.h>

#include "support/damage.h"
#include "support/scratch.h"
#include "tyndall/io.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

const std::string kUnitData = TYNDALL_SOURCE_DIR "/tests/unit/io/data/";
const std::string kParts = TYNDALL_SOURCE_DIR "/tests/regression/suite/parts/";

Image ramp(int width, int height) {
  Image image;
  image.data = image.display = {0, 0, width, height};
  float value = 0;
  for (const char* name : {"R", "G", "B", "A"})
    for (float& v : image.add_channel(name).values) v = value += 0.01f;
  return image;
}

void read_whole(const std::string& path) {
  const Image image = read_image(path);
  for (const Channel& channel : image.channels)
    if (channel.values.size() != static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()))
      throw std::runtime_error("planes of a wrong size");
}

void check(const std::vector<std::string>& seeds, bool cuts_show) {
  for (const std::string& seed : seeds) read_whole(seed);
  const Verdict verdict = read_mutants(seeds, read_whole);
  MESSAGE(verdict.str());
  CHECK(verdict.complaints.empty());
  if (cuts_show) CHECK(verdict.accepted_truncations == 0);
}

}  // namespace

TEST_CASE("damaged .exr files") {
  const Scratch folder;
  write_exr(ramp(37, 23), folder / "zip.exr");
  write_exr(ramp(37, 23), folder / "half.exr", {.half = true, .compression = ExrCompression::piz});
  check({folder / "zip.exr", folder / "half.exr", kUnitData + "scanline_mixed_piz.exr"}, true);
  Image several = ramp(37, 23);
  several.add_channel("Z");
  write_exr(several, folder / "parts.exr", {.parts = true});
  check({folder / "parts.exr"}, true);
  check({kUnitData + "tiled_mipmap.exr"}, false);  // smaller levels, which are not read, may be missing
}

TEST_CASE("damaged .png files") {
  const Scratch folder;
  write_png(ramp(37, 23), folder / "rgb.png");
  check({folder / "rgb.png", kUnitData + "palette2.png", kUnitData + "rgb16.png", kUnitData + "grey_interlaced.png",
         kParts + "sky.png"},
        true);
}

TEST_CASE("damaged .pfm files") {
  const Scratch folder;
  std::string colour = "PF\n8 8\n-1\n", grey = "Pf 4 16 2.5\n";
  for (int i = 0; i < 8 * 8 * 3 * 4; ++i) colour += static_cast<char>(i % 4 == 3 ? 62 : i);
  for (int i = 0; i < 4 * 16 * 4; ++i) grey += static_cast<char>(i % 4 == 0 ? 62 : i);
  write_bytes(folder / "colour.pfm", colour);
  write_bytes(folder / "grey.pfm", grey);
  check({folder / "colour.pfm", folder / "grey.pfm"}, true);
}

TEST_CASE("damaged .jpg, .hdr, .tga and .bmp files") {
  const Scratch folder;
  std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n", tga("\0\0\2\0\0\0\0\0\0\0\0\0\10\0\10\0\30\0", 18);
  std::string bmp(
      "BM\366\0\0\0\0\0\0\0\66\0\0\0\50\0\0\0\10\0\0\0\10\0\0\0\1\0\30\0\0\0\0\0\300\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0",
      54);
  for (int i = 0; i < 8; ++i) {
    hdr += std::string("\2\2\0\20", 4);
    for (int c = 0; c < 4; ++c) {
      hdr += '\20';
      for (int x = 0; x < 16; ++x) hdr += static_cast<char>(c == 3 ? 129 : 10 * x + i);
    }
  }
  for (int i = 0; i < 8 * 8 * 3; ++i) {
    tga += static_cast<char>(i);
    bmp += static_cast<char>(255 - i);
  }
  write_bytes(folder / "a.hdr", hdr);
  write_bytes(folder / "a.tga", tga);
  write_bytes(folder / "a.bmp", bmp);
  check({kUnitData + "halves.jpg", folder / "a.hdr", folder / "a.tga", folder / "a.bmp"}, false);
}
