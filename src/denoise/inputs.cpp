#include "denoise/inputs.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "tyndall/error.h"
#include "tyndall/image_attributes.h"
#include "tyndall/lights.h"

namespace tyndall {
namespace {

constexpr std::array kXyz{"X", "Y", "Z"};

const std::string kReplicate = "Replicate.";

/// Samples of a pixel, all and the even ones.
class SampleCounts {
 public:
  explicit SampleCounts(const Image& image) : all_(image.find("SampleCount")), even_(image.find(kReplicate + "SampleCount")) {
    if (const auto* samples = image.attribute<int>(attributes::kSamples)) samples_ = static_cast<float>(*samples);
  }

  float all(std::size_t i) const { return all_ ? all_->values[i] : samples_; }
  float even(std::size_t i) const { return even_ ? even_->values[i] : std::ceil(all(i) / 2); }
  /// Of a mean over all samples whose even half is `even`. A pixel without samples is black.
  float odd_mean(std::size_t i, float mean, float even_mean) const {
    const float odd = all(i) - even(i);
    return odd > 0 ? (mean * all(i) - even_mean * even(i)) / odd : mean;
  }
  /// Of the picture.
  float even_share() const {
    if (!all_ || !even_) return samples_ > 1 ? std::ceil(samples_ / 2) / samples_ : 0.5f;
    double all = 0, even = 0;
    for (const float v : all_->values) all += v;
    for (const float v : even_->values) even += v;
    return all > 0 ? static_cast<float>(even / all) : 0.5f;
  }
  bool two_halves() const {
    if (!all_) return samples_ > 1;
    return std::any_of(all_->values.begin(), all_->values.end(), [](float v) { return v > 1; });
  }

 private:
  const Channel *all_, *even_;
  float samples_ = 0;
};

/// Squares, and sums of them, are floats.
constexpr float kLargest = 1e15f;

PaddedPlane plane_of(const Image& image, const std::function<float(std::size_t)>& value) {
  PaddedPlane plane(image.width(), image.height());
  std::size_t i = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x, ++i) {
      const float v = value(i);
      plane.at(x, y) = std::isfinite(v) ? std::clamp(v, -kLargest, kLargest) : 0.0f;
    }
  }
  plane.extend();
  return plane;
}

/// A channel's even half and its odd one; `count` (may be empty) names the channel that says over how many samples it is: the
/// value then counts as 0 in the others.
std::array<PaddedPlane, 2> halves_of(const Image& image, const std::string& channel, const std::string& count = {}) {
  const SampleCounts samples(image);
  const Channel *all = image.find(channel), *even = image.find(kReplicate + channel);
  const Channel *all_count = image.find(count), *even_count = image.find(kReplicate + count);
  const auto mean = [&](std::size_t i) {
    return all->values[i] * (all_count ? all_count->values[i] / std::max(samples.all(i), 1.0f) : 1.0f);
  };
  const auto even_mean = [&](std::size_t i) {
    return even->values[i] * (even_count ? even_count->values[i] / std::max(samples.even(i), 1.0f) : 1.0f);
  };
  return {plane_of(image, even_mean),
          plane_of(image, [&](std::size_t i) { return samples.odd_mean(i, mean(i), even_mean(i)); })};
}

Feature feature_of(const Image& image, const std::vector<std::string>& channels, const std::string& count) {
  Feature feature;
  for (const std::string& channel : channels) {
    auto [even, odd] = halves_of(image, channel, count);
    feature.halves[0].push_back(std::move(even));
    feature.halves[1].push_back(std::move(odd));
  }
  return feature;
}

std::vector<std::string> names(const std::string& prefix, const std::array<const char*, 3>& suffixes) {
  std::vector<std::string> list;
  for (const char* suffix : suffixes) list.push_back(prefix + suffix);
  return list;
}

bool all_there(const Image& image, const std::vector<std::string>& channels, const std::string& prefix = {}) {
  return std::all_of(channels.begin(), channels.end(), [&](const std::string& c) { return image.find(prefix + c) != nullptr; });
}

bool has_halves(const Image& image, const std::vector<std::string>& channels) {
  return all_there(image, channels) && all_there(image, channels, kReplicate);
}

