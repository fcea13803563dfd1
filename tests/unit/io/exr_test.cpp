#include <doctest/doctest.h>

#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "io/exr.h"
#include "support/scratch.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

using namespace tyndall;
using test::read_bytes;
using test::Scratch;
using test::write_bytes;

namespace {

const std::string kData = TYNDALL_SOURCE_DIR "/tests/unit/io/data/";

/// A crop of a larger frame with hard values: denormals, huge, negative, NaN and infinity.
Image sample_image() {
  Image image;
  image.data = {5, 3, 38, 24};
  image.display = {0, 0, 64, 48};
  unsigned state = 1;
  for (const char* name : {"R", "G", "B", "A", "Albedo.G", "SampleCount"})
    for (float& v : image.add_channel(name).values) {
      state = state * 1664525u + 1013904223u;
      v = static_cast<float>(state >> 8) * 0x1p-20f - 3;
    }
  std::vector<float>& r = image.channels[0].values;
  r[0] = std::numeric_limits<float>::quiet_NaN();
  r[1] = kInfinity;
  r[2] = 1e-42f;
  r[3] = -0.0f;
  r[4] = 3e38f;
  image.attributes["samplesPerPixel"] = 64;
  image.attributes["gain"] = 0.1f;
  image.attributes["seconds"] = 12.25;
  image.attributes["software"] = std::string("Tyndall");
  image.attributes["worldToCamera"] = std::array<float, 16>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  image.chromaticities = Chromaticities{{0.708f, 0.292f}, {0.17f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.329f}};
  return image;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// The message of the Error that `action` throws; fails the test when it throws none or of another kind.
template <class Action>
std::string message_of(Failure kind, const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    CHECK(error.failure() == kind);
    const std::string text = error.what();
    CHECK(std::count(text.begin(), text.end(), '\n') < 3);
    return text;
  }
  FAIL_CHECK("no error");
  return {};
}

}  // namespace

TEST_CASE("an EXR comes back as it was written, bit by bit") {
  const Scratch folder;
  const Image image = sample_image();
  write_exr(image, folder / "a.exr");
  const ExrFile file = read_exr(folder / "a.exr");
  CHECK(file.image.data == image.data);
  CHECK(file.image.display == image.display);
  CHECK(file.compression == "zip");
  CHECK(file.storage == "scanlines");
  CHECK(file.image.channels.size() == image.channels.size());
  for (const Channel& c : image.channels) {
    REQUIRE(file.image.find(c.name));
    CHECK(same_bits(file.image.find(c.name)->values, c.values));
  }
  CHECK(file.image.attributes == image.attributes);
  REQUIRE(file.image.chromaticities);
  CHECK(file.image.chromaticities->green.y == 0.797f);
  CHECK(folder.file_count() == 1);
}

TEST_CASE("the same image gives the same bytes, and a new one replaces the old") {
  const Scratch folder;
  Image image = sample_image();
  write_exr(image, folder / "a.exr");
  write_exr(image, folder / "b.exr");
  const std::string bytes = read_bytes(folder / "a.exr");
  CHECK(bytes == read_bytes(folder / "b.exr"));
  image.channels[1].values[7] += 1;
  write_exr(image, folder / "a.exr");
  CHECK(bytes != read_bytes(folder / "a.exr"));
  CHECK(exr_holds(folder / "a.exr", image));
  CHECK_FALSE(exr_holds(folder / "b.exr", image));
}

TEST_CASE("large images are packed by no more threads than the limit, small ones by the caller's") {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  limit_image_threads(1);
  CHECK(exr_threads(100'000'000) == 0);
  limit_image_threads(2);
  CHECK(exr_threads(100'000'000) == (cores > 1 ? 2 : 0));
  CHECK(exr_threads(1000) == 0);
  limit_image_threads(0);
  CHECK(exr_threads(100'000'000) == (cores > 1 ? std::min(cores, 8) : 0));
}

