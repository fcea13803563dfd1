/// What stb_image does not check of a JPEG file itself.
#pragma once

#include <string_view>

namespace tyndall {

/// Whether `file` is a JPEG file with a Huffman table of more than the 256 codes that there can be [ITU T.81, B.2.4.2].
/// stb_image 2.27 writes the others beyond its own tables, up to 3,824 bytes. Markers are looked for wherever it does.
bool has_oversized_table(std::string_view file);

}  // namespace tyndall
