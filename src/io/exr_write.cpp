#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <set>

#include "io/atomic_file.h"
#include "io/exr.h"
#include "io/exr_layout.h"
#include "io/exr_output.h"
#include "tyndall/cryptomatte.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

constexpr std::array kCompressions{Imf::NO_COMPRESSION,  Imf::RLE_COMPRESSION,  Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
                                   Imf::PIZ_COMPRESSION, Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION};

/// Pixels as they are written: the image's own floats, and halves of those channels that are.
class StoredPixels {
 public:
  StoredPixels(const Image& image, bool some_are_halves) : image_(image), halves_(image.channels.size()) {
    for (std::size_t i = 0; some_are_halves && i < halves_.size(); ++i) {
      if (!is_half_channel(image.channels[i].name)) continue;
      const std::vector<float>& values = image.channels[i].values;
      halves_[i].assign(values.begin(), values.end());
    }
  }
  Imf::PixelType type(std::size_t channel) const { return halves_[channel].empty() ? Imf::FLOAT : Imf::HALF; }
  Imf::FrameBuffer buffer(const ExrPart& part) const {
    Imf::FrameBuffer buffer;
    for (const std::size_t i : part.channels) {
      const Channel& c = image_.channels[i];
      const void* pixels = halves_[i].empty() ? static_cast<const void*>(c.values.data()) : halves_[i].data();
      buffer.insert(c.name, Imf::Slice::Make(type(i), pixels, to_box(image_.data)));
    }
    return buffer;
  }

 private:
  const Image& image_;
  std::vector<std::vector<Imath::half>> halves_;  ///< empty: floats
};

/// What is to be written.
struct Layout {
  const ExrSettings& settings;
  std::vector<ExrPart> parts;
  StoredPixels pixels;

  bool several() const { return parts.size() > 1; }
};

Imf::Header header_of(const Image& image, const Layout& layout, const ExrPart& part) {
  Imf::Header header = exr_header_of(image);
  header.compression() = kCompressions.at(static_cast<std::size_t>(layout.settings.compression));
  for (const std::size_t i : part.channels)
    header.channels().insert(image.channels[i].name, Imf::Channel(layout.pixels.type(i)));
  if (layout.several()) {
    header.setName(part.name);
    header.setType(Imf::SCANLINEIMAGE);
  }
  return header;
}

void require_whole(const Image& image, const AtomicFile& file) {
  if (image.width() <= 0 || image.height() <= 0) file.fail("the image has no pixels");
  if (image.channels.empty()) file.fail("the image has no channels");
  const auto count = static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  std::set<std::string> names;
  for (const Channel& c : image.channels) {
    if (c.name.empty() || !names.insert(c.name).second) file.fail("channel name \"" + c.name + "\" is empty or double");
    if (c.values.size() != count)
      file.fail("channel " + c.name + " has " + std::to_string(c.values.size()) + " values for " + std::to_string(count) +
                " pixels");
  }
}

/// All bytes to the stream; on return the position is the end of the file.
void encode(const Image& image, const ExrSettings& settings, ExrStream& stream) {
  const Layout layout{settings, parts_of(image, settings.parts), StoredPixels(image, settings.half)};
  const int threads = exr_threads(image.channels.size() * image.channels.front().values.size());
  std::vector<Imf::Header> headers;
  for (const ExrPart& part : layout.parts) headers.push_back(header_of(image, layout, part));
  if (!layout.several()) {
    Imf::OutputFile output(stream, headers.front(), threads);
    output.setFrameBuffer(layout.pixels.buffer(layout.parts.front()));
    output.writePixels(image.height());
    return;
  }
  Imf::MultiPartOutputFile output(stream, headers.data(), static_cast<int>(headers.size()), false, threads);
  for (std::size_t i = 0; i < layout.parts.size(); ++i) {
    Imf::OutputPart part(output, static_cast<int>(i));
    part.setFrameBuffer(layout.pixels.buffer(layout.parts[i]));
    part.writePixels(image.height());
  }
}

/// What was written, read again.
void require_holds(const AtomicFile& file, const Image& image, ExrCompression compression) {
  bool same = false;
  try {
    same = is_lossy(compression) ? exr_has_pixels_of(file.temporary_path(), image) : exr_holds(file.temporary_path(), image);
  } catch (const Error& error) {
    file.fail("what was written cannot be read back (" + std::string(error.what()) + ")");
  }
  if (!same) file.fail("what was written reads back differently");
}

void write_as_stored(const Image& image, const std::string& path, const ExrSettings& settings) {
  AtomicFile file(path);
  require_whole(image, file);
  write_exr_file(file, [&](ExrStream& stream) { encode(image, settings, stream); });
  require_holds(file, image, settings.compression);
  file.commit();
}

}  // namespace

void write_exr(const Image& image, const std::string& path, const ExrSettings& settings) {
  const auto& channels = image.channels;
  if (is_lossy(settings.compression) &&
      std::any_of(channels.begin(), channels.end(), [](const Channel& c) { return is_matte_channel(c.name); }))
    throw Error(Failure::usage, path + ": has mattes, ids that lossy compression would change; choose another");
  if (settings.half) return write_as_stored(rounded_to_halves(image), path, settings);
  write_as_stored(image, path, settings);
}

const std::vector<std::string_view>& exr_compression_names() {
  static const std::vector<std::string_view> kNames{"none", "rle", "zips", "zip", "piz", "dwaa", "dwab"};
  return kNames;
}

}  // namespace tyndall
