#include "volume/vdb_file.h"

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "tyndall/error.h"
#include "tyndall/utf8.h"
#include "volume/vdb_remote.h"

namespace tyndall {

std::string printable(const std::string& text) {
  constexpr std::size_t kLongest = 300;
  std::string result;
  for (const char c : valid_utf8(text.substr(0, kLongest))) result += (c >= '\0' && c < ' ') || c == '\x7f' ? ' ' : c;
  if (text.size() > kLongest) result += "...";
  return result;
}

std::unique_ptr<VolumeFile> open_volume(const std::string& path, std::size_t most_memory) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) throw Error(Failure::scene, path + ": no such file; check the path");
  if (std::filesystem::is_directory(path, code)) throw Error(Failure::scene, path + ": is a folder, not a volume file");
  if (!std::filesystem::is_regular_file(path, code))
    throw Error(Failure::scene, path + ": is no regular file; copy it into one");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(Failure::scene, path + ": cannot be opened; check its permissions");
  std::array<char, 8> head{};
  in.read(head.data(), head.size());
  if (in.gcount() < static_cast<std::streamsize>(head.size()))
    throw Error(Failure::scene, path + ": is too short to be a volume file (" + std::to_string(in.gcount()) + " bytes)");

  // OpenVDB: ' BDV' and four zero bytes, NanoVDB: "NanoVDB" and a digit.
  if (std::memcmp(head.data(), " BDV\0\0\0\0", 8) == 0) return open_remotely(path, most_memory, open_openvdb);
  if (std::memcmp(head.data(), "NanoVDB", 7) == 0) return open_nanovdb(path, most_memory);
  throw Error(Failure::scene, path + ": is neither an OpenVDB nor a NanoVDB file (its first bytes match neither)");
}

}  // namespace tyndall
