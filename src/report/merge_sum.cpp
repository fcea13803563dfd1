#include "report/merge_sum.h"

#include <algorithm>

#include "report/slice.h"

namespace tyndall {

namespace {

/// "Replicate." for a mean over the even samples, "" for one over all.
std::string prefix_of(const std::string& channel) {
  static const std::string replicate = "Replicate.";
  return channel.starts_with(replicate) ? replicate : std::string();
}

}  // namespace

MergeSum::Rule MergeSum::rule_of(const std::string& name) {
  const std::string channel = name.substr(prefix_of(name).size());
  if (channel == "SampleCount") return Rule::samples;
  if (channel == "SampleWeight") return Rule::weight;
  if (channel == "SurfaceCount" || channel == "VolumeCount") return Rule::sum;
  if (channel == "Z" || channel.starts_with("P.")) return Rule::surface_mean;
  if (channel == "Zvol") return Rule::volume_mean;
  if (channel.starts_with("Variance.")) return Rule::variance;
  if (channel.starts_with("Dof.")) return Rule::dof;
  return Rule::mean;
}

MergeSum::MergeSum(PixelBounds box, const Image& header) : box_(box) {
  for (const Channel& c : header.channels) {
    if (is_shared_channel(c.name) && !is_matte_channel(c.name)) add_plane(c.name);
  }
  for (const std::string_view layer : kMatteLayers) {
    if (has_mattes(header, layer)) mattes_.emplace_back(layer, box.size());
  }
  for (const char* name : {"SampleCount", "SampleWeight"}) add_plane(name);
  if (header.find("Replicate.SampleCount")) add_plane("Replicate.SampleWeight");
  for (const std::string suffix : {"R", "G", "B"}) {
    if (header.find("Variance." + suffix)) add_plane("Dof." + suffix);
  }
}

void MergeSum::add_plane(const std::string& name) {
  const auto pixels = static_cast<std::size_t>(box_.width()) * static_cast<std::size_t>(box_.height());
  planes_.push_back({name, rule_of(name), std::vector<double>(pixels)});
}

const MergeSum::Plane* MergeSum::find(const std::string& name) const {
  const auto found = std::find_if(planes_.begin(), planes_.end(), [&](const Plane& p) { return p.name == name; });
  return found == planes_.end() ? nullptr : &*found;
}

void MergeSum::add(const Image& slice, int samples) {
  const auto values_or = [&](const char* name, const float* otherwise) {
    const Channel* channel = slice.find(name);
    return channel ? channel->values.data() : otherwise;
  };
  const auto pixels = static_cast<std::size_t>(slice.width()) * static_cast<std::size_t>(slice.height());
  std::vector<float> everywhere;
  if (!slice.find("SampleCount")) everywhere.assign(pixels, static_cast<float>(samples));
  const float* const counts = values_or("SampleCount", everywhere.data());
  const Weights weights{counts, values_or("SampleWeight", counts),
                        values_or("Replicate.SampleWeight", values_or("Replicate.SampleCount", nullptr))};
  weighted_ = weighted_ || slice.find("SampleWeight");
  for (Plane& plane : planes_) add_channel(plane, slice, weights);
  for (MatteSum& sum : mattes_) {
    const MatteReader mattes(slice, sum.layer());
    for (std::size_t i = 0; i < pixels; ++i) sum.add(place_in_box(slice, i), mattes.at(i), static_cast<double>(weights.all[i]));
  }
}

std::size_t MergeSum::place_in_box(const Image& slice, std::size_t i) const {
  const auto width = static_cast<std::size_t>(slice.width());
  return box_.index(slice.data.x0 + static_cast<int>(i % width), slice.data.y0 + static_cast<int>(i / width));
}

void MergeSum::add_channel(Plane& plane, const Image& slice, const Weights& weights) const {
  const auto values_of = [&](const std::string& name) {
    const Channel* channel = slice.find(name);
    return channel ? channel->values.data() : nullptr;
  };
  const std::string prefix = prefix_of(plane.name);
  const float* values = values_of(plane.name);
  const float* surface = values_of(prefix + "SurfaceCount");
  const float* volume = values_of(prefix + "VolumeCount");
  const float* weight = prefix.empty() ? weights.all : weights.even;
  const float* count = prefix.empty() ? weights.counts : values;
  const auto term = [&](std::size_t i) -> double {
    const double n = weight[i];
    switch (plane.rule) {
      case Rule::mean:
        return n * values[i];
      case Rule::surface_mean:
        return static_cast<double>(surface[i]) * values[i];
      case Rule::volume_mean:
        return static_cast<double>(volume[i]) * values[i];
      case Rule::sum:
        return values[i];
      case Rule::variance:
        return n * n * values[i];
      case Rule::samples:
        return count[i];
      case Rule::weight:
        return n;
      case Rule::dof:
        return n * n / (values ? values[i] : 1.0);
    }
    return 0;
  };
  const auto pixels = static_cast<std::size_t>(slice.width()) * static_cast<std::size_t>(slice.height());
  for (std::size_t i = 0; i < pixels; ++i) {
    if (weights.counts[i] > 0) plane.sums[place_in_box(slice, i)] += term(i);  // else left black by an earlier merge
  }
}

/// What a plane's sum is divided by; null: by nothing.
const std::vector<double>* MergeSum::weights_of(const Plane& plane) const {
  const std::string prefix = prefix_of(plane.name);
  switch (plane.rule) {
    case Rule::surface_mean:
      return &find(prefix + "SurfaceCount")->sums;
    case Rule::volume_mean:
      return &find(prefix + "VolumeCount")->sums;
    case Rule::sum:
    case Rule::samples:
    case Rule::weight:
      return nullptr;
    default:
      return &find(prefix + "SampleWeight")->sums;
  }
}

Image MergeSum::result() const {
  Image image;
  image.data = image.display = box_;
  for (const Plane& plane : planes_) {
    if (plane.rule == Rule::weight && !weighted_) continue;
    std::vector<float>& values = image.add_channel(plane.name).values;
    const std::vector<double>* weights = weights_of(plane);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double sum = plane.sums[i], n = weights ? (*weights)[i] : 1;
      if (!(n > 0)) continue;  // black
      const double value = plane.rule == Rule::dof ? n * n / sum : plane.rule == Rule::variance ? sum / (n * n) : sum / n;
      values[i] = static_cast<float>(value);
    }
  }
  for (const MatteSum& sum : mattes_) sum.store(image, find("SampleWeight")->sums);
  return image;
}

}  // namespace tyndall
