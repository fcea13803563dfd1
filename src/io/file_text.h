/// Whole files in memory, gzip undone.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tyndall {

/// Largest text or mesh a .gz may unfold to; a small file that claims more is taken for an attack or a mistake.
inline constexpr std::size_t kMaxUnzippedBytes = std::size_t{16} << 30;

/// True when the bytes begin as a gzip stream does.
bool is_gzip(std::string_view bytes);

/// Unfolds a gzip stream (several members in a row are one file). Throws Error (scene) naming `path` when it is
/// damaged, cut off, or larger than `limit`.
std::string gunzip(std::string_view bytes, const std::string& path, std::size_t limit = kMaxUnzippedBytes);

/// All bytes of the file, unfolded when they are gzip. Throws Error (scene) when it is missing or cannot be read.
std::string read_file_text(const std::string& path);

}  // namespace tyndall
