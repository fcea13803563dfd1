/// What a film knows only of some things in each pixel, who covers it and where in depth its light is from; and all exact sums
/// as channels of an image.
#include <array>
#include <limits>

#include "session/film_buffer.h"

namespace tyndall {
namespace {

/// Ids that a slice keeps a pixel: what is cut of one would be missing in the sum of all.
constexpr std::size_t kMatteRanksOfSlice = 12;

std::string sum_channel(std::size_t number, std::size_t part) {
  constexpr std::array kParts{".high", ".mid", ".low"};
  return "Sum." + std::to_string(number) + kParts[part];
}

}  // namespace

void FilmBuffer::add_matte(const SamplePlace& at, Aov layer, MatteCoverage cover, float weight) {
  const auto i = std::find(mattes_.begin(), mattes_.end(), layer) - mattes_.begin();
  const float term = cover.coverage * weight * at.share;
  if (term != 0) keyed_[static_cast<std::size_t>(i)].add(crop_.index(at.x, at.y), cover.id, {&term, 1});
}

void FilmBuffer::store_mattes(Image& image, int samples) const {
  for (std::size_t layer = 0; layer < mattes_.size(); ++layer) {
    MatteWriter writer(image, name_of_aov(mattes_[layer]));
    const KeyedSums& sums = keyed_[layer];
    std::vector<MatteCoverage> covers;
    for (std::size_t pixel = 0; pixel < sums.pixels(); ++pixel) {
      covers.clear();
      for (std::size_t i = 0; i < sums.size(pixel); ++i)
        covers.push_back({sums.key(pixel, i), static_cast<float>(sums.value(pixel, i, 0) / samples)});
      writer.set(pixel, covers);
    }
  }
}

void FilmBuffer::add_deep(const SamplePlace& at, std::span<const DeepSample::Part> parts, float weight) {
  weight *= at.share;
  for (const DeepSample::Part& part : parts) {
    const std::array<float, kSumsOfDepth> terms{part.light.r * weight, part.light.g * weight, part.light.b * weight,
                                                part.opacity * weight, part.z * at.share,     part.count * at.share};
    keyed_.back().add(crop_.index(at.x, at.y), part.key, terms);
  }
}

std::string FilmBuffer::keyed_name(std::size_t layer) const {
  return layer < mattes_.size() ? name_of_aov(mattes_[layer]) : "Deep";
}

void FilmBuffer::store_keyed(Image& image) const {
  for (std::size_t layer = 0; layer < keyed_.size(); ++layer) {
    const std::size_t most = layer < mattes_.size() ? kMatteRanksOfSlice : std::numeric_limits<std::size_t>::max();
    store_keyed_sums(keyed_[layer], keyed_name(layer), most, image);
  }
}

void FilmBuffer::add_keyed(const Image& image) {
  for (std::size_t layer = 0; layer < keyed_.size(); ++layer) add_keyed_sums(image, keyed_name(layer), keyed_[layer]);
}

void FilmBuffer::store_sums(Image& image) const {
  for (std::size_t k = 0; k < stride_; ++k) {
    std::array<float*, 3> parts;
    for (std::size_t p = 0; p < 3; ++p) parts[p] = image.add_channel(sum_channel(k, p)).values.data();
    for (std::size_t i = 0; i < crop_.size(); ++i) {
      const std::array<float, 3> floats = split(sums_.at(i * stride_ + k));
      for (std::size_t p = 0; p < 3; ++p) parts[p][i] = floats[p];
    }
  }
  store_keyed(image);
}

bool FilmBuffer::has_sums(const Image& image) const {
  for (std::size_t k = 0; k < stride_; ++k) {
    for (std::size_t p = 0; p < 3; ++p) {
      if (!image.find(sum_channel(k, p))) return false;
    }
  }
  return !image.find(sum_channel(stride_, 0));
}

void FilmBuffer::add_sums(const Image& image) {
  for (std::size_t k = 0; k < stride_; ++k) {
    std::array<const float*, 3> parts;
    for (std::size_t p = 0; p < 3; ++p) parts[p] = image.find(sum_channel(k, p))->values.data();
    for (std::size_t i = 0; i < crop_.size(); ++i) {
      for (const float* part : parts) sums_.add(i * stride_ + k, part[i]);
    }
  }
  add_keyed(image);
}

}  // namespace tyndall
