#include "session/slice_header.h"

#include <algorithm>
#include <charconv>

#include "math/stream_hash.h"
#include "session/checkpoint.h"
#include "session/image_header.h"
#include "session/matte_layers.h"
#include "session/rendered_pixels.h"
#include "session/resolved_settings.h"
#include "session/slice.h"
#include "tyndall/error.h"
#include "tyndall/image_attributes.h"

namespace tyndall {
namespace {

constexpr const char* kTimed = " timed";
constexpr const char* kStopped = " stopped";

/// Takes `word` off the front of `text`.
bool take(std::string& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.erase(0, word.size());
  return true;
}

/// Takes a number off the front of `text`.
bool take(std::string& text, int& number) {
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (problem != std::errc()) return false;
  text.erase(0, static_cast<std::size_t>(end - text.data()));
  return true;
}

/// Takes what slice_text writes off the front of `text`; nothing where it is something else.
std::optional<SliceInfo> take_choice(std::string& text) {
  SliceInfo info;
  auto& [index, count] = info.choice;
  if (!(take(text, index) && take(text, "/") && take(text, count) && take(text, " of ") && take(text, info.total)))
    return std::nullopt;
  if (index < 1 || index > count || count > kMostSlices || info.total < 1) return std::nullopt;
  info.timed = take(text, kTimed);
  return info;
}

/// Likewise " samples 128..192".
std::optional<SampleRange> take_samples(std::string& text) {
  int first = 0, end = 0;
  if (!(take(text, " samples ") && take(text, first) && take(text, "..") && take(text, end))) return std::nullopt;
  if (first < 0 || first >= end) return std::nullopt;
  return SampleRange{first, end - first};
}

/// Files list channels by name.
void sort_channels(Image& image) {
  std::sort(image.channels.begin(), image.channels.end(), [](const Channel& a, const Channel& b) { return a.name < b.name; });
}

}  // namespace

bool is_sum(const std::string& channel) { return channel.starts_with("Sum."); }

std::string hash_of_sums(const Image& image) {
  StreamHash hash;
  for (const Channel& c : image.channels) {
    if (is_sum(c.name)) hash.add(c.values.data(), c.values.size() * sizeof(float));
  }
  return hex_text(hash.value());
}

void refuse_slice(const std::string& path, const std::string& what) {
  throw Error(Failure::scene, path + ": " + what + "; render the slice again");
}

const std::string& text_attribute(const Image& header, const std::string& path, const char* name) {
  if (const auto* text = header.attribute<std::string>(name)) return *text;
  refuse_slice(path, "has no attribute " + std::string(name));
}

std::string slice_text(const RenderSettings& settings) {
  if (!settings.slice) return "whole";
  return std::to_string(settings.slice->index) + "/" + std::to_string(settings.slice->count) + " of " +
         std::to_string(settings.spp) + (settings.time ? kTimed : "");
}

void add_slice(Image& image, const FilmBuffer& film, const RenderSettings& settings, int samples) {
  film.store_sums(image);
  sort_channels(image);
  const int first = sample_range(settings).first;
  image.attributes[attributes::kSlice] =
      slice_text(settings) + " samples " + std::to_string(first) + ".." + std::to_string(first + samples);
  image.attributes[attributes::kAovs] = aov_list(settings.aovs);
  std::array<float, 16> rows{};
  std::copy(film.film().from_rec709.begin(), film.film().from_rec709.end(), rows.begin());
  image.attributes[attributes::kFilmSpace] = rows;
  if (film.deep_layout()) image.attributes[attributes::kDeepLayout] = film.deep_layout()->str();
  image.attributes[attributes::kSumHash] = hash_of_sums(image);
}

void mark_stopped(Image& image) {
  const auto slice = image.attributes.find(attributes::kSlice);
  if (slice != image.attributes.end()) slice->second = std::get<std::string>(slice->second) + kStopped;
  if (slice == image.attributes.end()) image.attributes[attributes::kStopped] = 1;
}

std::optional<SliceCheckpoint> slice_checkpoint(std::string_view bytes, const std::string& path) {
  const CheckpointSummary checkpoint = peek_checkpoint(bytes, path);
  const auto& identity = checkpoint.identity;
  const auto slice = std::find_if(identity.begin(), identity.end(), [](const auto& part) { return part.first == "slice"; });
  if (slice == identity.end() || slice->second == "whole") return std::nullopt;
  std::string text = slice->second;
  auto info = take_choice(text);
  if (!info || !text.empty()) refuse_slice(path, "does not tell which slice it is of");
  info->range = {info->share().first, checkpoint.state.samples};
  return SliceCheckpoint{*info, checkpoint.state.seconds};
}

std::optional<SliceInfo> slice_info(const Image& header, const std::string& path) {
  if (!header.attributes.contains(attributes::kSlice)) return std::nullopt;
  std::string text = text_attribute(header, path, attributes::kSlice);
  auto info = take_choice(text);
  const auto samples = take_samples(text);
  const bool stopped = take(text, kStopped);
  if (!info || !samples || !text.empty() || samples->count > info->total - samples->first)
    refuse_slice(path, "attribute " + std::string(attributes::kSlice) + " is damaged");
  info->stopped = stopped;
  info->range = *samples;
  return info;
}

namespace {

/// Whether mattes have these names, and depth these bins.
bool says_layers(const Image& image, const World::Parts& world, const RenderSettings& settings) {
  Image described;
  MatteLayers(world.built, film_aovs(settings)).describe(described);
  if (const auto deep = deep_layout(world, settings)) described.attributes[attributes::kDeepLayout] = deep->str();
  const bool names = std::all_of(described.attributes.begin(), described.attributes.end(), [&](const auto& attribute) {
    const auto found = image.attributes.find(attribute.first);
    return found != image.attributes.end() && found->second == attribute.second;
  });
  return names && (settings.deep_bins || !image.attributes.contains(attributes::kDeepLayout));
}

}  // namespace

bool holds_slice(const Image& image, const World& world, const RenderSettings& settings) {
  const auto says = [&](const char* name, const std::string& value) {
    const auto* text = image.attribute<std::string>(name);
    return text && *text == value;
  };
  try {
    const auto info = slice_info(image, "the slice");
    return info && info->choice == settings.slice && info->total == settings.spp && info->complete() &&
           image.data == rendered_pixels(world.parts().built.scene, settings) && says_end(image, settings) &&
           says(attributes::kSceneHash, world.scene_hash(settings)) &&
           says(attributes::kOptions, options_text(resolved(settings, world.parts()))) &&
           says(attributes::kSeed, std::to_string(settings.seed)) && says(attributes::kAovs, aov_list(settings.aovs)) &&
           says(attributes::kSumHash, hash_of_sums(image)) && says_layers(image, world.parts(), settings);
  } catch (const Error&) {
    return false;
  }
}

bool is_slice_attribute(std::string_view name) {
  return name == attributes::kSlice || name == attributes::kAovs || name == attributes::kFilmSpace ||
         name == attributes::kDeepLayout || name == attributes::kSumHash || name == attributes::kCommand;
}

}  // namespace tyndall
