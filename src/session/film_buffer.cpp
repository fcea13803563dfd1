#include "session/film_buffer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/cie.h"
#include "tyndall/lights.h"

namespace tyndall {
namespace {

// A pixel's sums: even samples' RGB, odd samples' RGB, alpha, then each AOV's over all samples and, with Aov::replicate, over
// the even ones, then each light group's RGB as those of all light.
constexpr std::size_t kAlpha = 6, kFirstAov = 7, kSumsOfGroup = 6;
constexpr std::size_t kSumsOfMatte = 1;  ///< its coverage
/// Relative to the light of a sample. More that groups differ from it by is no rounding, and must show.
constexpr double kMostRounding = 1e-3;

/// Counts are sums of shares, which may be below 1.
float mean_of(double sum, double count) { return count > 0 ? static_cast<float>(sum / count) : 0.0f; }

std::size_t sums_of(Aov aov) {
  switch (aov) {
    case Aov::variance:
    case Aov::sample_count:
    case Aov::replicate:
      return 0;  // follow from what is there anyway
    case Aov::crypto_object:
    case Aov::crypto_material:
    case Aov::crypto_medium:
      return 0;  // KeyedSums
    case Aov::z:
    case Aov::z_volume:
      return 2;  // sum and count
    case Aov::p:
      return 4;
    default:
      return 3;
  }
}

bool is_light(Aov aov) { return aov >= Aov::surface_direct && aov <= Aov::emission; }

/// That are means.
std::size_t channels_of(Aov aov) {
  switch (aov) {
    case Aov::variance:
    case Aov::replicate:
    case Aov::crypto_object:
    case Aov::crypto_material:
    case Aov::crypto_medium:
      return 0;
    case Aov::sample_count:  // with SampleWeight
    case Aov::z:             // with their count
    case Aov::z_volume:
      return 2;
    case Aov::p:
      return 4;
    default:
      return 3;
  }
}

bool holds(const std::vector<Aov>& aovs, Aov aov) { return std::find(aovs.begin(), aovs.end(), aov) != aovs.end(); }

}  // namespace

std::size_t FilmBuffer::sums_of_pixel(const Extras& extras) {
  std::size_t sums = 0;
  for (const Aov aov : extras.aovs) sums += sums_of(aov);
  return kFirstAov + (holds(extras.aovs, Aov::replicate) ? 2 : 1) * sums + kSumsOfGroup * extras.groups.size();
}

std::size_t FilmBuffer::channels_of_image(const Extras& extras) {
  const std::size_t groups = extras.groups.size(), variances = holds(extras.aovs, Aov::variance) ? 3 * (1 + groups) : 0;
  std::size_t means = 4 + 3 * groups;
  for (const Aov aov : extras.aovs) means += channels_of(aov);
  return holds(extras.aovs, Aov::replicate) ? 2 * means + 1 + variances : means + variances;  // with Replicate.SampleCount
}

FilmBuffer::FilmBuffer(const Film& film, PixelBounds crop, Extras extras)
    : film_(film),
      crop_(crop),
      aovs_(std::move(extras.aovs)),
      groups_(std::move(extras.groups)),
      replicate_(wants(Aov::replicate)),
      stride_(kFirstAov),
      deep_(std::move(extras.deep)) {
  for (const Aov aov : aovs_) {
    offsets_.push_back(stride_);
    stride_ += (replicate_ ? 2 : 1) * sums_of(aov);
  }
  first_group_ = stride_;
  stride_ += kSumsOfGroup * groups_.size();
  sums_ = FilmSums(crop.size() * stride_);
  std::copy_if(aovs_.begin(), aovs_.end(), std::back_inserter(mattes_), is_matte);
  keyed_.assign(mattes_.size(), KeyedSums(crop.size(), kSumsOfMatte));
  if (deep_) keyed_.emplace_back(crop.size(), kSumsOfDepth);
}

bool FilmBuffer::wants(Aov aov) const { return holds(aovs_, aov); }

FilmTile FilmBuffer::copy(const PixelBounds& tile) const {
  const std::size_t row = static_cast<std::size_t>(tile.width()) * stride_;
  FilmTile of{FilmSums(tile.size() * stride_), {}};
  for (int y = tile.y0; y < tile.y1; ++y) of.sums.copy(sums_, first_of(tile.x0, y), row, tile.index(tile.x0, y) * stride_);
  for (const KeyedSums& sums : keyed_) of.keyed.push_back(sums.copy(crop_, tile));
  return of;
}

void FilmBuffer::restore(const PixelBounds& tile, const FilmTile& of) {
  const std::size_t row = static_cast<std::size_t>(tile.width()) * stride_;
  for (int y = tile.y0; y < tile.y1; ++y) sums_.copy(of.sums, tile.index(tile.x0, y) * stride_, row, first_of(tile.x0, y));
  for (std::size_t i = 0; i < keyed_.size(); ++i) keyed_[i].restore(crop_, tile, of.keyed[i]);
}

void FilmBuffer::clear(const PixelBounds& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) sums_.clear(first_of(tile.x0, y), static_cast<std::size_t>(tile.width()) * stride_);
  for (KeyedSums& sums : keyed_) sums.clear(crop_, tile);
}

