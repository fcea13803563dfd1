#include "io/jpeg_tables.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/scratch.h"
#include "tyndall/error.h"
#include "tyndall/io.h"

using namespace tyndall;

namespace {

const std::string kStart = "\xff\xd8", kApplication("\xff\xe0\0\4ab", 6), kScan("\xff\xda\0\3x\x12\xff\0\x34\xff\xd1\x56", 12);

/// A table with `codes` codes, of the greatest length first.
std::string table(int codes) {
  std::string counts(17, '\0');
  int left = codes;
  for (std::size_t i = 16; i > 0; --i) {
    const int count = std::min(left, 255);
    counts[i] = static_cast<char>(count);
    left -= count;
  }
  return counts + std::string(static_cast<std::size_t>(codes), 's');
}

/// A segment of tables that says it is `length` bytes long; absent: as long as it is.
std::string tables(const std::string& contents, int length = -1) {
  const int n = length < 0 ? static_cast<int>(contents.size()) + 2 : length;
  return std::string("\xff\xc4") + static_cast<char>(n >> 8) + static_cast<char>(n & 255) + contents;
}

}  // namespace

TEST_CASE("tables of up to 256 codes pass, wherever they stand") {
  for (const int codes : {0, 1, 255, 256})
    CHECK_FALSE(has_oversized_table(kStart + tables(table(codes) + table(codes)) + kScan));
  CHECK_FALSE(has_oversized_table(""));
  CHECK_FALSE(has_oversized_table("\xff\xff"));
  CHECK_FALSE(has_oversized_table(kStart));
  CHECK_FALSE(has_oversized_table(kStart + kScan + "\xff\xd9" + tables(table(300))));  // after the end
  CHECK_FALSE(
      has_oversized_table(kStart + "\xff\xe1" + std::string(1, '\1') + "\xff" + tables(table(300))));  // within a segment
  CHECK_FALSE(has_oversized_table("\xff\xd7" + tables(table(300))));                                   // no JPEG file
}

TEST_CASE("tables of more codes are found, wherever they stand") {
  for (const int codes : {257, 300, 4080}) {
    const std::string bad = tables(table(codes));
    CHECK(has_oversized_table(kStart + bad));
    CHECK(has_oversized_table("\xff" + kStart + kApplication + bad));
    CHECK(has_oversized_table(kStart + tables(table(5) + table(codes))));
    CHECK(has_oversized_table(kStart + tables(table(codes), 3)));  // longer than its segment
    CHECK(has_oversized_table(kStart + tables(table(7), 2) + bad));
    CHECK(has_oversized_table(kStart + kApplication + "padding" + bad));
    CHECK(has_oversized_table(kStart + kScan + "\xff\xff" + bad));
    CHECK(has_oversized_table((kStart + bad).substr(0, 40)));  // cut off
  }
}

TEST_CASE("a JPEG file with such a table is refused before it is decoded") {
  const std::string path = TYNDALL_SOURCE_DIR "/tests/unit/io/data/halves.jpg";
  std::string bytes = test::read_bytes(path);
  const std::size_t at = bytes.find("\xff\xc4");
  REQUIRE(at != bytes.npos);
  for (std::size_t i = 5; i < 21; ++i) bytes[at + i] = '\xff';
  const test::Scratch folder;
  test::write_bytes(folder / "bad.jpg", bytes);
  CHECK_THROWS_WITH_AS(read_image(folder / "bad.jpg"), doctest::Contains("Huffman table"), Error);
  CHECK_THROWS_WITH_AS(read_image_size(folder / "bad.jpg"), doctest::Contains("Huffman table"), Error);
}

TEST_CASE("a JPEG file that uses a table which it does not have is read or refused, whatever memory held before") {
  std::string bytes = test::read_bytes(TYNDALL_SOURCE_DIR "/tests/unit/io/data/halves.jpg");
  for (std::size_t at = 0; (at = bytes.find("\xff\xc4", at)) != bytes.npos;) bytes[at + 1] = '\xfe';  // a comment
  const test::Scratch folder;
  test::write_bytes(folder / "bare.jpg", bytes);
  for (const char filled : {'\x5a', '\xff', '\x80'}) {
    std::vector<std::string> held;
    for (std::size_t size = 1 << 12; size <= 1 << 16; size += 1 << 11) held.emplace_back(size, filled);
    held.clear();
    try {
      CHECK(read_image(folder / "bare.jpg").width() > 0);
    } catch (const Error& e) {
      CHECK(e.failure() == Failure::scene);
    }
  }
}
