#include "report/merge.h"

#include <algorithm>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

#include "report/merge_sum.h"
#include "report/metrics.h"
#include "report/slice.h"
#include "tyndall/error.h"
#include "tyndall/image_attributes.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

PixelBounds box_around(const std::vector<Slice>& slices) {
  PixelBounds box = slices.front().header.data;
  for (const Slice& slice : slices) {
    const PixelBounds& b = slice.header.data;
    box = {std::min(box.x0, b.x0), std::min(box.y0, b.y0), std::max(box.x1, b.x1), std::max(box.y1, b.y1)};
  }
  return box;
}

/// Throws when some pixel of `box` was in no render, with the box around those that were not.
void require_covered(const std::vector<Slice>& slices, const PixelBounds& box) {
  const auto width = static_cast<std::size_t>(box.width());
  std::vector<char> covered(width * static_cast<std::size_t>(box.height()));
  for (const Slice& slice : slices) {
    for (const SliceSource& source : slice.sources) {
      const PixelBounds b = intersection(source.crop, box);
      for (int y = b.y0; y < b.y1; ++y) {
        const auto row = covered.begin() + static_cast<std::ptrdiff_t>(width) * (y - box.y0);
        if (b.x0 < b.x1) std::fill(row + (b.x0 - box.x0), row + (b.x1 - box.x0), char{1});
      }
    }
  }
  PixelBounds hole{box.x1, box.y1, box.x0, box.y0};
  std::size_t count = 0;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    if (covered[i]) continue;
    const int x = box.x0 + static_cast<int>(i % width), y = box.y0 + static_cast<int>(i / width);
    hole = {std::min(hole.x0, x), std::min(hole.y0, y), std::max(hole.x1, x + 1), std::max(hole.y1, y + 1)};
    ++count;
  }
  if (count == 0) return;
  throw Error(Failure::scene, slices.front().path + " and the others leave " + std::to_string(count) + " pixels within " +
                                  crop_text(hole) + " empty; render them with --crop " + crop_text(hole) +
                                  ", or merge with --fill-black");
}

Image read_pixels(const Slice& slice) {
  Image image = read_image(slice.path);
  const auto same_name = [](const Channel& a, const Channel& b) { return a.name == b.name; };
  const bool same = image.data == slice.header.data && image.attributes == slice.header.attributes &&
                    std::equal(image.channels.begin(), image.channels.end(), slice.header.channels.begin(),
                               slice.header.channels.end(), same_name);
  if (!same) throw Error(Failure::scene, slice.path + ": was changed while it was read; merge again when it is complete");
  return image;
}

/// The distinct values of a text attribute that may be a list already, sorted; nothing when a slice has none.
std::string listed(const std::vector<Slice>& slices, const std::string& name, const std::string& separator) {
  std::set<std::string> values;
  for (const Slice& slice : slices) {
    const auto* text = slice.header.attribute<std::string>(name);
    if (!text) return {};
    for (std::size_t at = 0; at <= text->size();) {
      const std::size_t end = std::min(text->find(separator, at), text->size());
      values.insert(text->substr(at, end - at));
      at = end + separator.size();
    }
  }
  std::string list;
  for (const std::string& value : values) list += (list.empty() ? "" : separator) + value;
  return list;
}

void merge_times(const std::vector<Slice>& slices, Image& image) {
  double seconds = 0;
  std::string latest;
  for (const Slice& slice : slices) {
    const auto* time = slice.header.attribute<double>(attributes::kRenderTime);
    const auto* date = slice.header.attribute<std::string>(attributes::kDate);
    if (!time || !date) return;  // --reproducible
    seconds += *time;
    latest = std::max(latest, *date);
  }
  image.attributes[attributes::kRenderTime] = seconds;
  image.attributes[attributes::kDate] = latest;
}

Attribute samples_attribute(const Image& image) {
  const std::vector<float>& counts = image.find("SampleCount")->values;
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  if (*least == *most && *most < 0x1p31f) return static_cast<int>(*least);
  std::ostringstream range;
  range << std::fixed << std::setprecision(0) << *least << ".." << *most;
  return range.str();
}

/// Those that all slices agree in, but for what only slices have.
std::map<std::string, Attribute> common_attributes(const std::vector<Slice>& slices) {
  auto attributes = slices.front().header.attributes;
  std::erase_if(attributes, [](const auto& a) { return is_slice_attribute(a.first); });
  for (const Slice& slice : slices) {
    std::erase_if(attributes, [&](const auto& a) {
      const auto found = slice.header.attributes.find(a.first);
      return found == slice.header.attributes.end() || found->second != a.second;
    });
  }
  return attributes;
}

void merge_attributes(const std::vector<Slice>& slices, Image& image) {
  image.attributes = common_attributes(slices);
  std::vector<SliceSource> sources;
  std::set<std::uint64_t> seeds;
  for (const Slice& slice : slices) {
    sources.insert(sources.end(), slice.sources.begin(), slice.sources.end());
    for (const SliceSource& source : slice.sources) seeds.insert(source.seed);
  }
  std::string seed_list;
  for (const std::uint64_t seed : seeds) seed_list += (seed_list.empty() ? "" : ", ") + std::to_string(seed);
  image.attributes[attributes::kSlices] = sources_text(std::move(sources));
  image.attributes[attributes::kSeed] = seed_list;
  image.attributes[attributes::kSamples] = samples_attribute(image);
  const std::string options = listed(slices, attributes::kOptions, " | ");
  if (!options.empty()) image.attributes[attributes::kOptions] = options;
  merge_times(slices, image);
}

bool are_parts(const std::vector<Slice>& slices) {
  return std::all_of(slices.begin(), slices.end(), [](const Slice& s) { return s.part.has_value(); });
}

