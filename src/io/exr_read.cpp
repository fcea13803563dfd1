#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <thread>

#include "io/exr.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

constexpr int kMaxSide = 1 << 17;                // pixels
constexpr std::uint64_t kMaxBytes = 1ull << 34;  // decoded
// What a byte of the file can unfold to: zlib cannot exceed 1032, nor PIZ's runs of at most 255 equal values; DWA keeps
// one coefficient of an even 8 x 8 block before zlib sees it.
constexpr std::uint64_t kMaxRatio = 1100, kMaxDwaRatio = 64 * kMaxRatio;
constexpr std::size_t kMaxReason = 200;  // characters of the library's words that are passed on

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error(Failure::scene, path + ": " + reason);
}

/// One line of printable characters: the text may quote the file.
std::string tidy(std::string text) {
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

void require_readable(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::exists(path, none)) fail(path, "file not found");
  bool tiled = false, deep = false, multi_part = false;
  if (!Imf::isOpenExrFile(path.c_str(), tiled, deep, multi_part)) fail(path, "is not an OpenEXR file");
  if (deep) fail(path, "holds deep pixels, which are not read; flatten it");
  if (multi_part) fail(path, "has several parts, which are not read; save the one you want by itself");
}

/// Declared sizes against limits and against the file's own size, before any pixel memory is asked for.
void require_plausible(const std::string& path, const Imf::Header& header) {
  const Imath::Box2i& window = header.dataWindow();
  const auto width = static_cast<std::uint64_t>(std::int64_t{window.max.x} - window.min.x + 1);
  const auto height = static_cast<std::uint64_t>(std::int64_t{window.max.y} - window.min.y + 1);
  std::uint64_t count = 0, stored = 0;  // channels, bytes a pixel in the file
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
      fail(path, "channel " + tidy(c.name()) + " is subsampled, which is not read; save it as R, G, B");
    ++count;
    stored += c.channel().type == Imf::HALF ? 2 : 4;
  }
  if (count == 0) fail(path, "has no channels");
  if (width > kMaxSide || height > kMaxSide || count > kMaxBytes / sizeof(float) / (width * height))
    fail(path, "declares " + std::to_string(width) + " x " + std::to_string(height) + " pixels of " + std::to_string(count) +
                   " channels, more than the " + std::to_string(kMaxBytes >> 30) + " GiB that are read");
  const std::uint64_t bytes = stored * width * height, size = std::filesystem::file_size(path);
  const Imf::Compression compression = header.compression();
  const bool dwa = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
  const std::uint64_t ratio = compression == Imf::NO_COMPRESSION ? 1 : dwa ? kMaxDwaRatio : kMaxRatio;
  const bool too_short = size < bytes / ratio;
  if (too_short)
    fail(path, "is damaged: " + std::to_string(size) + " bytes cannot hold the " + std::to_string(width) + " x " +
                   std::to_string(height) + " pixels it declares");
}

PixelBounds to_bounds(const Imath::Box2i& box) { return {box.min.x, box.min.y, box.max.x + 1, box.max.y + 1}; }

void read_attributes(const Imf::Header& header, Image& image) {
  const auto built_in = [](const std::string& name) {
    return name == "pixelAspectRatio" || name == "screenWindowWidth" || name == "type" || name == "name" || name == "version" ||
           name == "chunkCount" || name == "maxSamplesPerPixel";
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

/// Decodes rows [y0, y1) of the file's own coordinates into `planes`, each (y1 - y0) * width floats.
void read_rows(Imf::InputFile& file, const Image& image, int y0, int y1, std::vector<std::vector<float>>& planes) {
  const Imath::Box2i rows(Imath::V2i(image.data.x0, y0), Imath::V2i(image.data.x1 - 1, y1 - 1));
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < image.channels.size(); ++c)
    buffer.insert(image.channels[c].name, Imf::Slice::Make(Imf::FLOAT, planes[c].data(), rows));
  file.setFrameBuffer(buffer);
  file.readPixels(y0, y1 - 1);
}

/// Windows, attributes and channels without values, once the file has been found to be whole.
Image decode_header(const std::string& path, const Imf::InputFile& file) {
  const Imf::Header& header = file.header();
  require_plausible(path, header);
  if (!file.isComplete()) fail(path, "is incomplete: its writer was interrupted, or the file was cut off");
  Image image;
  image.data = to_bounds(header.dataWindow());
  image.display = to_bounds(header.displayWindow());
  read_attributes(header, image);
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) image.channels.push_back({c.name(), {}});
  return image;
}

