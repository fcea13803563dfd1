/// The header of a polygon file: which elements follow, with which properties, in which encoding.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
  /// Bytes that one of these takes at least in the binary form: a list's count and no items.
  std::size_t least_size() const;
  int index_of(std::string_view property) const;  ///< -1 when absent
};

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes up to the body
};

/// Throws Error (scene) naming `path` and the line.
PlyHeader parse_ply_header(std::string_view bytes, const std::string& path);

}  // namespace tyndall
