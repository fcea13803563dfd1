#include "report/relight.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "tyndall/error.h"
#include "tyndall/image_attributes.h"
#include "tyndall/lights.h"

namespace tyndall {
namespace {

constexpr std::array<const char*, 3> kSuffixes{"R", "G", "B"};
const std::string kReplicate = "Replicate.", kVariance = "Variance.";

std::string names_text(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

std::vector<float>* values_of(Image& image, const std::string& name) {
  for (Channel& c : image.channels) {
    if (c.name == name) return &c.values;
  }
  return nullptr;
}

/// One of R, G and B, with what is known of it group by group.
class Mixer {
 public:
  Mixer(Image& image, const std::vector<std::string>& groups, const std::vector<Rgb>& factors, int channel)
      : image_(image), groups_(groups), suffix_(kSuffixes[static_cast<std::size_t>(channel)]) {
    for (const Rgb& factor : factors) factors_.push_back(factor[channel]);
  }

  void mix() {
    if (same_everywhere() == 1.0) return;  // to the bit
    auto* const variance = values_of(image_, kVariance + suffix_);
    const bool measured = variance && has_halves();
    if (variance && !measured) bound_variance(*variance);
    mix_means("");
    mix_means(kReplicate);
    if (measured) measure_variance(*variance);
    scale(kVariance, true);
  }

 private:
  using Planes = std::vector<std::vector<float>*>;

  std::optional<double> same_everywhere() const {
    const bool same = std::all_of(factors_.begin(), factors_.end(), [&](double f) { return f == factors_.front(); });
    return same ? std::optional(factors_.front()) : std::nullopt;
  }

  Planes group_planes(const std::string& prefix) {
    Planes planes;
    for (const std::string& group : groups_) planes.push_back(values_of(image_, prefix + light_group_channel(group) + suffix_));
    return planes;
  }
  static bool complete(const Planes& planes) { return std::find(planes.begin(), planes.end(), nullptr) == planes.end(); }

  void scale(const std::string& prefix, bool squared) {
    const Planes planes = group_planes(prefix);
    for (std::size_t g = 0; g < planes.size(); ++g) {
      const double factor = squared ? factors_[g] * factors_[g] : factors_[g];
      if (!planes[g] || factor == 1) continue;
      for (float& v : *planes[g]) v = static_cast<float>(factor * v);
    }
  }

  void mix_means(const std::string& prefix) {
    auto* const sum = values_of(image_, prefix + suffix_);
    const Planes planes = group_planes(prefix);
    if (!sum || !complete(planes)) return;
    for (std::size_t i = 0; i < sum->size(); ++i) {
      double light = 0;
      for (std::size_t g = 0; g < planes.size(); ++g) light += factors_[g] * (*planes[g])[i];
      (*sum)[i] = static_cast<float>(light);
    }
    scale(prefix, false);
  }

  /// Not of several renders, whose variance is known with more degrees of freedom, nor of a filtered picture.
  bool has_halves() {
    const bool one_render =
        !image_.attributes.contains(attributes::kSlices) && !image_.attributes.contains(attributes::kDenoised);
    return one_render && (image_.attribute<int>(attributes::kSamples) || image_.find("SampleCount")) &&
           values_of(image_, kReplicate + "SampleCount") && values_of(image_, kReplicate + suffix_) &&
           complete(group_planes(kReplicate));
  }

  /// As a render does: of the means m over n samples and e over k of them, that over the others differs from e by
  /// n (m - e) / (n - k), and the variance of m is that squared times k (n - k) / n^2.
  void measure_variance(std::vector<float>& variance) {
    const int* everywhere = image_.attribute<int>(attributes::kSamples);
    const auto* each = values_of(image_, "SampleCount");
    const auto& all = *values_of(image_, suffix_);
    const auto& even = *values_of(image_, kReplicate + suffix_);
    const auto& counts = *values_of(image_, kReplicate + "SampleCount");
    for (std::size_t i = 0; i < variance.size(); ++i) {
      const double n = everywhere ? *everywhere : double{(*each)[i]}, k = counts[i], difference = double{all[i]} - even[i];
      variance[i] = static_cast<float>(n > k ? difference * difference * k / (n - k) : double{all[i]} * all[i]);
    }
  }

  /// Groups of one render share their paths, so that their noise is correlated, nobody knows how. The deviation of a sum is at
  /// most the sum of deviations [Minkowski]: of c times all light and (f - c) times each group, for the best c. It is exact
  /// where all factors are equal, and where one group alone is left.
  void bound_variance(std::vector<float>& variance) {
    const Planes planes = group_planes(kVariance);
    if (!complete(planes)) {
      std::erase_if(image_.channels, [&](const Channel& c) { return c.name == kVariance + suffix_; });
      return;
    }
    for (std::size_t i = 0; i < variance.size(); ++i) {
      const double least = least_deviation(std::sqrt(double{variance[i]}), [&](std::size_t g) { return (*planes[g])[i]; });
      variance[i] = static_cast<float>(least * least);
    }
  }

  /// Least where c is one of the factors, or 0: in between it is linear.
  template <typename VarianceOf>
  double least_deviation(double of_all, const VarianceOf& variance_of) const {
    const auto deviation_at = [&](double c) {
      double sum = std::abs(c) * of_all;
      for (std::size_t g = 0; g < factors_.size(); ++g) sum += std::abs(factors_[g] - c) * std::sqrt(double{variance_of(g)});
      return sum;
    };
    double least = deviation_at(0);
    for (const double c : factors_) least = std::min(least, deviation_at(c));
    return least;
  }

  Image& image_;
  const std::vector<std::string>& groups_;
  std::string suffix_;
  std::vector<double> factors_;  ///< by group
};

std::vector<Rgb> factors_by_group(const std::vector<std::string>& groups, std::span<const GroupFactor> factors,
                                  const std::string& name) {
  std::vector<std::optional<Rgb>> given(groups.size());
  for (const GroupFactor& f : factors) {
    const auto group = std::find(groups.begin(), groups.end(), f.group);
    if (group == groups.end())
      throw Error(Failure::usage, name + " has no light group \"" + f.group + "\"; it has " + names_text(groups));
    auto& factor = given[static_cast<std::size_t>(group - groups.begin())];
    if (factor) throw Error(Failure::usage, "light group \"" + f.group + "\" is given two factors; give one");
    factor = f.factor;
  }
  std::vector<Rgb> all;
  for (const auto& factor : given) all.push_back(factor.value_or(Rgb(1.0f)));
  return all;
}

/// By what it is made of: light without groups, and what a filter says of such light.
std::string ungrouped_light(const std::string& channel) {
  const std::string name = channel.starts_with(kReplicate) ? channel.substr(kReplicate.size()) : channel;
  for (const std::string kind :
       {"Emission", "SurfaceDirect", "SurfaceIndirect", "VolumeDirect", "VolumeIndirect", "noisy", "Mse"}) {
    if (name.starts_with(kind + ".")) return kind;
  }
  return {};
}

void scale_ungrouped(Image& image, Rgb factor) {
  for (Channel& c : image.channels) {
    const std::string kind = ungrouped_light(c.name);
    if (kind.empty()) continue;
    const auto k = static_cast<int>(std::string_view("RGB").find(c.name.back()));
    const float s = kind == "Mse" ? factor[k] * factor[k] : factor[k];
    for (float& v : c.values) v *= s;
  }
}

std::vector<std::string> leave_out_ungrouped(Image& image) {
  std::vector<std::string> kinds;
  std::erase_if(image.channels, [&](const Channel& c) {
    const std::string kind = ungrouped_light(c.name);
    if (!kind.empty() && std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
    return !kind.empty();
  });
  return kinds;
}

std::string number_text(float value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string relight_text(const std::vector<std::string>& groups, const std::vector<Rgb>& factors) {
  std::string text;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Rgb f = factors[g];
    text += (text.empty() ? "" : " ") + groups[g] + "=" + number_text(f.r) + "," + number_text(f.g) + "," + number_text(f.b);
  }
  return text;
}

}  // namespace

GroupFactor parse_group_factor(const std::string& text) {
  const auto fail = [&]() -> Error {
    return Error(Failure::usage, "\"" + text + "\" is no factor of a light group; give NAME=FACTOR or NAME=R,G,B, as key=1.5");
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw fail();
  std::vector<float> numbers;
  const char* at = text.data() + equals + 1;
  const char* const end = text.data() + text.size();
  for (;;) {
    float value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value) || value < 0) throw fail();
    numbers.push_back(value);
    if (next == end) break;
    if (*next != ',') throw fail();
    at = next + 1;
  }
  if (numbers.size() == 1) return {text.substr(0, equals), Rgb(numbers[0])};
  if (numbers.size() != 3) throw fail();
  return {text.substr(0, equals), Rgb{numbers[0], numbers[1], numbers[2]}};
}

Relit relight(Image image, std::span<const GroupFactor> factors, const std::string& name) {
  const std::vector<std::string> groups = light_groups_in(image);
  if (groups.empty())
    throw Error(Failure::scene, name + ": has no light groups; render it from a scene whose lights have \"string lightgroup\"");
  if (image.attributes.contains(attributes::kSlice))
    throw Error(Failure::scene, name + ": is a slice of a render; merge all slices first");
  for (const char* suffix : kSuffixes) {
    if (!image.find(suffix)) throw Error(Failure::scene, name + ": has no channel " + suffix + "; render it again");
  }
  const std::vector<Rgb> by_group = factors_by_group(groups, factors, name);
  Relit relit{std::move(image), {}};
  for (int k = 0; k < 3; ++k) Mixer(relit.image, groups, by_group, k).mix();
  const Rgb first = by_group.front();
  const auto same = [&](const Rgb& f) { return f.r == first.r && f.g == first.g && f.b == first.b; };
  if (std::all_of(by_group.begin(), by_group.end(), same)) {
    scale_ungrouped(relit.image, first);
  } else {
    relit.left_out = leave_out_ungrouped(relit.image);
  }
  std::string text = relight_text(groups, by_group);
  if (const auto* before = relit.image.attribute<std::string>(attributes::kRelight)) text = *before + "; " + text;
  relit.image.attributes[attributes::kRelight] = text;
  return relit;
}

}  // namespace tyndall