TEST_CASE("writing through a symbolic link keeps the link") {
  const Scratch folder;
  write_bytes(folder / "real.exr", "old");
  std::filesystem::create_symlink("real.exr", folder / "link.exr");
  write_exr(sample_image(), folder / "link.exr");
  CHECK(std::filesystem::is_symlink(folder / "link.exr"));
  CHECK(exr_holds(folder / "real.exr", sample_image()));
}

TEST_CASE("exr_holds sees one changed bit, a missing channel, another window") {
  const Scratch folder;
  const Image image = sample_image();
  write_exr(image, folder / "a.exr");
  Image other = image;
  other.channels[5].values.back() = std::nextafter(other.channels[5].values.back(), 100.0f);
  CHECK_FALSE(exr_holds(folder / "a.exr", other));
  other = image;
  other.channels.pop_back();
  CHECK_FALSE(exr_holds(folder / "a.exr", other));
  other = image;
  other.data = {6, 3, 39, 24};
  CHECK_FALSE(exr_holds(folder / "a.exr", other));
}

TEST_CASE("half, float and uint channels, scanlines and tiles") {
  for (const char* name : {"scanline_mixed_piz.exr", "tiled_mipmap.exr"}) {
    CAPTURE(name);
    const ExrFile file = read_exr(kData + name);
    const Image& image = file.image;
    CHECK(image.data == PixelBounds{3, -2, 13, 5});
    CHECK(image.display == PixelBounds{0, 0, 16, 12});
    REQUIRE(image.channels.size() == 5);
    CHECK(file.channel_types == std::vector<std::string>{"half", "half", "half", "float", "uint"});
    for (std::size_t i = 0; i < 70; ++i) {
      CHECK(image.find("R")->values[i] == static_cast<float>(i) / 64);
      CHECK(image.find("B")->values[i] == static_cast<float>(i) / 64 + 2);
      CHECK(image.find("depth.Z")->values[i] == static_cast<float>(i) * 0.1f);
      CHECK(image.find("id")->values[i] == static_cast<float>(i * 1000));
    }
  }
  CHECK(read_exr(kData + "tiled_mipmap.exr").storage == "tiles");
}

TEST_CASE("deep, subsampled, foreign and missing files are refused with the reason") {
  const Scratch folder;
  write_bytes(folder / "text.exr", "this is no image");
  write_bytes(folder / "empty.exr", "");
  const auto reason = [](const std::string& path) { return message_of(Failure::scene, [&] { read_exr(path); }); };
  CHECK(reason(kData + "deep.exr").find("deep") != std::string::npos);
  CHECK(reason(kData + "luminance_chroma.exr").find("subsampled") != std::string::npos);
  CHECK(reason(folder / "text.exr").find("not an OpenEXR") != std::string::npos);
  CHECK(reason(folder / "empty.exr").find("not an OpenEXR") != std::string::npos);
  CHECK(reason(folder / "none.exr") == (folder / "none.exr") + ": file not found");
  message_of(Failure::scene, [&] { read_image(folder / "none.exr"); });
}

TEST_CASE("every truncation is refused") {
  const Scratch folder;
  write_exr(sample_image(), folder / "a.exr");
  const std::string bytes = read_bytes(folder / "a.exr");
  for (std::size_t length = 0; length < bytes.size(); length += length < 600 ? 1 : 97) {
    CAPTURE(length);
    write_bytes(folder / "cut.exr", bytes.substr(0, length));
    message_of(Failure::scene, [&] { read_exr(folder / "cut.exr"); });
  }
}