/// The light split.
const std::vector<Component>& components_of_light() {
  static const std::vector<Component> components{{"Emission.", Explained::by_all, true},
                                                 {"SurfaceDirect.", Explained::by_all},
                                                 {"SurfaceIndirect.", Explained::by_all},
                                                 {"VolumeDirect.", Explained::by_media},
                                                 {"VolumeIndirect.", Explained::by_media}};
  return components;
}

struct FeatureKind {
  const char* aov;
  std::vector<std::string> channels;
  const char* count;  ///< "" when a mean over all samples
  bool of_media;
  const char* cost;
};

const std::vector<FeatureKind>& feature_kinds() {
  static const std::vector<FeatureKind> kinds{
      {"Albedo", names("Albedo.", kRgb), "", false, "textures are blurred"},
      {"N", names("N.", kXyz), "", false, "edges between surfaces are blurred"},
      {"Z", {"Z"}, "SurfaceCount", false, "edges between surfaces are blurred"},
      {"Transmittance", names("Transmittance.", kRgb), "", true, "edges of smoke are blurred"},
      {"Zvol", {"Zvol"}, "VolumeCount", true, "smoke in front of smoke is blurred"},
  };
  return kinds;
}

std::size_t channels_of(const std::vector<Feature>& features) {
  std::size_t count = 0;
  for (const Feature& feature : features) count += feature.halves[0].size();
  return count;
}

}  // namespace

std::vector<std::string> input_aovs() {
  std::vector<std::string> aovs{"SampleCount", "Replicate"};
  for (const FeatureKind& kind : feature_kinds()) aovs.emplace_back(kind.aov);
  for (const Component& c : components_of_light()) aovs.push_back(c.prefix.substr(0, c.prefix.size() - 1));
  return aovs;
}

std::vector<Component> components_of(const Image& image, const std::string& name) {
  if (image.find("noisy.R") || image.attributes.contains(attributes::kDenoised))
    throw Error(Failure::scene, name + ": is denoised already; give the image that was rendered");
  if (!has_halves(image, names("", kRgb))) {
    throw Error(Failure::scene, name + ": holds no replicates, from which noise can be told; render with --denoise, or with " +
                                    "--aov Denoise to denoise later");
  }
  if (!SampleCounts(image).two_halves()) {
    throw Error(Failure::scene, name + ": has one sample a pixel, and with it no replicates; render two or more to denoise");
  }
  if (image.attributes.contains(attributes::kSlice))
    throw Error(Failure::scene, name + ": is a slice of a render; merge all slices first");
  const std::vector<Component>& parts = components_of_light();
  const bool split =
      std::all_of(parts.begin(), parts.end(), [&](const Component& c) { return has_halves(image, names(c.prefix, kRgb)); });
  return split ? parts : std::vector<Component>{{"", Explained::by_all}};
}

std::vector<std::string> groups_of(const Image& image) {
  std::vector<std::string> prefixes;
  for (const std::string& group : light_groups_in(image)) {
    const std::string prefix = light_group_channel(group);
    if (has_halves(image, names(prefix, kRgb))) prefixes.push_back(prefix);
  }
  return prefixes;
}

ColorPlanes read_light(const Image& image) {
  ColorPlanes light;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<float>& values = image.find(kRgb[c])->values;
    light[c] = plane_of(image, [&](std::size_t i) { return values[i]; });
  }
  return light;
}

Halves read_halves(const Image& image, const std::string& prefix) {
  Halves halves;
  for (std::size_t c = 0; c < 3; ++c) {
    auto [even, odd] = halves_of(image, prefix + kRgb[c]);
    halves.values[0][c] = std::move(even);
    halves.values[1][c] = std::move(odd);
  }
  const float even = SampleCounts(image).even_share();
  halves.share = {even, 1 - even};
  return halves;
}

FeatureInputs read_features(const Image& image) {
  FeatureInputs inputs;
  for (const FeatureKind& kind : feature_kinds()) {
    if (!has_halves(image, kind.channels)) {
      inputs.missing.push_back(std::string(kind.aov) + ": " + kind.cost);
      continue;
    }
    if (std::string(kind.aov) == "Transmittance") inputs.transmittance = channels_of(inputs.media);
    auto& group = kind.of_media ? inputs.media : inputs.surfaces;
    group.push_back(feature_of(image, kind.channels, kind.count));
  }
  return inputs;
}

}  // namespace tyndall
