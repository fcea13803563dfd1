/// Damaged copies of files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace tyndall::test {

enum class Damage { truncation, bit_flips, overwrite, number };

/// One damaged copy.
struct Mutant {
  Damage damage = Damage::truncation;
  std::string bytes;
  std::string how;  ///< for messages: "cut to 120 bytes"
};

/// A copy of `bytes`: cut off, with 1 to 8 bits flipped, or with 1, 2, 4 or 8 bytes
/// replaced by a number that programs stumble over (0, -1, the largest, a nearby one, any), or with a number in the text
/// written anew.
Mutant mutant_of(const std::string& bytes, Damage damage, std::uint64_t seed);
/// The first `size` bytes.
Mutant cut(const std::string& bytes, std::size_t size);

}  // namespace tyndall::test
