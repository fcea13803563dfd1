#include "io/exr_layout.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tyndall/cryptomatte.h"

namespace tyndall {
namespace {

constexpr const char* kMain = "rgba";

std::string group_of(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  if (dot != std::string::npos) return channel.substr(0, dot);
  return channel == "R" || channel == "G" || channel == "B" || channel == "A" ? kMain : channel;
}

float rounded_to_half(float value) {
  constexpr float kMost = 65504;
  if (!std::isnan(value)) value = std::clamp(value, -kMost, kMost);
  return static_cast<float>(Imath::half(value));
}

}  // namespace

bool is_half_channel(const std::string& name) {
  for (const char* statistic : {"Variance.", "Mse.", "Dof.", "Replicate.", "Sum."})
    if (name.starts_with(statistic)) return false;
  if (is_matte_channel(name)) return false;                   // ids
  const std::string last = name.substr(name.rfind('.') + 1);  // npos + 1 = 0
  return last == "R" || last == "G" || last == "B" || last == "A";
}

Image rounded_to_halves(Image image) {
  for (Channel& c : image.channels)
    if (is_half_channel(c.name)) std::transform(c.values.begin(), c.values.end(), c.values.begin(), rounded_to_half);
  return image;
}

std::vector<ExrPart> parts_of(const Image& image, bool several) {
  std::vector<ExrPart> parts;
  if (!several) {
    parts.push_back({kMain, std::vector<std::size_t>(image.channels.size())});
    std::iota(parts[0].channels.begin(), parts[0].channels.end(), std::size_t{0});
    return parts;
  }
  for (std::size_t i = 0; i < image.channels.size(); ++i) {
    const std::string group = group_of(image.channels[i].name);
    auto part = std::find_if(parts.begin(), parts.end(), [&](const ExrPart& p) { return p.name == group; });
    if (part == parts.end()) part = parts.insert(group == kMain ? parts.begin() : parts.end(), {group, {}});
    part->channels.push_back(i);
  }
  return parts;
}

}  // namespace tyndall
