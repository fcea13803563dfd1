/// Mattes of objects, materials and media in an image: layers of ids and coverages [Friedman and Jones 2015, Cryptomatte
/// Specification 1.2].
///
/// A layer "CryptoObject" has channels CryptoObject00.R .G .B .A, CryptoObject01.R ...: R and B are ids, G and A the coverage
/// of the id before it, in [0, 1], the largest first; 0 in both: nobody. An id is the hash of a name, kept in the bits of a
/// float. The header tells the names: "cryptomatte/KEY/name", "hash", "conversion" and "manifest", where KEY is of the layer's
/// name.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tyndall/image.h"

namespace tyndall {

/// In the order of their AOVs, which have the same names.
inline constexpr std::array<std::string_view, 3> kMatteLayers{"CryptoObject", "CryptoMaterial", "CryptoMedium"};
bool is_matte_layer(std::string_view name);  ///< one of these
/// Ids a pixel that an image keeps of a layer.
inline constexpr std::size_t kMatteRanks = 6;

/// An id and how much of a pixel it covers.
struct MatteCoverage {
  std::uint32_t id = 0;
  float coverage = 0;
};

/// MurmurHash3_x86_32 with seed 0 of the bytes of `text` [Appleby 2011].
std::uint32_t murmur_hash(std::string_view text);
/// That of a name, with the lowest bit of the exponent turned where the float of these bits would be 0, subnormal, infinite or
/// no number.
std::uint32_t matte_id(std::string_view name);

/// (name, id) of a layer; names are UTF-8.
using MatteNames = std::vector<std::pair<std::string, std::uint32_t>>;
/// {"name":"8 hex digits of the id",...}, by names, each once.
std::string manifest_text(MatteNames names);

/// Adds to the header what it says of a layer.
void describe_mattes(Image& image, std::string_view layer, const MatteNames& names);
/// Name of the attribute that holds the layer's manifest.
std::string manifest_attribute(std::string_view layer);

/// Whether a channel is one of a layer of kMatteLayers.
bool is_matte_channel(std::string_view channel);
/// Whether all channels of a layer are there.
bool has_mattes(const Image& image, std::string_view layer);

/// Writes a layer's channels, which it adds to the image; that must outlive it.
class MatteWriter {
 public:
  MatteWriter(Image& image, std::string_view layer);
  /// Of a pixel, by its number in the data window, the largest of `covers`; equal ones by their ids. Those not above 0 are left
  /// out.
  void set(std::size_t pixel, std::vector<MatteCoverage> covers);

 private:
  std::array<float*, 2 * kMatteRanks> ranks_;  ///< id, coverage, id ...
};

/// Reads the channels of a layer that the image has; that must outlive it.
class MatteReader {
 public:
  MatteReader(const Image& image, std::string_view layer);
  /// Of a pixel, the largest first.
  std::vector<MatteCoverage> at(std::size_t pixel) const;

 private:
  std::array<const float*, 2 * kMatteRanks> ranks_;
};

}  // namespace tyndall