/// Those that can be read. Among slices the others are left out; elsewhere the first failure stands.
std::vector<Slice> read_headers(const std::vector<std::string>& paths, std::vector<std::string>& left_out) {
  std::vector<Slice> slices;
  std::optional<Error> failure;
  for (const std::string& path : paths) {
    try {
      slices.push_back(read_slice(path));
    } catch (const Error& e) {
      if (!failure) failure = e;
      left_out.emplace_back(e.what());
    }
  }
  if (failure && (slices.empty() || !are_parts(slices))) throw Error(*failure);
  return slices;
}

/// Moves those of which `read` throws from `slices` to `left_out`, unless these are all.
template <typename Read>
void leave_out_unreadable(std::vector<Slice>& slices, std::vector<std::string>& left_out, const Read& read) {
  std::erase_if(slices, [&](const Slice& slice) {
    try {
      read(slice);
      return false;
    } catch (const Error& e) {
      left_out.emplace_back(e.what());
      return true;
    }
  });
  if (slices.empty()) throw Error(Failure::scene, left_out.front());
}

Image weighted_mean(std::vector<Slice>& slices, const MergeSettings& settings, std::vector<std::string>& left_out) {
  const PixelBounds box = box_around(slices);
  if (!settings.fill_black) require_covered(slices, box);
  MergeSum sum(box, slices.front().header);
  const auto add = [&](const Slice& slice) { sum.add(read_pixels(slice), slice.sources.front().samples); };
  if (are_parts(slices)) {
    leave_out_unreadable(slices, left_out, add);
    if (!settings.fill_black) require_covered(slices, box);
  } else {
    std::for_each(slices.begin(), slices.end(), add);
  }
  Image image = sum.result();
  image.display = slices.front().header.display;
  image.chromaticities = slices.front().header.chromaticities;
  merge_attributes(slices, image);
  return image;
}

/// Of those that can be read as they were written.
SliceSum exact_sum(std::vector<Slice>& slices, std::vector<std::string>& left_out) {
  SliceSum sum(slices.front().header, slices.front().path);
  leave_out_unreadable(slices, left_out, [&](const Slice& slice) { sum.add(read_pixels(slice), slice.path); });
  return sum;
}

SliceTally tally_of(const std::vector<Slice>& slices) {
  const SliceInfo& first = *slices.front().part;
  SliceTally tally{first.choice.count, first.total, {}, {}, first.choice};
  std::set<int> whole;
  for (const Slice& slice : slices) {
    if (slice.part->complete()) whole.insert(slice.part->choice.index);
  }
  for (int i = 1; i <= tally.count; ++i) {
    if (!whole.contains(i)) tally.missing.push_back(i);
  }
  if (const auto* command = slices.front().header.attribute<std::string>(attributes::kCommand)) tally.command = *command;
  return tally;
}

/// Of each render that some are slices of, in the order of the first ones.
std::vector<SliceTally> tallies_of(const std::vector<Slice>& slices) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<Slice>> renders;
  for (const Slice& slice : slices) {
    const auto render = render_of(slice.header, slice.part);
    if (!render) continue;
    std::vector<Slice>& parts = renders[*render];
    if (parts.empty()) order.push_back(*render);
    parts.push_back(slice);
  }
  std::vector<SliceTally> tallies;
  for (const std::string& render : order) tallies.push_back(tally_of(renders[render]));
  return tallies;
}

bool are_of_one_render(const std::vector<Slice>& slices) {
  const auto first = render_of(slices.front().header, slices.front().part);
  return first &&
         std::all_of(slices.begin(), slices.end(), [&](const Slice& s) { return render_of(s.header, s.part) == first; });
}

/// Of what a flat image says of itself, what goes for a deep one: not what is said of channels that it has not.
std::map<std::string, Attribute> attributes_in_depth(const Image& flat) {
  auto attributes = flat.attributes;
  std::erase_if(attributes,
                [](const auto& a) { return a.first.starts_with("cryptomatte/") || a.first == attributes::kLightGroups; });
  return attributes;
}

/// The picture of slices of one render.
void add_up(std::vector<Slice>& slices, Merged& merged) {
  const SliceSum sum = exact_sum(slices, merged.left_out);
  merged.slices = {tally_of(slices)};
  merged.relmse = sum.estimated_relmse();
  const bool whole = sum.samples() == merged.slices.front().total;
  merged.image = sum.image(!whole);
  if (whole) {
    merged.image.attributes = common_attributes(slices);
    merged.image.attributes[attributes::kSamples] = sum.samples();
    merge_times(slices, merged.image);
  } else {
    merge_attributes(slices, merged.image);
  }
  merged.deep = sum.deep_image();
  if (merged.deep) merged.deep->attributes = attributes_in_depth(merged.image);
}

}  // namespace

Merged merge_slices(const std::vector<std::string>& paths, const MergeSettings& settings) {
  Merged merged;
  std::vector<Slice> slices = read_headers(paths, merged.left_out);
  require_mergeable(slices);
  // Sums in an order that depends on the slices alone. No two have equal sources: their samples would count twice.
  std::sort(slices.begin(), slices.end(),
            [](const Slice& a, const Slice& b) { return sources_text(a.sources) < sources_text(b.sources); });
  if (are_of_one_render(slices)) {
    add_up(slices, merged);
  } else {
    merged.image = weighted_mean(slices, settings, merged.left_out);
    merged.slices = tallies_of(slices);
    if (has_variances(merged.image)) merged.relmse = relmse_by_variances(merged.image);
  }
  merged.images = slices.size();
  return merged;
}

}  // namespace tyndall