TEST_CASE("flipped bits in the pixels are survived, and nearly all noticed") {
  const Scratch folder;
  Image image = sample_image();
  // Of 8 significant bits, so that zlib takes it and adds its checksum: what does not shrink is stored bare.
  for (Channel& c : image.channels)
    for (std::size_t i = 0; i < c.values.size(); ++i) c.values[i] = 1 + static_cast<float>(i * i % 251) / 256;
  write_exr(image, folder / "a.exr");
  const std::string bytes = read_bytes(folder / "a.exr");
  const std::size_t pixels = bytes.size() / 2;  // beyond the header and the table of offsets
  int silent = 0;
  for (std::size_t i = 0; i < 300; ++i) {
    std::string flipped = bytes;
    const std::size_t at = pixels + i * 7919 % (bytes.size() - pixels);
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << i % 8));
    write_bytes(folder / "flipped.exr", flipped);
    try {
      silent += !exr_holds(folder / "flipped.exr", image);
    } catch (const Error& error) {
      CHECK(error.failure() == Failure::scene);
    }
  }
  // A repetition taken from the wrong place keeps Adler-32 now and then: 0 to 3 of 300 in pictures like this one.
  CHECK(silent <= 6);
}

TEST_CASE("a header that declares more than the file can hold is refused before memory is asked for") {
  const Scratch folder;
  write_exr(sample_image(), folder / "a.exr");
  std::string bytes = read_bytes(folder / "a.exr");
  const std::string key("dataWindow\0box2i\0\x10\0\0\0", 21);
  const std::size_t at = bytes.find(key);
  REQUIRE(at != std::string::npos);
  for (const int x1 : {0x7fffffff, 100004, -99996}) {
    std::memcpy(bytes.data() + at + key.size() + 8, &x1, 4);
    write_bytes(folder / "huge.exr", bytes);
    const std::string text = message_of(Failure::scene, [&] { read_exr(folder / "huge.exr"); });
    if (x1 == 100004) CHECK(text.find("cannot hold the 100000 x 21 pixels") != std::string::npos);
  }
}

TEST_CASE("what cannot be written says so and leaves the old file") {
  const Scratch folder;
  const auto reason = [](const Image& image, const std::string& path) {
    return message_of(Failure::output, [&] { write_exr(image, path); });
  };
  CHECK(reason(sample_image(), folder / "none/a.exr").find("none/a.exr") != std::string::npos);
  std::filesystem::create_directory(folder / "folder.exr");
  CHECK(reason(sample_image(), folder / "folder.exr").find("regular") != std::string::npos);
  CHECK(reason(sample_image(), "/dev/null").find("regular") != std::string::npos);

  write_bytes(folder / "old.exr", "old");
  Image image = sample_image();
  image.channels[2].values.pop_back();
  reason(image, folder / "old.exr");
  image = sample_image();
  image.channels[2].name = "R";
  reason(image, folder / "old.exr");
  reason(Image{}, folder / "old.exr");
  CHECK(read_bytes(folder / "old.exr") == "old");
  CHECK(folder.file_count() == 2);
}

TEST_CASE("a full disk is noticed at every byte, the old file stays and no temporary one") {
  const Scratch folder;
  const Image image = sample_image();
  write_exr(image, folder / "a.exr");
  const std::string good = read_bytes(folder / "a.exr");
  write_bytes(folder / "old.exr", "old");
  const auto previous = signal(SIGXFSZ, SIG_IGN);
  rlimit unlimited;
  REQUIRE(getrlimit(RLIMIT_FSIZE, &unlimited) == 0);
  for (std::size_t limit = 0; limit < good.size(); limit += good.size() / 40 + 1) {
    CAPTURE(limit);
    const rlimit small{limit, unlimited.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    std::string text;
    try {
      write_exr(image, folder / "old.exr");
    } catch (const Error& error) {
      text = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &unlimited);
    CHECK(text.find("old.exr: cannot be written: ") != std::string::npos);
    CHECK(read_bytes(folder / "old.exr") == "old");
    CHECK(folder.file_count() == 2);
  }
  signal(SIGXFSZ, previous);
  write_exr(image, folder / "old.exr");
  CHECK(read_bytes(folder / "old.exr") == good);
}
