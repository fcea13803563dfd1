#include "session/keyed_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

namespace tyndall {
namespace {

constexpr std::size_t kWords = 3;  ///< of an ExactSum: the double, then the float

ExactSum unpacked(const std::uint32_t* words) {
  ExactSum sum;
  std::memcpy(&sum.high, words, sizeof sum.high);
  std::memcpy(&sum.low, words + 2, sizeof sum.low);
  return sum;
}

void pack(const ExactSum& sum, std::uint32_t* words) {
  std::memcpy(words, &sum.high, sizeof sum.high);
  std::memcpy(words + 2, &sum.low, sizeof sum.low);
}

void add_term(std::uint32_t* words, float term) {
  ExactSum sum = unpacked(words);
  sum.add({static_cast<double>(term), 0});
  pack(sum, words);
}

bool is_key(std::uint32_t bits) { return std::isnormal(std::bit_cast<float>(bits)); }

}  // namespace

ExactSum KeyedSums::sum(std::size_t pixel, std::size_t i, std::size_t k) const {
  return unpacked(&pixels_[pixel][i * slot_size() + 1 + kWords * k]);
}

/// Where the key's words begin; new where it has none.
std::size_t KeyedSums::slot_of(std::size_t pixel, std::uint32_t key) {
  Slots& slots = pixels_[pixel];
  std::size_t at = 0;
  while (at < slots.size() && slots[at] < key) at += slot_size();
  if (at == slots.size() || slots[at] != key) {
    slots.insert(slots.begin() + static_cast<std::ptrdiff_t>(at), slot_size(), 0u);
    slots[at] = key;
  }
  return at;
}

void KeyedSums::add(std::size_t pixel, std::uint32_t key, std::span<const float> terms) {
  const std::size_t at = slot_of(pixel, key);
  std::uint32_t* words = pixels_[pixel].data() + at + 1;
  for (const float term : terms) {
    add_term(words, term);
    words += kWords;
  }
}

void KeyedSums::add_to(std::size_t pixel, std::uint32_t key, std::size_t k, float term) {
  const std::size_t at = slot_of(pixel, key);
  add_term(pixels_[pixel].data() + at + 1 + kWords * k, term);
}

KeyedSums KeyedSums::copy(const PixelBounds& crop, const PixelBounds& tile) const {
  KeyedSums sums(tile.size(), width_);
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) sums.pixels_[tile.index(x, y)] = pixels_[crop.index(x, y)];
  }
  return sums;
}

void KeyedSums::restore(const PixelBounds& crop, const PixelBounds& tile, const KeyedSums& sums) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) pixels_[crop.index(x, y)] = sums.pixels_[tile.index(x, y)];
  }
}

void KeyedSums::clear(const PixelBounds& crop, const PixelBounds& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) pixels_[crop.index(x, y)].clear();
  }
}

std::string KeyedSums::bytes() const {
  std::string bytes;
  const auto put = [&](const std::uint32_t* words, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(words), count * sizeof *words);
  };
  for (const Slots& slots : pixels_) {
    const auto count = static_cast<std::uint32_t>(slots.size());
    put(&count, 1);
    put(slots.data(), slots.size());
  }
  return bytes;
}

bool KeyedSums::read(std::string_view bytes) {
  std::vector<Slots> read(pixels_.size());
  const auto take = [&](std::uint32_t* words, std::size_t count) {
    if (count * sizeof *words > bytes.size()) return false;
    std::memcpy(words, bytes.data(), count * sizeof *words);
    bytes.remove_prefix(count * sizeof *words);
    return true;
  };
  for (Slots& slots : read) {
    std::uint32_t count = 0;
    if (!take(&count, 1) || count % slot_size() != 0 || count * sizeof count > bytes.size()) return false;
    slots.resize(count);
    if (!take(slots.data(), count)) return false;
  }
  if (!bytes.empty()) return false;
  pixels_ = std::move(read);
  return true;
}

namespace {

std::string rank_name(const std::string& name, std::size_t rank) { return "Sum." + name + "." + std::to_string(rank) + "."; }
std::string key_name(const std::string& name, std::size_t rank) { return rank_name(name, rank) + "key"; }
std::string part_name(const std::string& name, std::size_t rank, std::size_t k, std::size_t part) {
  constexpr std::array kParts{"high", "mid", "low"};
  return rank_name(name, rank) + std::to_string(k) + "." + kParts[part];
}

/// Of the keys of a pixel `most`, in their order.
std::vector<std::size_t> kept(const KeyedSums& sums, std::size_t pixel, std::size_t most) {
  std::vector<std::size_t> keys(sums.size(pixel));
  std::iota(keys.begin(), keys.end(), std::size_t{0});
  if (keys.size() <= most) return keys;
  std::stable_sort(keys.begin(), keys.end(),
                   [&](std::size_t a, std::size_t b) { return sums.value(pixel, a, 0) > sums.value(pixel, b, 0); });
  keys.resize(most);
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// The channels of one rank, by pixel.
struct RankChannels {
  std::vector<float*> parts;  ///< key, then three for each sum
};

RankChannels add_rank(Image& image, const std::string& name, std::size_t rank, std::size_t width) {
  RankChannels channels;
  channels.parts.push_back(image.add_channel(key_name(name, rank)).values.data());
  for (std::size_t k = 0; k < width; ++k) {
    for (std::size_t p = 0; p < 3; ++p) channels.parts.push_back(image.add_channel(part_name(name, rank, k, p)).values.data());
  }
  return channels;
}

}  // namespace

void store_keyed_sums(const KeyedSums& sums, const std::string& name, std::size_t most, Image& image) {
  std::vector<RankChannels> ranks;
  for (std::size_t pixel = 0; pixel < sums.pixels(); ++pixel) {
    const std::vector<std::size_t> keys = kept(sums, pixel, most);
    while (ranks.size() < keys.size()) ranks.push_back(add_rank(image, name, ranks.size(), sums.width()));
    for (std::size_t i = 0; i < keys.size(); ++i) {
      float* const* part = ranks[i].parts.data();
      (*part++)[pixel] = std::bit_cast<float>(sums.key(pixel, keys[i]));
      for (std::size_t k = 0; k < sums.width(); ++k) {
        for (const float value : split(sums.sum(pixel, keys[i], k))) (*part++)[pixel] = value;
      }
    }
  }
}

void add_keyed_sums(const Image& image, const std::string& name, KeyedSums& sums) {
  for (std::size_t rank = 0; const Channel* keys = image.find(key_name(name, rank)); ++rank) {
    for (std::size_t k = 0; k < sums.width(); ++k) {
      std::array<const Channel*, 3> parts;
      for (std::size_t p = 0; p < 3; ++p) parts[p] = image.find(part_name(name, rank, k, p));
      if (std::find(parts.begin(), parts.end(), nullptr) != parts.end()) return;
      for (std::size_t pixel = 0; pixel < sums.pixels(); ++pixel) {
        const auto key = std::bit_cast<std::uint32_t>(keys->values[pixel]);
        if (!is_key(key)) continue;
        for (const Channel* part : parts) sums.add_to(pixel, key, k, part->values[pixel]);
      }
    }
  }
}

}  // namespace tyndall
