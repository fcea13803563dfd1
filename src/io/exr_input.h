/// An OpenEXR file, of one part or of several, as one image. For exr_*.cpp alone; exceptions are OpenEXR's or Error.
#pragma once

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <memory>
#include <string>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

class ExrInput {
 public:
  /// Opens the file and finds it to be whole, flat, of one data window, and its size plausible. Throws Error (scene).
  explicit ExrInput(const std::string& path, int threads = 0);

  /// Windows, attributes of the first part, and the channels of all, without values. Where a later part has a name that is
  /// taken it stands as "part.name".
  Image header() const;
  /// "half", "float" or "uint", for each channel of header().
  std::vector<std::string> channel_types() const;
  const Imf::Header& first() const { return part_header(0); }
  int parts() const { return multi_ ? multi_->parts() : 1; }

  /// Decodes rows [y0, y1) of the file's own coordinates into `planes`, each (y1 - y0) * width floats, in the order of
  /// header()'s channels.
  void read_rows(int y0, int y1, std::vector<std::vector<float>>& planes);

 private:
  /// A channel of the file and its name in the image.
  struct Source {
    int part;
    std::string stored, name, type;
  };

  const Imf::Header& part_header(int part) const { return multi_ ? multi_->header(part) : single_->header(); }
  void require_readable() const;
  void find_channels();

  std::string path_;
  std::unique_ptr<Imf::InputFile> single_;
  std::unique_ptr<Imf::MultiPartInputFile> multi_;
  std::vector<Source> channels_;
};

}  // namespace tyndall
