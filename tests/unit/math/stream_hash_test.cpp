#include "math/stream_hash.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

#include "math/rng.h"

using namespace tyndall;

namespace {

using Bytes = std::vector<unsigned char>;

std::uint64_t hash_of(const Bytes& bytes) {
  StreamHash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

Bytes random_bytes(std::size_t count, std::uint64_t seed) {
  Rng rng(seed);
  Bytes bytes(count);
  for (auto& b : bytes) b = static_cast<unsigned char>(rng.next());
  return bytes;
}

}  // namespace

TEST_CASE("the value does not depend on how the bytes come in") {
  const Bytes bytes = random_bytes(1000, 1);
  const std::uint64_t whole = hash_of(bytes);
  Rng rng(2);
  for (int repeat = 0; repeat < 200; ++repeat) {
    StreamHash hash;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t count = std::min<std::size_t>(bytes.size() - at, rng.next() % (repeat % 2 ? 200 : 9));
      hash.add(bytes.data() + at, count);
      at += count;
    }
    CHECK(hash.value() == whole);
  }
}

TEST_CASE("every bit and the length count, and a changed bit changes half of the value") {
  for (const std::size_t size : {1, 7, 63, 64, 65, 200}) {
    Bytes bytes = random_bytes(size, size);
    const std::uint64_t before = hash_of(bytes);
    int flipped = 0;
    for (std::size_t bit = 0; bit < 8 * size; ++bit) {
      bytes[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
      const std::uint64_t after = hash_of(bytes);
      CHECK(after != before);
      flipped += std::popcount(after ^ before);
      bytes[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
    }
    // 64 coins a bit: the mean within 5 standard errors.
    const double coins = 64.0 * 8 * static_cast<double>(size);
    CHECK(std::abs(flipped - coins / 2) < 5 * std::sqrt(coins) / 2);
  }
  std::set<std::uint64_t> zeros;
  for (std::size_t size = 0; size < 300; ++size) zeros.insert(hash_of(Bytes(size)));
  CHECK(zeros.size() == 300);
}

TEST_CASE("changes that scenes see do not cancel: pairs of signs, swapped neighbours") {
  std::vector<float> values(256);
  std::iota(values.begin(), values.end(), 1.0f);
  const auto value = [&] {
    StreamHash hash;
    hash.add(values.data(), values.size() * sizeof(float));
    return hash.value();
  };
  std::set<std::uint64_t> seen{value()};
  std::size_t count = 1;
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t j = i + 1; j < values.size(); ++j) {
      values[i] = -values[i], values[j] = -values[j];
      seen.insert(value());
      values[i] = -values[i], values[j] = -values[j];
      std::swap(values[i], values[j]);
      seen.insert(value());
      std::swap(values[i], values[j]);
      count += 2;
    }
  }
  CHECK(seen.size() == count);
}

TEST_CASE("as text it has all its 16 digits") {
  CHECK(hex_text(0) == "0000000000000000");
  CHECK(hex_text(0x0123456789abcdef) == "0123456789abcdef");
}
