/// Owen-scrambled Sobol points by hashing [Burley 2020, "Practical Hash-based Owen Scrambling"].
#pragma once

#include <cstdint>

namespace tyndall {

constexpr std::uint32_t reverse_bits(std::uint32_t v) {
  v = (v << 16) | (v >> 16);
  v = ((v & 0x00ff00ffu) << 8) | ((v & 0xff00ff00u) >> 8);
  v = ((v & 0x0f0f0f0fu) << 4) | ((v & 0xf0f0f0f0u) >> 4);
  v = ((v & 0x33333333u) << 2) | ((v & 0xccccccccu) >> 2);
  return ((v & 0x55555555u) << 1) | ((v & 0xaaaaaaaau) >> 1);
}

/// Nested uniform scramble of `v`: each bit is flipped by a hash of the bits above it. The hash is Laine and
/// Karras' with the constants of Vegdahl 2021, which scramble more evenly than the original ones.
constexpr std::uint32_t owen_scramble(std::uint32_t v, std::uint32_t seed) {
  v = reverse_bits(v);
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= (seed >> 16) | 1u;
  v ^= v * 0x05526c56u;
  v ^= v * 0x53a22864u;
  return reverse_bits(v);
}

/// First Sobol dimension: the van der Corput sequence, 32 bits of a fraction.
constexpr std::uint32_t sobol_0(std::uint32_t index) { return reverse_bits(index); }

/// Second Sobol dimension: the bits of `index` times Pascal's triangle mod 2, a Kronecker power of (1 1; 0 1), so that
/// five shifts do it [Ahmed 2024]. With the first dimension it makes a (0,2)-sequence in base 2.
constexpr std::uint32_t sobol_1(std::uint32_t index) {
  std::uint32_t v = index;
  v ^= v >> 16;
  v ^= (v & 0xff00ff00u) >> 8;
  v ^= (v & 0xf0f0f0f0u) >> 4;
  v ^= (v & 0xccccccccu) >> 2;
  v ^= (v & 0xaaaaaaaau) >> 1;
  return reverse_bits(v);
}

}  // namespace tyndall
