/// What all OpenEXR files that are written share. For exr_*.cpp alone.
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>

#include <string>

#include "io/atomic_file.h"
#include "tyndall/image.h"

namespace tyndall {

/// Remembers that a write failed: the destructors of OpenEXR's files, which write the table of offsets, swallow exceptions.
class ExrStream : public Imf::OStream {
 public:
  explicit ExrStream(AtomicFile& file) : OStream(file.temporary_path().c_str()), stream_(file.stream()) {}

  void write(const char bytes[], int count) override;
  uint64_t tellp() override;
  void seekp(uint64_t position) override;

  const std::string& failure() const { return failure_; }  ///< empty: none

 private:
  void require(bool done);

  std::FILE* stream_;
  std::string failure_;
};

Imath::Box2i to_box(const PixelBounds& bounds);

/// Windows, attributes and chromaticities of `image`; no channels.
Imf::Header exr_header_of(const Image& image);

/// Writes by `encode`, which is given the stream, closes the file, and throws Error (output) for what failed in between.
template <typename Encode>
void write_exr_file(AtomicFile& file, const Encode& encode) {
  ExrStream stream(file);
  try {
    encode(stream);
  } catch (const std::exception& error) {
    file.fail(stream.failure().empty() ? error.what() : stream.failure());
  }
  if (!stream.failure().empty()) file.fail(stream.failure());
  file.close();
}

}  // namespace tyndall
