#include "io/exr_output.h"

#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace tyndall {

void ExrStream::write(const char bytes[], int count) {
  require(std::fwrite(bytes, 1, static_cast<std::size_t>(count), stream_) == static_cast<std::size_t>(count));
}

uint64_t ExrStream::tellp() {
  const auto position = ::ftello(stream_);
  require(position >= 0);
  return static_cast<uint64_t>(position);
}

void ExrStream::seekp(uint64_t position) { require(::fseeko(stream_, static_cast<off_t>(position), SEEK_SET) == 0); }

void ExrStream::require(bool done) {
  if (done) return;
  if (failure_.empty()) failure_ = std::strerror(errno);
  throw std::runtime_error(failure_);
}

Imath::Box2i to_box(const PixelBounds& b) { return {Imath::V2i(b.x0, b.y0), Imath::V2i(b.x1 - 1, b.y1 - 1)}; }

namespace {

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

}  // namespace

Imf::Header exr_header_of(const Image& image) {
  const PixelBounds& display = image.display.width() > 0 && image.display.height() > 0 ? image.display : image.data;
  Imf::Header header(to_box(display), to_box(image.data));
  for (const auto& [name, value] : image.attributes) std::visit(AttributeInserter{header, name}, value);
  if (const auto& c = image.chromaticities) {
    const auto v2f = [](Vec2 v) { return Imath::V2f(v.x, v.y); };
    Imf::addChromaticities(header, {v2f(c->red), v2f(c->green), v2f(c->blue), v2f(c->white)});
  }
  return header;
}

}  // namespace tyndall
