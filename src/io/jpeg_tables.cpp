#include "io/jpeg_tables.h"

#include <algorithm>

namespace tyndall {
namespace {

constexpr unsigned kStart = 0xd8, kEnd = 0xd9, kTables = 0xc4, kFirstRestart = 0xd0, kTemporary = 0x01;
constexpr std::size_t kMostCodes = 256;

/// 0 beyond the end.
unsigned byte(std::string_view file, std::size_t at) { return at < file.size() ? static_cast<unsigned char>(file[at]) : 0; }

/// `at` the contents of a segment of tables, `length` bytes long: the last table may be cut off by it, and is read all the
/// same.
bool holds_oversized(std::string_view file, std::size_t at, std::ptrdiff_t length) {
  while (length > 0) {
    std::size_t size = 17, codes = 0;  // class and number, how many codes there are of each of 16 lengths, their symbols
    for (std::size_t i = 1; i < size; ++i) codes += byte(file, at + i);
    if (codes > kMostCodes) return true;
    size += codes;
    at += size;
    length -= static_cast<std::ptrdiff_t>(size);
  }
  return false;
}

/// Marker that nothing follows; 0 is none, but a byte of coded data.
bool stands_alone(unsigned marker) { return marker <= kTemporary || (marker >= kFirstRestart && marker <= kStart); }

}  // namespace

bool has_oversized_table(std::string_view file) {
  std::size_t at = file.find_first_not_of('\xff');
  if (at == 0 || at == file.npos || byte(file, at) != kStart) return false;
  for (;;) {
    at = file.find('\xff', at);  // past coded data and padding
    if (at != file.npos) at = file.find_first_not_of('\xff', at);
    if (at == file.npos) return false;
    const unsigned marker = byte(file, at++);
    if (marker == kEnd) return false;
    if (stands_alone(marker)) continue;
    const std::ptrdiff_t length = byte(file, at) << 8 | byte(file, at + 1);
    if (marker == kTables && holds_oversized(file, at + 2, length - 2)) return true;
    at += static_cast<std::size_t>(std::max<std::ptrdiff_t>(length, 2));
  }
}

}  // namespace tyndall