void FilmBuffer::add(const SamplePlace& at, const PathRecord& record, float weight) {
  const std::size_t first = first_of(at.x, at.y);
  weight *= at.share;
  add3(first + ((at.sample & 1) ? kOdd : kEven), record.radiance(), weight);
  sums_.add(first + kAlpha, record.alpha * weight);
  const bool twice = replicate_ && !(at.sample & 1);
  for (std::size_t i = 0; i < aovs_.size(); ++i) {
    add_aov(aovs_[i], first + offsets_[i], record, weight, at.share);
    if (twice) add_aov(aovs_[i], first + offsets_[i] + sums_of(aovs_[i]), record, weight, at.share);
  }
}

void FilmBuffer::add_groups(const SamplePlace& at, Rgb radiance, std::span<const Rgb> by_group, float weight) {
  const std::size_t first = first_of(at.x, at.y) + first_group_ + ((at.sample & 1) ? kOdd : kEven);
  weight *= at.share;
  for (int k = 0; k < 3; ++k) {
    double rest = radiance[k] * weight, light = 0;
    std::size_t brightest = 0;
    for (std::size_t g = 0; g < by_group.size(); ++g) {
      const float term = by_group[g][k] * weight;
      sums_.add(first + kSumsOfGroup * g + static_cast<std::size_t>(k), term);
      rest -= term;
      light += std::abs(term);
      if (std::abs(by_group[g][k]) > std::abs(by_group[brightest][k])) brightest = g;
    }
    if (std::abs(rest) <= kMostRounding * light)
      sums_.add(first + kSumsOfGroup * brightest + static_cast<std::size_t>(k), rest, 0.0f);
  }
}

void FilmBuffer::add3(std::size_t first, float x, float y, float z, float weight) {
  sums_.add(first, x * weight);
  sums_.add(first + 1, y * weight);
  sums_.add(first + 2, z * weight);
}

void FilmBuffer::add_aov(Aov aov, std::size_t first, const PathRecord& r, float weight, float share) {
  switch (aov) {
    case Aov::albedo:
      return add3(first, r.albedo, weight);
    case Aov::n:
      return add3(first, r.n.x, r.n.y, r.n.z, weight);
    case Aov::transmittance:
      return add3(first, r.transmittance, weight);
    case Aov::surface_direct:
      return add3(first, r.surface_direct, weight);
    case Aov::surface_indirect:
      return add3(first, r.surface_indirect, weight);
    case Aov::volume_direct:
      return add3(first, r.volume_direct, weight);
    case Aov::volume_indirect:
      return add3(first, r.volume_indirect, weight);
    case Aov::emission:
      return add3(first, r.emission, weight);
    // Positions are means over the samples that have one, whatever the filter: its negative lobe makes no sense here.
    case Aov::p:
      if (r.hit_surface) add3(first, r.p.x, r.p.y, r.p.z, share), sums_.add(first + 3, share);
      return;
    case Aov::z:
      if (r.hit_surface) sums_.add(first, r.z * share), sums_.add(first + 1, share);
      return;
    case Aov::z_volume:
      if (r.hit_volume) sums_.add(first, r.z_volume * share), sums_.add(first + 1, share);
      return;
    case Aov::variance:
    case Aov::sample_count:
    case Aov::replicate:
    case Aov::crypto_object:
    case Aov::crypto_material:
    case Aov::crypto_medium:
      return;
  }
}

Rgb FilmBuffer::to_film_space(Rgb c) const { return transformed(film_.from_rec709, c); }

void FilmBuffer::store_color(Image& image, const std::string& name, std::size_t offset, const Means& means,
                             Halves halves) const {
  const std::size_t first = image.channels.size();
  for (const char* suffix : {"R", "G", "B"}) image.add_channel(means.prefix + name + suffix);
  const std::size_t pixels = image.channels[first].values.size();
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto mean = [&](std::size_t k) {
      const double odd = halves == Halves::apart && !means.even_only ? sum(i, offset + kOdd + k) : 0;
      return static_cast<float>((sum(i, offset + k) + odd) / means.count());
    };
    const Rgb c = to_film_space({mean(0), mean(1), mean(2)});
    for (int k = 0; k < 3; ++k) image.channels[first + k].values[i] = c[k];
  }
}

