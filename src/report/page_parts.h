/// The files of src/report/page, compiled into the library so that a report needs no file of its own at run time.
#pragma once

#include <span>
#include <string_view>

namespace tyndall {

struct PagePart {
  std::string_view name;  ///< "viewer.js"
  std::string_view text;
};

/// All of them in the order of their names. Defined in a source that the build writes (cmake/EmbedFiles.cmake).
std::span<const PagePart> page_parts();

}  // namespace tyndall
