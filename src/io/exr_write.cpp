#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>

#include "io/atomic_file.h"
#include "io/exr.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

/// Remembers that a write failed: OutputFile's destructor, which writes the table of offsets, swallows exceptions.
class FileStream : public Imf::OStream {
 public:
  explicit FileStream(AtomicFile& file) : OStream(file.temporary_path().c_str()), stream_(file.stream()) {}

  void write(const char bytes[], int count) override {
    require(std::fwrite(bytes, 1, static_cast<std::size_t>(count), stream_) == static_cast<std::size_t>(count));
  }
  uint64_t tellp() override {
    const auto position = ::ftello(stream_);
    require(position >= 0);
    return static_cast<uint64_t>(position);
  }
  void seekp(uint64_t position) override { require(::fseeko(stream_, static_cast<off_t>(position), SEEK_SET) == 0); }

  const std::string& failure() const { return failure_; }  ///< empty: none

 private:
  void require(bool done) {
    if (done) return;
    if (failure_.empty()) failure_ = std::strerror(errno);
    throw std::runtime_error(failure_);
  }

  std::FILE* stream_;
  std::string failure_;
};

Imath::Box2i to_box(const PixelBounds& b) { return {Imath::V2i(b.x0, b.y0), Imath::V2i(b.x1 - 1, b.y1 - 1)}; }

struct AttributeInserter {
  Imf::Header& header;
  const std::string& name;

  void operator()(int value) const { header.insert(name, Imf::IntAttribute(value)); }
  void operator()(float value) const { header.insert(name, Imf::FloatAttribute(value)); }
  void operator()(double value) const { header.insert(name, Imf::DoubleAttribute(value)); }
  void operator()(const std::string& value) const { header.insert(name, Imf::StringAttribute(value)); }
  void operator()(const std::array<float, 16>& rows) const {
    Imath::M44f matrix;
    std::copy(rows.begin(), rows.end(), &matrix.x[0][0]);
    header.insert(name, Imf::M44fAttribute(matrix));
  }
};

Imf::Header header_of(const Image& image) {
  const PixelBounds& display = image.display.width() > 0 && image.display.height() > 0 ? image.display : image.data;
  Imf::Header header(to_box(display), to_box(image.data));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const Channel& c : image.channels) header.channels().insert(c.name, Imf::Channel(Imf::FLOAT));
  for (const auto& [name, value] : image.attributes) std::visit(AttributeInserter{header, name}, value);
  if (const auto& c = image.chromaticities) {
    const auto v2f = [](Vec2 v) { return Imath::V2f(v.x, v.y); };
    Imf::addChromaticities(header, {v2f(c->red), v2f(c->green), v2f(c->blue), v2f(c->white)});
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
void encode(const Image& image, FileStream& stream) {
  Imf::OutputFile output(stream, header_of(image), exr_threads(image.channels.size() * image.channels.front().values.size()));
  Imf::FrameBuffer buffer;
  for (const Channel& c : image.channels)
    buffer.insert(c.name, Imf::Slice::Make(Imf::FLOAT, c.values.data(), to_box(image.data)));
  output.setFrameBuffer(buffer);
  output.writePixels(image.height());
}

}  // namespace

void write_exr(const Image& image, const std::string& path) {
  AtomicFile file(path);
  require_whole(image, file);
  FileStream stream(file);
  try {
    encode(image, stream);
  } catch (const std::exception& error) {
    file.fail(stream.failure().empty() ? error.what() : stream.failure());
  }
  if (!stream.failure().empty()) file.fail(stream.failure());
  file.close();
  bool same = false;
  try {
    same = exr_holds(file.temporary_path(), image);
  } catch (const Error& error) {
    file.fail("what was written cannot be read back (" + std::string(error.what()) + ")");
  }
  if (!same) file.fail("what was written reads back differently");
  file.commit();
}

}  // namespace tyndall
