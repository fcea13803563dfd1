#include "support/mutant.h"

#include <algorithm>
#include <cstring>

#include "math/hash.h"

namespace tyndall::test {
namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}
  std::uint64_t bits() { return hash(seed_, count_++); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % std::max<std::size_t>(n, 1)); }

 private:
  std::uint64_t seed_, count_ = 0;
};

Mutant with_flips(const std::string& bytes, Draw& draw) {
  Mutant m{Damage::bit_flips, bytes, "bits flipped:"};
  const std::size_t count = draw.below(2) == 0 ? 1 : 1 + draw.below(8);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = draw.below(bytes.size()), bit = draw.below(8);
    m.bytes[at] = static_cast<char>(m.bytes[at] ^ (1 << bit));
    m.how += " " + std::to_string(at) + "." + std::to_string(bit);
  }
  return m;
}

Mutant with_number(const std::string& bytes, Draw& draw) {
  const std::size_t size = std::min(std::size_t{1} << draw.below(4), bytes.size());
  const std::size_t at = draw.below(bytes.size() - size + 1);
  std::uint64_t old = 0, value = 0;
  std::memcpy(&old, bytes.data() + at, size);
  const std::uint64_t top = std::uint64_t{1} << (8 * size - 1);
  const std::uint64_t choices[] = {
      0, 1, ~std::uint64_t{0}, top - 1, top, old + 1, old - 1, 2 * old, top >> 1, draw.bits(), draw.bits() >> draw.below(64)};
  value = choices[draw.below(std::size(choices))];
  Mutant m{Damage::overwrite, bytes,
           std::to_string(size) + " bytes at " + std::to_string(at) + " set to " + std::to_string(value)};
  std::memcpy(m.bytes.data() + at, &value, size);
  return m.bytes == bytes ? with_flips(bytes, draw) : m;
}

/// One number in the text, found from a random place on, becomes one that geometry and optics stumble over.
Mutant with_text_number(const std::string& bytes, Draw& draw) {
  static const char* const kNumbers[] = {"0",           "-1",    "1e-38", "1e-30", "1e-10",     "1e10",  "1e30",
                                         "3e38",        "-1e30", "1e39",  "nan",   "0.9999999", "65535", "2147483647",
                                         "-2147483648", "1e-45", "1000",  "-0",    "90",        "180"};
  std::size_t begin = draw.below(bytes.size());
  begin = bytes.find_first_of("0123456789", begin);
  if (begin == std::string::npos) begin = bytes.find_first_of("0123456789");
  if (begin == std::string::npos) return with_flips(bytes, draw);
  while (begin > 0 && std::string("0123456789.-+e").find(bytes[begin - 1]) != std::string::npos) --begin;
  const std::size_t end = std::min(bytes.find_first_not_of("0123456789.-+e", begin), bytes.size());
  const std::string number = kNumbers[draw.below(std::size(kNumbers))];
  return {Damage::number, bytes.substr(0, begin) + number + bytes.substr(end),
          "number at " + std::to_string(begin) + " set to " + number};
}

}  // namespace

Mutant cut(const std::string& bytes, std::size_t size) {
  return {Damage::truncation, bytes.substr(0, size), "cut to " + std::to_string(size) + " bytes"};
}

Mutant mutant_of(const std::string& bytes, Damage damage, std::uint64_t seed) {
  Draw draw(seed);
  if (damage == Damage::truncation || bytes.empty()) return cut(bytes, draw.below(bytes.size()));
  if (damage == Damage::number) return with_text_number(bytes, draw);
  return damage == Damage::bit_flips ? with_flips(bytes, draw) : with_number(bytes, draw);
}

}  // namespace tyndall::test
