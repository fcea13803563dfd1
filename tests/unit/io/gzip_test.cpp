#include <zlib.h>

#include "io/file_text.h"
#include "unit/io/reader_checks.h"

using namespace tyndall;

namespace {

std::string gzip(const std::string& text) {
  z_stream z{};
  REQUIRE(deflateInit2(&z, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string out(deflateBound(&z, text.size()) + 64, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  z.avail_in = static_cast<uInt>(text.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  REQUIRE(deflate(&z, Z_FINISH) == Z_STREAM_END);
  out.resize(z.total_out);
  deflateEnd(&z);
  return out;
}

}  // namespace

TEST_CASE("gzip is undone, member after member") {
  std::string text;
  for (int i = 0; i < 200000; ++i) text += std::to_string(i) + " ";
  CHECK(gunzip(gzip(text), "a.gz") == text);
  CHECK(gunzip(gzip("one ") + gzip("two"), "a.gz") == "one two");
  CHECK(gunzip(gzip(""), "a.gz").empty());
}

TEST_CASE("damaged, truncated and exploding gzip data is refused") {
  const std::string whole = gzip(std::string(100000, 'x') + "end");
  for (const std::size_t cut : {std::size_t{3}, std::size_t{15}, whole.size() / 2, whole.size() - 1})
    CHECK_CONTAINS(test::message_of([&] { gunzip(whole.substr(0, cut), "a.gz"); }), "a.gz: gzip data");
  std::string flipped = whole;
  flipped[flipped.size() - 6] ^= 1;  // the checksum
  CHECK_CONTAINS(test::message_of([&] { gunzip(flipped, "a.gz"); }), "damaged");
  CHECK_CONTAINS(test::message_of([&] { gunzip(whole, "a.gz", 1000); }), "unfolds to more than");
}

TEST_CASE("files are read whole, compressed or not, and failures name them") {
  const test::TempFolder folder;
  CHECK(read_file_text(folder.write("plain", "hello")) == "hello");
  CHECK(read_file_text(folder.write("packed", gzip("hello"))) == "hello");
  CHECK(read_file_text(folder.write("empty", "")).empty());
  CHECK_CONTAINS(test::message_of([&] { read_file_text(folder.path() + "/absent"); }), "absent: cannot be read");
  CHECK_CONTAINS(test::message_of([&] { read_file_text(folder.path()); }), "it is a folder");
}

TEST_CASE("a compressed scene reads as the plain one") {
  const test::TempFolder folder;
  const std::string path = folder.write("scene.pbrt.gz", gzip("WorldBegin\nShape \"sphere\"\n"));
  CHECK(read_scene(path).scene.shapes.size() == 1);
}
