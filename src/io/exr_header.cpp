#include "io/exr_header.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "tyndall/error.h"

namespace tyndall {
namespace {

constexpr std::uint64_t kMaxBytes = 1ull << 34;  // decoded
// What a byte of the file can unfold to: zlib cannot exceed 1032, nor PIZ's runs of at most 255 equal values; DWA keeps
// one coefficient of an even 8 x 8 block before zlib sees it.
constexpr std::uint64_t kMaxRatio = 1100, kMaxDwaRatio = 64 * kMaxRatio;
constexpr std::size_t kMaxReason = 200;  // characters of the library's words that are passed on

/// What a part declares.
struct Declared {
  std::uint64_t width = 0, height = 0;
  std::uint64_t channels = 0, stored = 0;  ///< bytes a pixel in the file
  std::uint64_t ratio = 1;

  std::uint64_t pixels() const { return width * height; }
};

Declared declared_by(const std::string& path, const Imf::Header& header) {
  Declared d;
  const Imath::Box2i& window = header.dataWindow();
  d.width = static_cast<std::uint64_t>(std::int64_t{window.max.x} - window.min.x + 1);
  d.height = static_cast<std::uint64_t>(std::int64_t{window.max.y} - window.min.y + 1);
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
      fail_exr(path, "channel " + tidy_exr_text(c.name()) + " is subsampled, which is not read; save it as R, G, B");
    ++d.channels;
    d.stored += c.channel().type == Imf::HALF ? 2 : 4;
  }
  const Imf::Compression compression = header.compression();
  const bool dwa = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
  d.ratio = compression == Imf::NO_COMPRESSION ? 1 : dwa ? kMaxDwaRatio : kMaxRatio;
  return d;
}

std::string size_text(const Declared& d) { return std::to_string(d.width) + " x " + std::to_string(d.height) + " pixels"; }

}  // namespace

void fail_exr(const std::string& path, const std::string& reason) { throw Error(Failure::scene, path + ": " + reason); }

std::string tidy_exr_text(std::string text) {
  if (text.size() > kMaxReason) text = text.substr(0, kMaxReason) + "...";
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

std::string name_of(Imf::PixelType type) { return type == Imf::HALF ? "half" : (type == Imf::FLOAT ? "float" : "uint"); }

std::string name_of(Imf::Compression compression) {
  constexpr const char* names[] = {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};
  const auto i = static_cast<std::size_t>(compression);
  return i < std::size(names) ? names[i] : "unknown";
}

PixelBounds to_bounds(const Imath::Box2i& box) { return {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1}; }

void require_plausible(const std::string& path, const std::vector<const Imf::Header*>& parts) {
  const std::uint64_t size = std::filesystem::file_size(path);
  std::uint64_t decoded = 0;
  for (const Imf::Header* header : parts) {
    const Declared d = declared_by(path, *header);
    if (d.channels == 0) fail_exr(path, "has no channels");
    if (d.width > kMaxExrSide || d.height > kMaxExrSide || d.channels > (kMaxBytes - decoded) / sizeof(float) / d.pixels())
      fail_exr(path, "declares " + size_text(d) + " of " + std::to_string(d.channels) + " channels, more than the " +
                         std::to_string(kMaxBytes >> 30) + " GiB that are read");
    decoded += sizeof(float) * d.channels * d.pixels();
    if (size < d.stored * d.pixels() / d.ratio)
      fail_exr(path, "is damaged: " + std::to_string(size) + " bytes cannot hold the " + size_text(d) + " it declares");
  }
}

void require_plausible_deep(const std::string& path, const Imf::Header& header) {
  const Declared d = declared_by(path, header);
  if (d.width > kMaxExrSide || d.height > kMaxExrSide || d.pixels() > kMaxBytes / sizeof(std::uint32_t))
    fail_exr(path, "declares " + size_text(d) + ", more than are read");
  if (std::filesystem::file_size(path) < sizeof(std::uint32_t) * d.pixels() / kMaxRatio)
    fail_exr(path, "is damaged: it is too short for the " + size_text(d) + " it declares");
}

void require_plausible_samples(const std::string& path, std::uint64_t samples, const Imf::Header& header) {
  const Declared d = declared_by(path, header);
  if (samples > kMaxBytes / (sizeof(float) * d.channels))
    fail_exr(path, "declares " + std::to_string(samples) + " deep samples, more than the " + std::to_string(kMaxBytes >> 30) +
                       " GiB that are read");
  if (std::filesystem::file_size(path) < d.stored * samples / kMaxRatio)
    fail_exr(path, "is damaged: it is too short for the " + std::to_string(samples) + " deep samples it declares");
}

void read_attributes(const Imf::Header& header, Image& image) {
  const auto built_in = [](const std::string& name) {
    return name == "pixelAspectRatio" || name == "screenWindowWidth" || name == "type" || name == "name" || name == "version" ||
           name == "chunkCount" || name == "maxSamplesPerPixel" || name == "dwaCompressionLevel";
  };
  for (auto a = header.begin(); a != header.end(); ++a) {
    const std::string name = a.name();
    if (built_in(name)) continue;
    const Imf::Attribute& attribute = a.attribute();
    if (const auto* i = dynamic_cast<const Imf::IntAttribute*>(&attribute)) image.attributes[name] = i->value();
    if (const auto* f = dynamic_cast<const Imf::FloatAttribute*>(&attribute)) image.attributes[name] = f->value();
    if (const auto* d = dynamic_cast<const Imf::DoubleAttribute*>(&attribute)) image.attributes[name] = d->value();
    if (const auto* s = dynamic_cast<const Imf::StringAttribute*>(&attribute)) image.attributes[name] = s->value();
    if (const auto* m = dynamic_cast<const Imf::M44fAttribute*>(&attribute)) {
      std::array<float, 16> rows;
      std::copy_n(&m->value().x[0][0], 16, rows.begin());
      image.attributes[name] = rows;
    }
  }
  if (!Imf::hasChromaticities(header)) return;
  const Imf::Chromaticities& c = Imf::chromaticities(header);
  image.chromaticities =
      Chromaticities{{c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}};
}

}  // namespace tyndall
