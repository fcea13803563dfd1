/// Exact sums for what only some of many things leave in a pixel: ids of a matte, places in depth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "session/film_sums.h"
#include "tyndall/image.h"

namespace tyndall {

/// For each pixel some keys, in order, and `width` sums for each of them. Keys are bits of floats above 0 that are neither
/// subnormal nor infinite, so that images can hold them.
class KeyedSums {
 public:
  KeyedSums(std::size_t pixels, std::size_t width) : width_(width), pixels_(pixels) {}

  std::size_t pixels() const { return pixels_.size(); }
  std::size_t width() const { return width_; }
  std::size_t size(std::size_t pixel) const { return pixels_[pixel].size() / slot_size(); }  ///< keys there
  std::uint32_t key(std::size_t pixel, std::size_t i) const { return pixels_[pixel][i * slot_size()]; }
  ExactSum sum(std::size_t pixel, std::size_t i, std::size_t k) const;  ///< number k of the i-th key
  double value(std::size_t pixel, std::size_t i, std::size_t k) const { return sum(pixel, i, k).value(); }

  /// terms[k] to sum number k of `key`.
  void add(std::size_t pixel, std::uint32_t key, std::span<const float> terms);
  /// To sum number k alone.
  void add_to(std::size_t pixel, std::uint32_t key, std::size_t k, float term);

  /// The pixels of `tile`, a part of `crop`, which is what there is here; and back.
  KeyedSums copy(const PixelBounds& crop, const PixelBounds& tile) const;
  void restore(const PixelBounds& crop, const PixelBounds& tile, const KeyedSums& sums);
  void clear(const PixelBounds& crop, const PixelBounds& tile);

  /// All of it, for a checkpoint; and back: false, and as before, for bytes that are none of so many pixels and sums.
  std::string bytes() const;
  bool read(std::string_view bytes);

 private:
  using Slots = std::vector<std::uint32_t>;  ///< key, then each sum in three words
  std::size_t slot_size() const { return 1 + 3 * width_; }
  std::size_t slot_of(std::size_t pixel, std::uint32_t key);

  std::size_t width_;
  std::vector<Slots> pixels_;
};

/// As channels "Sum.NAME.I.key", and for each sum "Sum.NAME.I.K.high", ".mid", ".low", floats that add up to it, I up to what
/// the pixel with most keys needs. Where a pixel has more than `most` keys those are kept whose first sums are the largest.
void store_keyed_sums(const KeyedSums& sums, const std::string& name, std::size_t most, Image& image);
/// Adds what store_keyed_sums put into an image of as many pixels.
void add_keyed_sums(const Image& image, const std::string& name, KeyedSums& sums);

}  // namespace tyndall
