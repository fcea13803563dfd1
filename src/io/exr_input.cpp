#include "io/exr_input.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTestFile.h>

#include <algorithm>
#include <filesystem>

#include "io/exr_header.h"

namespace tyndall {
namespace {

constexpr int kMostParts = 1024;

/// Whether the file is of several parts. Throws for what is no OpenEXR file, or deep.
bool is_multi_part(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::exists(path, none)) fail_exr(path, "file not found");
  bool tiled = false, deep = false, multi_part = false;
  if (!Imf::isOpenExrFile(path.c_str(), tiled, deep, multi_part)) fail_exr(path, "is not an OpenEXR file");
  if (deep) fail_exr(path, "holds deep pixels, which are not read; flatten it by tyndall flatten");
  return multi_part;
}

bool is_deep(const Imf::Header& header) { return header.hasType() && Imf::isDeepData(header.type()); }

}  // namespace

ExrInput::ExrInput(const std::string& path, int threads) : path_(path) {
  if (is_multi_part(path)) {
    multi_ = std::make_unique<Imf::MultiPartInputFile>(path.c_str(), threads);
  } else {
    single_ = std::make_unique<Imf::InputFile>(path.c_str(), threads);
  }
  require_readable();
  find_channels();
}

void ExrInput::require_readable() const {
  if (parts() > kMostParts) fail_exr(path_, "has more parts than the " + std::to_string(kMostParts) + " that are read");
  std::vector<const Imf::Header*> headers;
  for (int i = 0; i < parts(); ++i) headers.push_back(&part_header(i));
  for (const Imf::Header* header : headers) {
    if (is_deep(*header)) fail_exr(path_, "has a part of deep pixels, which are not read; flatten it");
    if (header->dataWindow() != headers.front()->dataWindow())
      fail_exr(path_, "has parts of different data windows, which are not read; save the one you want by itself");
  }
  require_plausible(path_, headers);
  for (int i = 0; i < parts(); ++i) {
    if (!(multi_ ? multi_->partComplete(i) : single_->isComplete()))
      fail_exr(path_, "is incomplete: its writer was interrupted, or the file was cut off");
  }
}

void ExrInput::find_channels() {
  const auto taken = [&](const std::string& name) {
    return std::any_of(channels_.begin(), channels_.end(), [&](const Source& s) { return s.name == name; });
  };
  for (int i = 0; i < parts(); ++i) {
    const Imf::Header& header = part_header(i);
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
      std::string name = c.name();
      if (taken(name)) name = header.name() + "." + name;
      if (taken(name)) fail_exr(path_, "has channel " + tidy_exr_text(name) + " twice; save the part you want by itself");
      channels_.push_back({i, c.name(), std::move(name), name_of(c.channel().type)});
    }
  }
}

Image ExrInput::header() const {
  Image image;
  image.data = to_bounds(first().dataWindow());
  image.display = to_bounds(first().displayWindow());
  read_attributes(first(), image);
  for (const Source& c : channels_) image.channels.push_back({c.name, {}});
  return image;
}

std::vector<std::string> ExrInput::channel_types() const {
  std::vector<std::string> types;
  for (const Source& c : channels_) types.push_back(c.type);
  return types;
}

void ExrInput::read_rows(int y0, int y1, std::vector<std::vector<float>>& planes) {
  const Imath::Box2i& window = first().dataWindow();
  const Imath::Box2i rows(Imath::V2i(window.min.x, y0), Imath::V2i(window.max.x, y1 - 1));
  for (int i = 0; i < parts(); ++i) {
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < channels_.size(); ++c)
      if (channels_[c].part == i) buffer.insert(channels_[c].stored, Imf::Slice::Make(Imf::FLOAT, planes[c].data(), rows));
    if (multi_) {
      Imf::InputPart part(*multi_, i);
      part.setFrameBuffer(buffer);
      part.readPixels(y0, y1 - 1);
    } else {
      single_->setFrameBuffer(buffer);
      single_->readPixels(y0, y1 - 1);
    }
  }
}

}  // namespace tyndall
