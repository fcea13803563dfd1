/// What libFuzzer throws bytes at: each takes any input, and may do anything but crash, hang or upset a sanitizer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tyndall::fuzz {

void scene(std::string_view bytes);           ///< a scene file, read and checked
void ply(std::string_view bytes);             ///< a polygon file
void vdb(std::string_view bytes);             ///< a .vdb file, imported as a medium
void nvdb(std::string_view bytes);            ///< a .nvdb file, imported as a medium
void exr(std::string_view bytes);             ///< an OpenEXR image
void pfm(std::string_view bytes);             ///< a portable float map
void ies(std::string_view bytes);             ///< a photometric file
void lens(std::string_view bytes);            ///< a table of lenses
void checkpoint(std::string_view bytes);      ///< a checkpoint but for its checksum, which is made to fit
void volume_message(std::string_view bytes);  ///< what the process that reads .vdb files answers, should one take it over

struct Target {
  const char* name;  ///< also of its folder in tests/fuzz/corpus
  void (*run)(std::string_view);
  bool slow = false;  ///< with sanitizers: reads in a process of its own, or a corpus has what asks for hundreds of MB
};
/// What forks comes first: the more memory a process has used, the longer that takes.
inline constexpr Target kTargets[] = {{"vdb", vdb, true},
                                      {"scene", scene},
                                      {"ply", ply},
                                      {"nvdb", nvdb},
                                      {"exr", exr, true},
                                      {"pfm", pfm},
                                      {"ies", ies},
                                      {"lens", lens},
                                      {"checkpoint", checkpoint},
                                      {"volume_message", volume_message}};

}  // namespace tyndall::fuzz
