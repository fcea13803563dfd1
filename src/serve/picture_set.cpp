#include "serve/picture_set.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "report/page_picture.h"

namespace tyndall {
namespace {

bool is_left_out(std::string_view channel) {
  return channel == "A" || channel.starts_with("Replicate.") || channel.starts_with("Sum.") || channel == "SurfaceCount" ||
         channel == "VolumeCount";
}

/// "Albedo.R" -> "Albedo", "R" -> "", "Z" -> "Z".
std::string group_of(const std::string& channel) {
  static constexpr std::array kParts{"R", "G", "B", "X", "Y"};
  const std::size_t dot = channel.rfind('.');
  const std::string part = dot == std::string::npos ? channel : channel.substr(dot + 1);
  const bool is_part =
      std::find(kParts.begin(), kParts.end(), part) != kParts.end() || (part == "Z" && dot != std::string::npos);
  if (!is_part) return channel;
  return dot == std::string::npos ? "" : channel.substr(0, dot);
}

}  // namespace

std::vector<ServedPicture> pictures_of(const std::shared_ptr<const Image>& image) {
  std::vector<ServedPicture> pictures;
  for (std::size_t c = 0; c < image->channels.size(); ++c) {
    const std::string& channel = image->channels[c].name;
    if (is_left_out(channel)) continue;
    const std::string group = group_of(channel);
    const auto found = std::find_if(pictures.begin(), pictures.end(), [&](const ServedPicture& p) { return p.name == group; });
    if (found != pictures.end())
      found->channels.push_back(c);
    else
      pictures.push_back({.name = group, .image = image, .channels = {c}});
  }
  std::erase_if(pictures, [](const ServedPicture& p) { return p.channels.size() != 1 && p.channels.size() != 3; });
  const bool denoised = image->find("noisy.R") != nullptr;
  for (ServedPicture& p : pictures) {
    if (p.name == "SampleCount") p.kind = ServedPicture::Kind::samples;
    if (p.name == "noisy") p.name = "rendered";
    if (p.name.empty()) p.name = denoised ? "denoised" : "rendered";
  }
  const auto rank = [](const ServedPicture& p) { return p.name == "rendered" ? 0 : p.name == "denoised" ? 1 : 2; };
  std::stable_sort(pictures.begin(), pictures.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return pictures;
}

std::string halves_of(const ServedPicture& picture) {
  std::string bytes;
  bytes.reserve(2 * picture.channels.size() * picture.image->data.size());
  for (const std::size_t c : picture.channels) {
    for (const float value : picture.image->channels[c].values) {
      const std::uint16_t half = to_half(value);
      bytes += static_cast<char>(half & 0xff);
      bytes += static_cast<char>(half >> 8);
    }
  }
  return bytes;
}

}  // namespace tyndall
