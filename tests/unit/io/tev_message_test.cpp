#include "io/tev_message.h"

#include <doctest/doctest.h>

#include <cstring>

namespace tyndall {
namespace {

/// Reads fields off the front of a message.
struct Fields {
  std::string bytes;

  template <typename T>
  T take() {
    T value;
    REQUIRE(bytes.size() >= sizeof value);
    std::memcpy(&value, bytes.data(), sizeof value);
    bytes.erase(0, sizeof value);
    return value;
  }
  std::string text() {
    const std::size_t end = bytes.find('\0');
    REQUIRE(end != std::string::npos);
    std::string value = bytes.substr(0, end);
    bytes.erase(0, end + 1);
    return value;
  }
};

Image picture() {
  Image image;
  image.data = {10, 20, 13, 22};
  image.add_channel("R").values = {1, 2, 3, 4, 5, 6};
  image.add_channel("Albedo.G").values = {10, 20, 30, 40, 50, 60};
  return image;
}

TEST_CASE("an image is made in the viewer with its size and channels") {
  const std::string message = tev_create("a.exr", picture());
  Fields f{message};
  CHECK(f.take<std::uint32_t>() == message.size());
  CHECK(f.take<std::uint8_t>() == 4);
  CHECK(f.take<std::uint8_t>() == 0);
  CHECK(f.text() == "a.exr");
  CHECK(f.take<std::int32_t>() == 3);
  CHECK(f.take<std::int32_t>() == 2);
  CHECK(f.take<std::int32_t>() == 2);
  CHECK(f.text() == "R");
  CHECK(f.text() == "Albedo.G");
  CHECK(f.bytes.empty());
}

TEST_CASE("a tile has its place, and its values channel by channel") {
  const std::string message = tev_update("a.exr", picture(), {1, 0, 3, 2});
  Fields f{message};
  CHECK(f.take<std::uint32_t>() == message.size());
  CHECK(f.take<std::uint8_t>() == 6);
  CHECK(f.take<std::uint8_t>() == 0);
  CHECK(f.text() == "a.exr");
  CHECK(f.take<std::int32_t>() == 2);
  CHECK(f.text() == "R");
  CHECK(f.text() == "Albedo.G");
  for (const int wanted : {1, 0, 2, 2}) CHECK(f.take<std::int32_t>() == wanted);
  for (const int wanted : {0, 4, 1, 1}) CHECK(f.take<std::int64_t>() == wanted);  // offsets, strides
  for (const float wanted : {2.0f, 3.0f, 5.0f, 6.0f, 20.0f, 30.0f, 50.0f, 60.0f}) CHECK(f.take<float>() == wanted);
  CHECK(f.bytes.empty());
}

}  // namespace
}  // namespace tyndall
