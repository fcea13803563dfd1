/// Identifies the running program, for files that no other program may resume.
#pragma once

#include <string>
#include <vector>

namespace tyndall {

/// A shared library in this process, and the identity that the linker gave its content: hexadecimal digits, empty for a
/// library that was linked without.
struct LoadedLibrary {
  std::string name;  ///< of its file, without folders
  std::string id;
};
/// Those that compute the picture: Embree, OpenVDB, OpenEXR with Imath, and the C library with its mathematics.
std::vector<LoadedLibrary> reckoning_libraries();

/// "version-program-libraries": the version of Tyndall, a hash of the program's file, and one of the names and identities
/// of reckoning_libraries(). Another program, or an upgrade of one of these, may give other bits; so may another kind of
/// CPU, which they adapt themselves to and which does not enter.
const std::string& build_id();

}  // namespace tyndall
