/// Reading OpenEXR files, whatever they hold. For exr_*.cpp alone.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <new>
#include <string>

#include "io/exr_header.h"
#include "tyndall/error.h"

namespace tyndall {

/// Runs `read` with the library's limits set and its exceptions turned into ours.
template <class Read>
auto guarded_exr(const std::string& path, const Read& read) {
  static const bool kLimited = [] {
    Imf::Header::setMaxImageSize(kMaxExrSide, kMaxExrSide);
    Imf::Header::setMaxTileSize(kMaxExrSide / 8, kMaxExrSide / 8);
    return true;
  }();
  static_cast<void>(kLimited);
  try {
    return read();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    fail_exr(path, "needs more memory than there is");
  } catch (const std::exception& error) {
    const std::string reason = error.what();
    if (reason.find("Early end of file") != std::string::npos)
      fail_exr(path, "ends too early; it may have been cut off while it was written or copied");
    fail_exr(path, "cannot be read as OpenEXR: " + tidy_exr_text(reason));
  }
}

}  // namespace tyndall
