#include "tyndall/cryptomatte.h"

#include <algorithm>
#include <bit>
#include <cstdio>

namespace tyndall {
namespace {

constexpr std::size_t kRanksALayer = 2;  ///< of channels: R G and B A

std::string hex(std::uint32_t value) {
  char text[9];
  std::snprintf(text, sizeof text, "%08x", value);
  return text;
}

/// "cryptomatte/KEY/": any key will do that differs between layers.
std::string attribute_prefix(std::string_view layer) { return "cryptomatte/" + hex(murmur_hash(layer)).substr(0, 7) + "/"; }

std::string json_string(std::string_view text) {
  std::string json = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) {
      json += "\\u00" + hex(static_cast<unsigned char>(c)).substr(6);
      continue;
    }
    if (c == '"' || c == '\\') json += '\\';
    json += c;
  }
  return json + "\"";
}

/// Of id (part 0) or coverage (part 1) of a rank: "CryptoObject00.R" ...
std::string channel_name(std::string_view layer, std::size_t rank, std::size_t part) {
  const char suffix = "RGBA"[2 * (rank % kRanksALayer) + part];
  return std::string(layer) + "0" + std::to_string(rank / kRanksALayer) + "." + suffix;
}

}  // namespace

std::string manifest_text(MatteNames names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::string json = "{";
  for (const auto& [name, id] : names) json += (json.size() > 1 ? "," : "") + json_string(name) + ":\"" + hex(id) + "\"";
  return json + "}";
}

std::string manifest_attribute(std::string_view layer) { return attribute_prefix(layer) + "manifest"; }

void describe_mattes(Image& image, std::string_view layer, const MatteNames& names) {
  const std::string prefix = attribute_prefix(layer);
  image.attributes[prefix + "name"] = std::string(layer);
  image.attributes[prefix + "hash"] = std::string("MurmurHash3_32");
  image.attributes[prefix + "conversion"] = std::string("uint32_to_float32");
  image.attributes[manifest_attribute(layer)] = manifest_text(names);
}

bool is_matte_layer(std::string_view name) {
  return std::find(kMatteLayers.begin(), kMatteLayers.end(), name) != kMatteLayers.end();
}

bool is_matte_channel(std::string_view channel) {
  return std::any_of(kMatteLayers.begin(), kMatteLayers.end(),
                     [&](std::string_view layer) { return channel.starts_with(layer) && channel.size() == layer.size() + 4; });
}

bool has_mattes(const Image& image, std::string_view layer) {
  for (std::size_t rank = 0; rank < kMatteRanks; ++rank) {
    if (!image.find(channel_name(layer, rank, 0)) || !image.find(channel_name(layer, rank, 1))) return false;
  }
  return true;
}

MatteWriter::MatteWriter(Image& image, std::string_view layer) {
  for (std::size_t i = 0; i < ranks_.size(); ++i)
    ranks_[i] = image.add_channel(channel_name(layer, i / 2, i % 2)).values.data();
}

void MatteWriter::set(std::size_t pixel, std::vector<MatteCoverage> covers) {
  std::erase_if(covers, [](const MatteCoverage& c) { return !(c.coverage > 0); });
  std::sort(covers.begin(), covers.end(), [](const MatteCoverage& a, const MatteCoverage& b) {
    return a.coverage != b.coverage ? a.coverage > b.coverage : a.id < b.id;
  });
  for (std::size_t i = 0; i < std::min(covers.size(), kMatteRanks); ++i) {
    ranks_[2 * i][pixel] = std::bit_cast<float>(covers[i].id);
    ranks_[2 * i + 1][pixel] = covers[i].coverage;
  }
}

MatteReader::MatteReader(const Image& image, std::string_view layer) {
  for (std::size_t i = 0; i < ranks_.size(); ++i) ranks_[i] = image.find(channel_name(layer, i / 2, i % 2))->values.data();
}

std::vector<MatteCoverage> MatteReader::at(std::size_t pixel) const {
  std::vector<MatteCoverage> covers;
  for (std::size_t i = 0; i < kMatteRanks && ranks_[2 * i + 1][pixel] > 0; ++i)
    covers.push_back({std::bit_cast<std::uint32_t>(ranks_[2 * i][pixel]), ranks_[2 * i + 1][pixel]});
  return covers;
}

}  // namespace tyndall
