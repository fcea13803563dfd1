#include <bit>
#include <cstring>

#include "tyndall/cryptomatte.h"

namespace tyndall {
namespace {

constexpr std::uint32_t kC1 = 0xcc9e2d51, kC2 = 0x1b873593;

std::uint32_t mixed(std::uint32_t block) { return std::rotl(block * kC1, 15) * kC2; }

/// Every bit of the result depends on every bit of `h`.
std::uint32_t finished(std::uint32_t h) {
  h = (h ^ (h >> 16)) * 0x85ebca6b;
  h = (h ^ (h >> 13)) * 0xc2b2ae35;
  return h ^ (h >> 16);
}

}  // namespace

std::uint32_t murmur_hash(std::string_view text) {
  std::uint32_t h = 0;
  std::size_t at = 0;
  for (; at + 4 <= text.size(); at += 4) {
    std::uint32_t block;
    std::memcpy(&block, text.data() + at, 4);
    h = std::rotl(h ^ mixed(block), 13) * 5 + 0xe6546b64;
  }
  std::uint32_t tail = 0;
  for (std::size_t i = text.size(); i > at; --i) tail = (tail << 8) | static_cast<unsigned char>(text[i - 1]);
  if (at < text.size()) h ^= mixed(tail);
  return finished(h ^ static_cast<std::uint32_t>(text.size()));
}

std::uint32_t matte_id(std::string_view name) {
  constexpr std::uint32_t kLowestExponentBit = 1u << 23;
  const std::uint32_t hash = murmur_hash(name), exponent = (hash >> 23) & 255;
  return exponent == 0 || exponent == 255 ? hash ^ kLowestExponentBit : hash;
}

}  // namespace tyndall