ExrFile decode(const std::string& path) {
  require_readable(path);
  Imf::InputFile file(path.c_str());
  const Imf::Header& header = file.header();
  ExrFile result;
  result.image = decode_header(path, file);
  result.compression = name_of(header.compression());
  result.storage = header.hasTileDescription() ? "tiles" : "scanlines";
  Image& image = result.image;
  std::vector<std::vector<float>> planes;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    result.channel_types.push_back(name_of(c.channel().type));
    planes.emplace_back(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  }
  read_rows(file, image, image.data.y0, image.data.y1, planes);
  for (std::size_t c = 0; c < planes.size(); ++c) image.channels[c].values = std::move(planes[c]);
  return result;
}

bool holds(const std::string& path, const Image& image) {
  constexpr int strip = 64;  // rows; keeps the check's memory small beside the image's
  Imf::InputFile file(path.c_str(), exr_threads(image.channels.size() * image.channels.front().values.size()));
  const Imf::ChannelList& channels = file.header().channels();
  std::size_t count = 0;
  for (auto c = channels.begin(); c != channels.end(); ++c) ++count;
  if (!file.isComplete() || to_bounds(file.header().dataWindow()) != image.data || count != image.channels.size()) return false;
  for (const Channel& c : image.channels)
    if (!channels.findChannel(c.name)) return false;
  const auto width = static_cast<std::size_t>(image.width());
  std::vector<std::vector<float>> planes(count, std::vector<float>(width * strip));
  for (int y0 = image.data.y0; y0 < image.data.y1; y0 += strip) {
    const int y1 = std::min(y0 + strip, image.data.y1);
    read_rows(file, image, y0, y1, planes);
    const std::size_t first = width * static_cast<std::size_t>(y0 - image.data.y0);
    const std::size_t bytes = width * static_cast<std::size_t>(y1 - y0) * sizeof(float);
    for (std::size_t c = 0; c < count; ++c)
      if (std::memcmp(planes[c].data(), image.channels[c].values.data() + first, bytes) != 0) return false;
  }
  return true;
}

/// Runs `read` with the library's limits set and its exceptions turned into ours.
template <class Read>
auto guarded(const std::string& path, const Read& read) {
  static const bool kLimited = [] {
    Imf::Header::setMaxImageSize(kMaxSide, kMaxSide);
    Imf::Header::setMaxTileSize(kMaxSide / 8, kMaxSide / 8);
    return true;
  }();
  static_cast<void>(kLimited);
  try {
    return read();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    fail(path, "needs more memory than there is");
  } catch (const std::exception& error) {
    const std::string reason = error.what();
    if (reason.find("Early end of file") != std::string::npos)
      fail(path, "ends too early; it may have been cut off while it was written or copied");
    fail(path, "cannot be read as OpenEXR: " + tidy(reason));
  }
}

constexpr int kUsefulThreads = 8;
std::atomic<int> most_threads{kUsefulThreads};  ///< OpenEXR's pool is one for the whole program, and so is this

}  // namespace

int exr_threads(std::size_t values) {
  constexpr std::size_t kSmall = 1 << 21;
  const int wanted = std::min(static_cast<int>(std::thread::hardware_concurrency()), most_threads.load());
  // Asking makes the pool. Made by the first task, in memory that there is not, it would leave who waits for the task waiting.
  const int there = Imf::globalThreadCount();
  if (values < kSmall || wanted <= 1) return 0;
  if (there < wanted) Imf::setGlobalThreadCount(wanted);
  return wanted;
}

void limit_image_threads(int threads) { most_threads = threads > 0 ? std::min(threads, kUsefulThreads) : kUsefulThreads; }

bool is_exr(const std::string& path) { return Imf::isOpenExrFile(path.c_str()); }

ExrFile read_exr(const std::string& path) {
  return guarded(path, [&] { return decode(path); });
}

Image read_exr_header(const std::string& path) {
  return guarded(path, [&] {
    require_readable(path);
    return decode_header(path, Imf::InputFile(path.c_str()));
  });
}

bool exr_holds(const std::string& path, const Image& image) {
  return guarded(path, [&] { return holds(path, image); });
}

}  // namespace tyndall
