#include "math/stream_hash.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace tyndall {

StreamHash::StreamHash() {
  for (std::size_t i = 0; i < kLanes; ++i) lanes_[i] = hash(i);
}

void StreamHash::mix_block(Lanes& lanes, const unsigned char* block) {
  Lanes words;
  std::memcpy(words.data(), block, kBlock);
  for (std::size_t i = 0; i < kLanes; ++i) lanes[i] = mix_bits((lanes[i] ^ words[i]) + 0x9e3779b97f4a7c15ull);
}

void StreamHash::add(const void* data, std::size_t count) {
  if (count == 0) return;
  const auto* bytes = static_cast<const unsigned char*>(data);
  total_ += count;
  if (rest_size_ > 0) {
    const std::size_t taken = std::min(count, kBlock - rest_size_);
    std::memcpy(rest_.data() + rest_size_, bytes, taken);
    rest_size_ += taken;
    bytes += taken;
    count -= taken;
    if (rest_size_ < kBlock) return;
    mix_block(lanes_, rest_.data());
    rest_size_ = 0;
  }
  Lanes lanes = lanes_;  // a local copy stays in registers
  for (; count >= kBlock; bytes += kBlock, count -= kBlock) mix_block(lanes, bytes);
  lanes_ = lanes;
  std::memcpy(rest_.data(), bytes, count);
  rest_size_ = count;
}

std::uint64_t StreamHash::value() const {
  Lanes lanes = lanes_;
  std::array<unsigned char, kBlock> last{};  // filled up with zeros, which the total tells from zeros that were added
  std::copy_n(rest_.begin(), rest_size_, last.begin());
  mix_block(lanes, last.data());
  std::uint64_t result = hash(total_);
  for (const std::uint64_t lane : lanes) result = hash(result, lane);
  return result;
}

std::string hex_text(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

}  // namespace tyndall
