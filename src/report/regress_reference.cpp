#include "report/regress_reference.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "tyndall/error.h"
#include "tyndall/image_attributes.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

/// The next float upward with 9 bits of mantissa.
float rounded_up(double value) {
  const auto as_float = static_cast<float>(value);
  if (!(as_float > 0) || !std::isfinite(as_float)) return as_float;
  constexpr std::uint32_t kLow = (1u << 14) - 1;
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(as_float) + kLow) & ~kLow);
}

int count_in(const Image& image, const char* key) {
  const int* count = image.attribute<int>(key);
  return count != nullptr ? *count : 0;
}

}  // namespace

bool is_tested_channel(const std::string& name) { return !name.starts_with("Variance.") && name != "SampleCount"; }

bool is_reference(const std::string& path) {
  try {
    return count_in(read_image(path), attributes::kRuns) > 0;
  } catch (const Error&) {
    return false;
  }
}

void RunMeans::add(const Image& image) {
  std::vector<std::string> names;
  for (const Channel& c : image.channels) {
    if (is_tested_channel(c.name)) names.push_back(c.name);
  }
  if (count_ == 0) {
    frame_ = image;
    frame_.channels.clear();
    names_ = names;
    moments_.assign(names.size(), std::vector<Moments>(static_cast<std::size_t>(image.width()) * image.height()));
  }
  if (image.data != frame_.data || names != names_) {
    throw Error(Failure::usage, "runs of different size or channels cannot be averaged; render them with the same options");
  }
  ++count_;
  for (std::size_t k = 0; k < names_.size(); ++k) {
    const std::vector<float>& values = image.find(names_[k])->values;
    for (std::size_t i = 0; i < values.size(); ++i) moments_[k][i].add(values[i]);
  }
}

Image RunMeans::result(int spp) const {
  Image image = frame_;
  for (const char* own : {attributes::kSeed, attributes::kRenderTime, attributes::kDate}) image.attributes.erase(own);
  image.attributes[attributes::kSamples] = spp * count_;
  image.attributes[attributes::kRuns] = count_;
  image.attributes[attributes::kSamplesPerRun] = spp;
  for (std::size_t k = 0; k < names_.size(); ++k) {
    Channel mean{names_[k], {}}, variance{"Variance." + names_[k], {}};
    for (const Moments& m : moments_[k]) {
      const Estimate e = m.estimate();
      mean.values.push_back(static_cast<float>(e.mean));
      variance.values.push_back(rounded_up(e.variance));
    }
    image.channels.push_back(std::move(mean));
    image.channels.push_back(std::move(variance));
  }
  return image;
}

RunCounts run_counts(const Image& image, const std::string& path) {
  const RunCounts counts{count_in(image, attributes::kRuns), count_in(image, attributes::kSamplesPerRun)};
  if (counts.runs >= 2 && counts.spp >= 1) return counts;
  throw Error(Failure::scene, path + ": is no reference of a suite; make one with --update");
}

}  // namespace tyndall
