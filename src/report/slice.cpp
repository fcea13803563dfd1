#include "report/slice.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <tuple>

#include "tyndall/error.h"
#include "tyndall/image_attributes.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) { throw Error(Failure::scene, path + ": " + what); }

template <typename T>
const T& attribute(const std::string& path, const Image& header, const std::string& name) {
  if (const T* value = header.attribute<T>(name)) return *value;
  if (!header.attributes.contains(name))
    fail(path, "has no attribute " + name + "; only images that tyndall render or merge wrote as .exr can be merged");
  fail(path, "attribute " + name + " is not what Tyndall writes; render the slice again");
}

std::optional<SliceSource> parse_source(std::istream& text) {
  SliceSource s;
  std::string seed, samples, crop;
  char comma[3];
  text >> seed >> s.seed >> samples >> s.samples >> crop;
  if (crop == "from") text >> s.first >> crop;
  text >> s.crop.x0 >> comma[0] >> s.crop.x1 >> comma[1] >> s.crop.y0 >> comma[2] >> s.crop.y1;
  const bool words = seed == "seed" && samples == "samples" && crop == "crop";
  const bool commas = text && std::all_of(comma, comma + 3, [](char c) { return c == ','; });
  if (!words || !commas || s.samples < 1 || s.first < 0 || s.crop.x0 >= s.crop.x1 || s.crop.y0 >= s.crop.y1)
    return std::nullopt;
  return s;
}

std::vector<SliceSource> parse_sources(const std::string& path, const std::string& text, const PixelBounds& data) {
  std::vector<SliceSource> sources;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ';');) {
    std::istringstream fields(part);
    const auto source = parse_source(fields);
    const bool whole = source && (fields >> std::ws).eof();
    if (!whole || intersection(source->crop, data) != source->crop)
      fail(path, "attribute tyndall/slices is damaged; merge its slices again");
    sources.push_back(*source);
  }
  if (sources.empty()) fail(path, "attribute tyndall/slices is empty; merge its slices again");
  return sources;
}

/// Of any pixel: "512", also where the header says "32..512".
std::string most_samples(const std::string& path, const Image& header) {
  if (const auto* range = header.attribute<std::string>(attributes::kSamples)) {
    const std::size_t dots = range->find("..");
    if (dots != std::string::npos && header.find("SampleCount")) return range->substr(dots + 2);
  }
  return std::to_string(attribute<int>(path, header, attributes::kSamples));
}

std::vector<SliceSource> sources_of(const std::string& path, const Image& header, const std::optional<SliceInfo>& part) {
  if (header.attributes.contains(attributes::kSlices)) {
    return parse_sources(path, attribute<std::string>(path, header, attributes::kSlices), header.data);
  }
  // A plain render, told in the words of a merged one.
  const std::string& seed = attribute<std::string>(path, header, attributes::kSeed);
  std::istringstream text("seed " + seed + " samples " + most_samples(path, header) + " crop " + crop_text(header.data));
  auto source = parse_source(text);
  if (source && part) source->first = part->range.first;
  if (!source) fail(path, "attributes tyndall/seed and tyndall/samples are damaged; render the slice again");
  return {*source};
}

}  // namespace

Slice read_slice(const std::string& path) {
  Slice slice{path, read_exr_header(path), {}, {}, {}};
  slice.scene_hash = attribute<std::string>(path, slice.header, attributes::kSceneHash);
  slice.part = slice_info(slice.header, path);
  slice.sources = sources_of(path, slice.header, slice.part);
  return slice;
}

std::string sources_text(std::vector<SliceSource> sources) {
  std::sort(sources.begin(), sources.end(), [](const SliceSource& a, const SliceSource& b) {
    const auto key = [](const SliceSource& s) {
      return std::tie(s.seed, s.crop.y0, s.crop.x0, s.crop.y1, s.crop.x1, s.first, s.samples);
    };
    return key(a) < key(b);
  });
  std::string text;
  for (const SliceSource& s : sources) {
    text += (text.empty() ? "seed " : "; seed ") + std::to_string(s.seed) + " samples " + std::to_string(s.samples) +
            (s.first > 0 ? " from " + std::to_string(s.first) : "") + " crop " + crop_text(s.crop);
  }
  return text;
}

PixelBounds intersection(const PixelBounds& a, const PixelBounds& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

}  // namespace tyndall
