/// Integer hashing that seeds every random stream.
#pragma once

#include <cstdint>

namespace tyndall {

/// Bijective 64-bit mix with full avalanche: the finaliser of splitmix64 [Steele et al. 2014].
constexpr std::uint64_t mix_bits(std::uint64_t v) {
  v ^= v >> 30;
  v *= 0xbf58476d1ce4e5b9ull;
  v ^= v >> 27;
  v *= 0x94d049bb133111ebull;
  v ^= v >> 31;
  return v;
}

/// Hash of a sequence of integers; order matters.
constexpr std::uint64_t hash(std::uint64_t a) { return mix_bits(a + 0x9e3779b97f4a7c15ull); }
template <typename... Rest>
constexpr std::uint64_t hash(std::uint64_t a, Rest... rest) {
  return mix_bits(hash(rest...) ^ (a * 0xd6e8feb86659fd93ull + 0x2545f4914f6cdd1dull));
}

/// Uniform in [0, 1) of uniform bits: the first 24.
constexpr float unit_float(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }

}  // namespace tyndall
