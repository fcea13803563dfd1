/// Deep images as OpenEXR has them: samples of any number in a pixel, by depth.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepImageStateAttribute.h>
#include <OpenEXR/ImfDeepScanLineInputFile.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTestFile.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "io/atomic_file.h"
#include "io/exr.h"
#include "io/exr_guard.h"
#include "io/exr_header.h"
#include "io/exr_output.h"
#include "tyndall/deep_image.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

constexpr std::array kChannels{"R", "G", "B", "A", "Z", "ZBack"};
constexpr std::size_t kZ = 4, kZBack = 5;

const float& part_of(const DeepPixelSample& sample, std::size_t channel) {
  return channel == kZ ? sample.z : channel == kZBack ? sample.z_back : sample.rgba[channel];
}
float& part_of(DeepPixelSample& sample, std::size_t channel) {
  return const_cast<float&>(part_of(std::as_const(sample), channel));
}

/// Where the samples of each pixel are, for each channel: what OpenEXR reads from, or writes to.
class SamplePointers {
 public:
  /// Of pixels that are there, but perhaps not yet their samples.
  explicit SamplePointers(DeepImage& image) : image_(image) {
    for (auto& pointers : pointers_) pointers.resize(image.counts.size());
  }

  /// To the samples, as many as the counts say.
  void point() {
    std::size_t at = 0;
    for (std::size_t pixel = 0; pixel < image_.counts.size(); at += image_.counts[pixel++]) {
      for (std::size_t c = 0; c < kChannels.size() && image_.counts[pixel] > 0; ++c)
        pointers_[c][pixel] = reinterpret_cast<char*>(&part_of(image_.samples[at], c));
    }
  }

  Imf::DeepFrameBuffer buffer() {
    Imf::DeepFrameBuffer buffer;
    auto& counts = image_.counts;
    buffer.insertSampleCountSlice(Imf::Slice(
        Imf::UINT, reinterpret_cast<char*>(counts.data()) - first(image_.data) * static_cast<std::ptrdiff_t>(sizeof counts[0]),
        sizeof counts[0], row(image_.data) * sizeof counts[0]));
    for (std::size_t c = 0; c < kChannels.size(); ++c) {
      char* const base =
          reinterpret_cast<char*>(pointers_[c].data()) - first(image_.data) * static_cast<std::ptrdiff_t>(sizeof(char*));
      buffer.insert(kChannels[c],
                    Imf::DeepSlice(Imf::FLOAT, base, sizeof(char*), row(image_.data) * sizeof(char*), sizeof(DeepPixelSample)));
    }
    return buffer;
  }

 private:
  static std::size_t row(const PixelBounds& data) { return static_cast<std::size_t>(data.width()); }
  /// Pixels from the file's origin to the window's first.
  static std::ptrdiff_t first(const PixelBounds& data) {
    return data.x0 + static_cast<std::ptrdiff_t>(data.y0) * static_cast<std::ptrdiff_t>(data.width());
  }

  DeepImage& image_;
  std::array<std::vector<char*>, kChannels.size()> pointers_;
};

Imf::Header header_of(const DeepImage& image) {
  Image flat;
  flat.data = image.data;
  flat.display = image.display;
  flat.attributes = image.attributes;
  flat.chromaticities = image.chromaticities;
  Imf::Header header = exr_header_of(flat);
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  header.insert("deepImageState", Imf::DeepImageStateAttribute(Imf::DIS_TIDY));
  for (const char* name : kChannels) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  return header;
}

void require_whole(const DeepImage& image, const AtomicFile& file) {
  std::uint64_t samples = 0;
  for (const std::uint32_t count : image.counts) samples += count;
  if (image.data.width() <= 0 || image.data.height() <= 0) file.fail("the image has no pixels");
  if (image.counts.size() != image.data.size() || samples != image.samples.size())
    file.fail("the image's samples are not as many as its pixels say");
}

DeepImage without_samples(const std::string& path, const Imf::Header& header) {
  for (const std::size_t c : {0, 1, 2, 3, 4}) {
    if (!header.channels().findChannel(kChannels[c]))
      fail_exr(path, "has no channel " + std::string(kChannels[c]) + "; a deep image needs R, G, B, A and Z");
  }
  Image flat;
  flat.data = to_bounds(header.dataWindow());
  flat.display = to_bounds(header.displayWindow());
  read_attributes(header, flat);
  return {flat.data, flat.display, {}, {}, std::move(flat.attributes), flat.chromaticities};
}

/// OpenEXR wants the places of all channels before it counts, and their samples after.
void read_samples(const std::string& path, Imf::DeepScanLineInputFile& input, DeepImage& image) {
  image.counts.resize(image.data.size());
  SamplePointers pointers(image);
  input.setFrameBuffer(pointers.buffer());
  input.readPixelSampleCounts(image.data.y0, image.data.y1 - 1);
  std::uint64_t samples = 0;
  for (const std::uint32_t count : image.counts) samples += count;
  require_plausible_samples(path, samples, input.header());
  image.samples.resize(samples);
  pointers.point();
  input.readPixels(image.data.y0, image.data.y1 - 1);
}

/// The same pixels, bit for bit.
bool same_samples(const DeepImage& a, const DeepImage& b) {
  return a.data == b.data && a.counts == b.counts && a.samples.size() == b.samples.size() &&
         std::memcmp(a.samples.data(), b.samples.data(), a.samples.size() * sizeof a.samples[0]) == 0;
}

}  // namespace

DeepImage read_deep_exr(const std::string& path) {
  if (Imf::isOpenExrFile(path.c_str()) && !is_deep_exr(path))
    throw Error(Failure::scene, path + ": is a flat image, not a deep one; give what render --deep has written");
  return guarded_exr(path, [&] {
    Imf::DeepScanLineInputFile input(path.c_str(), 0);
    require_plausible_deep(path, input.header());
    DeepImage image = without_samples(path, input.header());
    read_samples(path, input, image);
    if (!input.header().channels().findChannel("ZBack"))
      for (DeepPixelSample& sample : image.samples) sample.z_back = sample.z;
    return image;
  });
}

bool is_deep_exr(const std::string& path) {
  bool tiled = false, deep = false, several_parts = false;
  return Imf::isOpenExrFile(path.c_str(), tiled, deep, several_parts) && deep;
}

void write_deep_exr(const DeepImage& image, const std::string& path) {
  AtomicFile file(path);
  require_whole(image, file);
  write_exr_file(file, [&](ExrStream& stream) {
    DeepImage written = image;  // OpenEXR asks for pointers that it could write to
    SamplePointers pointers(written);
    pointers.point();
    Imf::DeepScanLineOutputFile output(stream, header_of(image), 0);
    output.setFrameBuffer(pointers.buffer());
    output.writePixels(image.data.height());
  });
  bool same = false;
  try {
    same = same_samples(read_deep_exr(file.temporary_path()), image);
  } catch (const Error& error) {
    file.fail("what was written cannot be read back (" + std::string(error.what()) + ")");
  }
  if (!same) file.fail("what was written reads back differently");
  file.commit();
}

}  // namespace tyndall
