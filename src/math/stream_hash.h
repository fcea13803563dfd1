/// A 64-bit hash of any number of bytes, for telling contents apart (not for keeping secrets).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "math/hash.h"

namespace tyndall {

/// Eight lanes of 64 bits, each mixed with full avalanche after every word it takes, so that changes of a few bits (signs,
/// exponents, neighbouring values) do not cancel. The value depends on the bytes alone, not on how they were cut into calls.
class StreamHash {
 public:
  StreamHash();

  void add(const void* bytes, std::size_t count);
  std::uint64_t value() const;  ///< of everything added so far

 private:
  static constexpr std::size_t kLanes = 8, kBlock = kLanes * sizeof(std::uint64_t);
  using Lanes = std::array<std::uint64_t, kLanes>;

  static void mix_block(Lanes& lanes, const unsigned char* block);

  Lanes lanes_;
  std::array<unsigned char, kBlock> rest_{};  ///< bytes that do not fill a block yet
  std::size_t rest_size_ = 0;
  std::uint64_t total_ = 0;
};

/// 16 hexadecimal digits.
std::string hex_text(std::uint64_t value);

}  // namespace tyndall
