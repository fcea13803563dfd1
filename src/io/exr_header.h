/// What headers of OpenEXR files say, in our terms. For exr_*.cpp alone.
#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfPixelType.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

inline constexpr int kMaxExrSide = 1 << 17;  // pixels

/// Throws Error (scene), "path: reason".
[[noreturn]] void fail_exr(const std::string& path, const std::string& reason);
/// One line of printable characters: the text may quote the file.
std::string tidy_exr_text(std::string text);

std::string name_of(Imf::PixelType type);
std::string name_of(Imf::Compression compression);
PixelBounds to_bounds(const Imath::Box2i& box);

/// Sizes that the headers of the parts declare against limits and against the file's own size, before any pixel memory is
/// asked for. Throws Error (scene).
void require_plausible(const std::string& path, const std::vector<const Imf::Header*>& parts);

/// The same of a deep file, before its samples are counted, and after.
void require_plausible_deep(const std::string& path, const Imf::Header& header);
void require_plausible_samples(const std::string& path, std::uint64_t samples, const Imf::Header& header);

/// Attributes and chromaticities, without those that OpenEXR itself needs.
void read_attributes(const Imf::Header& header, Image& image);

}  // namespace tyndall
