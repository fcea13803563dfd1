#include "session/keyed_sums.h"

#include <doctest/doctest.h>

#include <bit>
#include <limits>

#include "math/rng.h"

using namespace tyndall;

namespace {

constexpr std::uint32_t kKeys[]{0x10000000, 0x3f800000, 0x00800001, 0xff0d97ef};
constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

void add(KeyedSums& sums, std::size_t pixel, std::uint32_t key, float a, float b) {
  const float terms[]{a, b};
  sums.add(pixel, key, terms);
}

bool equal(const KeyedSums& a, const KeyedSums& b) {
  if (a.pixels() != b.pixels()) return false;
  for (std::size_t pixel = 0; pixel < a.pixels(); ++pixel) {
    if (a.size(pixel) != b.size(pixel)) return false;
    for (std::size_t i = 0; i < a.size(pixel); ++i) {
      if (a.key(pixel, i) != b.key(pixel, i)) return false;
      for (std::size_t k = 0; k < a.width(); ++k) {
        if (a.value(pixel, i, k) != b.value(pixel, i, k)) return false;
      }
    }
  }
  return true;
}

}  // namespace

TEST_CASE("sums are kept by key, in the order of the keys") {
  KeyedSums sums(2, 2);
  for (const std::uint32_t key : {kKeys[3], kKeys[0], kKeys[1]}) add(sums, 1, key, 1, 2);
  add(sums, 1, kKeys[0], 0.5f, -1);
  CHECK(sums.size(0) == 0);
  REQUIRE(sums.size(1) == 3);
  CHECK(sums.key(1, 0) == kKeys[0]);
  CHECK(sums.key(1, 2) == kKeys[3]);
  CHECK(sums.value(1, 0, 0) == 1.5);
  CHECK(sums.value(1, 0, 1) == 1);
  CHECK(sums.value(1, 1, 1) == 2);
}

TEST_CASE("sums of parts, through an image and in any order, are the sums of the whole") {
  KeyedSums whole(3, 2), parts[2]{KeyedSums(3, 2), KeyedSums(3, 2)};
  Rng rng(7);
  for (int i = 0; i < 300; ++i) {
    const std::size_t pixel = static_cast<std::size_t>(rng.uniform() * 3);
    const std::uint32_t key = kKeys[static_cast<std::size_t>(rng.uniform() * 4)];
    const float a = rng.uniform() - 0.3f, b = rng.uniform() * 1e6f;
    add(whole, pixel, key, a, b);
    add(parts[i % 2], pixel, key, a, b);
  }
  KeyedSums joined(3, 2);
  for (const std::size_t p : {1, 0}) {
    Image image;
    image.data = {0, 0, 3, 1};
    store_keyed_sums(parts[p], "Layer", kAll, image);
    CHECK(image.find("Sum.Layer.3.key"));
    CHECK_FALSE(image.find("Sum.Layer.4.key"));
    add_keyed_sums(image, "Layer", joined);
  }
  CHECK(equal(joined, whole));
}

TEST_CASE("where there are too many keys the largest stay") {
  KeyedSums sums(1, 1);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const float term = static_cast<float>((i * 7) % 20);
    sums.add(0, 0x3f800000 + i, {&term, 1});
  }
  Image image;
  image.data = {0, 0, 1, 1};
  store_keyed_sums(sums, "Layer", 12, image);
  KeyedSums kept(1, 1);
  add_keyed_sums(image, "Layer", kept);
  REQUIRE(kept.size(0) == 12);
  for (std::size_t i = 0; i < 12; ++i) CHECK(kept.value(0, i, 0) >= 8);
}

TEST_CASE("tiles are taken out and put back") {
  const PixelBounds crop{2, 1, 5, 4}, tile{3, 2, 5, 4};
  KeyedSums sums(crop.size(), 2);
  for (std::size_t pixel = 0; pixel < crop.size(); ++pixel) add(sums, pixel, kKeys[pixel % 4], static_cast<float>(pixel), 1);
  const KeyedSums before = sums, part = sums.copy(crop, tile);
  CHECK(part.pixels() == 4);
  CHECK(part.value(0, 0, 0) == 4);
  for (std::size_t pixel = 0; pixel < crop.size(); ++pixel) add(sums, pixel, kKeys[0], 1, 1);
  sums.restore(crop, tile, part);
  CHECK(sums.size(crop.index(2, 1)) == 1);
  CHECK(sums.value(crop.index(2, 1), 0, 0) == 1);
  CHECK(sums.value(crop.index(3, 2), 0, 0) == before.value(crop.index(3, 2), 0, 0));
  sums.clear(crop, tile);
  CHECK(sums.size(crop.index(4, 3)) == 0);
  CHECK(sums.size(crop.index(2, 2)) > 0);
}

TEST_CASE("bytes are read back, and others refused") {
  KeyedSums sums(3, 2), read(3, 2);
  add(sums, 0, kKeys[1], 0.1f, 0.2f);
  add(sums, 0, kKeys[1], 1e9f, 0.7f);
  add(sums, 2, kKeys[3], -1, 5);
  const std::string bytes = sums.bytes();
  CHECK(read.read(bytes));
  CHECK(equal(sums, read));
  for (std::size_t length = 0; length < bytes.size(); ++length) CHECK_FALSE(read.read(bytes.substr(0, length)));
  CHECK_FALSE(read.read(bytes + "more"));
  CHECK(equal(sums, read));
  CHECK_FALSE(KeyedSums(2, 2).read(bytes));
}
