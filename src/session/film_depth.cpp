/// From sums by depth to the samples of a deep image.
#include <algorithm>

#include "session/film_buffer.h"

namespace tyndall {
namespace {

/// What comes through at least, for a place in depth to stand alone: what is behind is added to it. Also keeps 1 - alpha, of a
/// float's alpha, from being all rounding.
constexpr double kLeastPassing = 1e-4;

/// Of one place: means over the pixel's samples.
struct Place {
  std::array<double, 3> light{};
  double opacity = 0;  ///< of all behind the camera, what it hides
  float z = 0, z_back = 0;
};

/// The places of one pixel, from its sums.
class Places {
 public:
  Places(const KeyedSums& sums, std::size_t pixel, const DeepLayout& layout, int samples)
      : sums_(sums), pixel_(pixel), layout_(layout), samples_(samples) {}

  std::size_t size() const { return sums_.size(pixel_); }
  Place at(std::size_t i) const {
    Place place;
    for (std::size_t k = 0; k < 3; ++k) place.light[k] = sums_.value(pixel_, i, k) / samples_;
    place.opacity = sums_.value(pixel_, i, 3) / samples_;
    if (DepthBins::is_media_key(key(i))) {
      const int bin = DepthBins::bin_of_key(key(i));
      place.z = in_scene_units(layout_.bins.edge(bin));
      place.z_back = std::max(end_of_media(i, bin), place.z);
    } else {
      place.z = place.z_back = depth_of_surface(i);
    }
    return place;
  }

 private:
  std::uint32_t key(std::size_t i) const { return sums_.key(pixel_, i); }
  float in_scene_units(float z) const { return std::min(z * layout_.unit, kDeepBackground); }
  float depth_of_surface(std::size_t i) const {
    const double count = sums_.value(pixel_, i, 5);
    return count > 0 ? in_scene_units(static_cast<float>(sums_.value(pixel_, i, 4) / count)) : kDeepBackground;
  }
  /// Media of a bin end before its first surface, so that nothing overlaps.
  float end_of_media(std::size_t i, int bin) const {
    const float edge = in_scene_units(layout_.bins.edge(bin + 1));
    const bool surface = i + 1 < size() && DepthBins::bin_of_key(key(i + 1)) == bin;
    return surface ? std::min(depth_of_surface(i + 1), edge) : edge;
  }

  const KeyedSums& sums_;
  std::size_t pixel_;
  const DeepLayout& layout_;
  int samples_;
};

/// Premultiplied by its own opacity alone, not by what is in front of it.
DeepPixelSample unveiled(const Place& place, double passing) {
  DeepPixelSample sample{place.z, place.z_back, {}};
  for (std::size_t k = 0; k < 3; ++k) sample.rgba[k] = static_cast<float>(place.light[k] / passing);
  sample.rgba[3] = static_cast<float>(std::clamp(place.opacity / passing, 0.0, 1.0));
  return sample;
}

/// Of all up to each place, never less than before: where noise makes that of one negative, those before it have less, so that
/// the last is that of all.
std::vector<double> opacities_up_to(const Places& places) {
  std::vector<double> sums;
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) sums.push_back(sum += places.at(i).opacity);
  for (std::size_t i = sums.size(); i-- > 1;) sums[i - 1] = std::min(sums[i - 1], sums[i]);
  return sums;
}

/// c = L / T_front and a = 1 - T, so that `over` gives the sum of all L and of all opacities.
std::vector<DeepPixelSample> samples_of(const Places& places) {
  std::vector<DeepPixelSample> samples;
  Place last;
  const std::vector<double> opacity = opacities_up_to(places);
  double before = 1, passing = 1;  // what gets to the last sample, and through it: as a reader reckons it
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place place = places.at(i);
    if (!samples.empty() && passing < kLeastPassing) {
      for (std::size_t k = 0; k < 3; ++k) last.light[k] += place.light[k];
      samples.pop_back();
    } else {
      last = place;
      before = passing;
    }
    last.opacity = before - (1 - opacity[i]);
    samples.push_back(unveiled(last, before));
    passing = before * (1 - static_cast<double>(samples.back().rgba[3]));
  }
  return samples;
}

}  // namespace

std::optional<DeepImage> FilmBuffer::deep_image(int samples) const {
  if (!deep_) return std::nullopt;
  DeepImage image;
  image.data = crop_;
  image.display = {0, 0, film_.width, film_.height};
  image.chromaticities = film_.chromaticities;
  for (std::size_t pixel = 0; pixel < crop_.size(); ++pixel) {
    std::vector<DeepPixelSample> found = samples_of(Places(keyed_.back(), pixel, *deep_, samples));
    for (DeepPixelSample& sample : found) {
      const Rgb c = to_film_space({sample.rgba[0], sample.rgba[1], sample.rgba[2]});
      std::copy_n(&c.r, 3, sample.rgba.begin());
    }
    image.counts.push_back(static_cast<std::uint32_t>(found.size()));
    image.samples.insert(image.samples.end(), found.begin(), found.end());
  }
  return image;
}

}  // namespace tyndall