/// Albedo and transmittance: in the film's space, but white stays 1 whatever the space's white is.
void FilmBuffer::store_ratio(Image& image, const std::string& name, std::size_t offset, const Means& means) const {
  const std::size_t first = image.channels.size();
  store_color(image, name, offset, means, Halves::joined);
  const Rgb white = to_film_space(Rgb(1.0f));
  for (int k = 0; k < 3; ++k) {
    for (float& v : image.channels[first + k].values) v /= white[k];
  }
}

void FilmBuffer::store_aov(Image& image, Aov aov, std::size_t offset, const Means& means) const {
  const std::string name = name_of_aov(aov), prefixed = means.prefix + name;
  if (aov == Aov::replicate || is_matte(aov) || (aov == Aov::variance && means.even_only)) return;
  if (aov == Aov::variance) return store_variance(image, "", kEven, means.samples);
  if (aov == Aov::albedo || aov == Aov::transmittance) return store_ratio(image, name + ".", offset, means);
  if (is_light(aov)) return store_color(image, name + ".", offset, means, Halves::joined);
  const std::size_t first = image.channels.size();
  const bool vector = aov == Aov::n || aov == Aov::p;
  if (vector) {
    for (const char* suffix : {".X", ".Y", ".Z"}) image.add_channel(prefixed + suffix);
  } else if (aov != Aov::sample_count || !means.even_only) {
    image.add_channel(prefixed);
  } else {
    return;
  }
  const std::size_t pixels = image.channels[first].values.size();
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto s = [&](std::size_t k) { return sum(i, offset + k); };
    if (aov == Aov::sample_count) {
      image.channels[first].values[i] = static_cast<float>(means.paths_of(i));
    } else if (vector) {
      const double count = aov == Aov::n ? means.count() : s(3);
      for (std::size_t k = 0; k < 3; ++k) image.channels[first + k].values[i] = mean_of(s(k), count);
    } else {
      image.channels[first].values[i] = mean_of(s(0), s(1));
    }
  }
}

void FilmBuffer::store_count(Image& image, const std::string& name, std::size_t offset) const {
  std::vector<float>& values = image.add_channel(name).values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(sum(i, offset));
}

void FilmBuffer::store_counts(Image& image, const Means& means) const {
  bool surface_done = false;  // P and Z have the same
  for (std::size_t i = 0; i < aovs_.size(); ++i) {
    const std::size_t sums = sums_of(aovs_[i]);
    const std::size_t count = offsets_[i] + (means.even_only ? 2 : 1) * sums - 1;  // follows the sums
    const bool surface = aovs_[i] == Aov::p || aovs_[i] == Aov::z;
    if (surface && !surface_done) store_count(image, means.prefix + "SurfaceCount", count);
    if (aovs_[i] == Aov::z_volume) store_count(image, means.prefix + "VolumeCount", count);
    surface_done = surface_done || surface;
  }
}

void FilmBuffer::store_means(Image& image, const Means& means) const {
  for (std::size_t i = 0; i < aovs_.size(); ++i)
    store_aov(image, aovs_[i], offsets_[i] + (means.even_only ? sums_of(aovs_[i]) : 0), means);
  store_counts(image, means);
  store_groups(image, means);
}

void FilmBuffer::store_groups(Image& image, const Means& means) const {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const std::string name = light_group_channel(groups_[g]);
    const std::size_t offset = first_group_ + kSumsOfGroup * g;
    store_color(image, name, offset, means, Halves::apart);
    if (wants(Aov::variance) && !means.even_only) store_variance(image, name, offset, means.samples);
  }
}

/// Without SampleCount of all samples, which is an AOV.
void FilmBuffer::store_paths(Image& image, const Means& means) const {
  if (means.even_only) {
    std::vector<float>& count = image.add_channel(means.prefix + "SampleCount").values;
    for (std::size_t i = 0; i < count.size(); ++i) count[i] = static_cast<float>(means.paths_of(i));
  }
  if (means.paths.empty()) return;
  for (float& weight : image.add_channel(means.prefix + "SampleWeight").values) weight = static_cast<float>(means.count());
}

Image FilmBuffer::image(int samples, std::span<const int> paths) const {
  Image image;
  image.data = crop_;
  image.display = {0, 0, film_.width, film_.height};
  image.chromaticities = film_.chromaticities;
  const Means all{"", samples, paths};
  store_color(image, "", kEven, all, Halves::apart);
  Channel& alpha = image.add_channel("A");
  for (std::size_t i = 0; i < alpha.values.size(); ++i) {
    alpha.values[i] = static_cast<float>(sum(i, kAlpha) / samples);
  }
  store_means(image, all);
  store_paths(image, all);
  store_mattes(image, samples);
  if (!replicate_) return image;
  const Means even{"Replicate.", samples, paths, true};
  store_color(image, "", kEven, even, Halves::apart);
  store_means(image, even);
  store_paths(image, even);
  return image;
}

}  // namespace tyndall
