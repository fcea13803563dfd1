#include <algorithm>
#include <map>
#include <set>

#include "report/slice.h"
#include "tyndall/cryptomatte.h"
#include "tyndall/error.h"
#include "tyndall/image_attributes.h"

namespace tyndall {
namespace {

[[noreturn]] void fail(const Slice& slice, const std::string& what) { throw Error(Failure::scene, slice.path + ": " + what); }

std::string size_text(const PixelBounds& b) { return std::to_string(b.width()) + "x" + std::to_string(b.height()); }

void require_same_scene(const Slice& first, const Slice& slice) {
  if (intersection(slice.header.data, slice.header.display) != slice.header.data) {
    fail(slice, "holds pixels outside its frame, which no render does; render it again");
  }
  if (slice.header.display != first.header.display) {
    fail(slice, "its frame is " + size_text(slice.header.display) + ", that of " + first.path + " " +
                    size_text(first.header.display) + "; render both at one --resolution");
  }
  if (slice.scene_hash != first.scene_hash) {
    fail(slice, "scene hash " + slice.scene_hash + " differs from " + first.scene_hash + " of " + first.path +
                    ": they do not show the same scene; render both from the same scene, files, --resolution and --max-depth");
  }
}

void require_same_mix(const Slice& first, const Slice& slice) {
  const auto mix_of = [](const Slice& s) {
    const auto* text = s.header.attribute<std::string>(attributes::kRelight);
    return text ? *text : std::string();
  };
  if (mix_of(slice) != mix_of(first))
    fail(slice, "its light groups are mixed otherwise than in " + first.path + "; merge first, and relight what is merged");
}

/// What filtering has made of each is not what it would have made of all.
void require_not_denoised(const Slice& slice) {
  if (slice.header.attributes.contains(attributes::kDenoised))
    fail(slice, "is denoised; merge what was rendered with --aov Denoise, and denoise what is merged");
}

/// An id is the hash of a name: of other names the sums would be of others.
void require_same_names(const Slice& first, const Slice& slice) {
  for (const std::string_view layer : kMatteLayers) {
    const auto names_of = [&](const Slice& s) { return s.header.attribute<std::string>(manifest_attribute(layer)); };
    const std::string *a = names_of(first), *b = names_of(slice);
    if (a && b && *a != *b)
      fail(slice, "its " + std::string(layer) + " has other names than in " + first.path +
                      "; render both with the same names in the scene");
  }
}

std::set<std::string> shared_channels(const Slice& slice) {
  std::set<std::string> names;
  for (const Channel& c : slice.header.channels) {
    if (is_shared_channel(c.name)) names.insert(c.name);
  }
  return names;
}

void require_same_channels(const Slice& first, const Slice& slice) {
  const auto a = shared_channels(first), b = shared_channels(slice);
  std::string difference;
  const auto list = [&](const auto& of, const auto& missing_in, const std::string& owner) {
    std::string names;
    for (const std::string& name : of) {
      if (!missing_in.contains(name)) names += (names.empty() ? "" : ", ") + name;
    }
    if (!names.empty()) difference += (difference.empty() ? "" : "; ") + ("only " + owner + " has " + names);
  };
  list(a, b, first.path);
  list(b, a, slice.path);
  if (!difference.empty()) fail(slice, "channels differ: " + difference + "; render all slices with the same --aov");
}

/// Z, P and Zvol are means over the samples that hit something, and replicates over the even ones, so those must be counted.
void require_counts(const Slice& slice) {
  const auto channels = shared_channels(slice);
  const auto needs = [&](const std::string& channel, const std::string& count) {
    if (channels.contains(channel) && !channels.contains(count)) {
      fail(slice, "has " + channel + " but not " + count + ", by which it is averaged; render it again");
    }
  };
  needs("Z", "SurfaceCount");
  needs("P.X", "SurfaceCount");
  needs("Zvol", "VolumeCount");
  needs("Replicate.Z", "Replicate.SurfaceCount");
  needs("Replicate.P.X", "Replicate.SurfaceCount");
  needs("Replicate.Zvol", "Replicate.VolumeCount");
  needs("Replicate.R", "Replicate.SampleCount");
  if (slice.header.attributes.contains(attributes::kSlices) && !slice.header.find("SampleCount")) {
    fail(slice, "is a merged image without SampleCount, by which it is averaged; merge its slices again");
  }
}

void require_variance(const Slice& slice) {
  if (!slice.header.find("Variance.R")) return;
  for (const SliceSource& source : slice.sources) {
    if (source.samples > 1) continue;
    fail(slice,
         "has 1 sample a pixel, from which no Variance can be known; render slices of 2 or more, or all without Variance");
  }
}

/// One file by one name; by two names it is found by its samples.
void require_new_files(const std::vector<Slice>& slices) {
  std::set<std::string> paths;
  for (const Slice& slice : slices) {
    if (!paths.insert(slice.path).second) fail(slice, "is given twice; name it once");
  }
}

/// Equal seeds give equal samples: in one pixel they would count twice and their error be taken for half of what it is.
void require_new_samples(const std::vector<Slice>& slices) {
  struct Rendered {
    const Slice* slice;
    const SliceSource* source;
  };
  const auto share_samples = [](const SliceSource& a, const SliceSource& b) {
    return a.first < std::int64_t{b.first} + b.samples && b.first < std::int64_t{a.first} + a.samples;
  };
  std::map<std::uint64_t, std::vector<Rendered>> by_seed;
  for (const Slice& slice : slices) {
    for (const SliceSource& source : slice.sources) {
      for (const Rendered& other : by_seed[source.seed]) {
        const PixelBounds both = intersection(source.crop, other.source->crop);
        if (both.width() <= 0 || both.height() <= 0 || !share_samples(source, *other.source)) continue;
        fail(slice, "seed " + std::to_string(source.seed) + " is in " + other.slice->path + " too and both hold pixels " +
                        crop_text(both) + ": the same samples would count twice; render one of them with another --seed");
      }
      by_seed[source.seed].push_back({&slice, &source});
    }
  }
}

}  // namespace

bool is_shared_channel(const std::string& name) {
  return name != "SampleCount" && !name.ends_with("SampleWeight") && !name.starts_with("Dof.") && !name.starts_with("Sum.");
}

std::optional<std::string> render_of(const Image& header, const std::optional<SliceInfo>& part) {
  if (!part) return std::nullopt;
  std::string render = std::to_string(part->choice.count) + " slices of " + std::to_string(part->total) + " samples" +
                       (part->timed ? ", timed, " : ", ") + crop_text(header.data);
  for (const char* name :
       {attributes::kSceneHash, attributes::kSeed, attributes::kOptions, attributes::kAovs, attributes::kSoftware}) {
    const auto* text = header.attribute<std::string>(name);
    render += "\n" + (text ? *text : std::string());
  }
  return render;
}

void require_mergeable(const std::vector<Slice>& slices) {
  if (slices.empty()) throw Error(Failure::usage, "there is nothing to merge; name the images");
  for (const Slice& slice : slices) {
    require_same_scene(slices.front(), slice);
    require_same_mix(slices.front(), slice);
    require_not_denoised(slice);
    require_same_channels(slices.front(), slice);
    require_same_names(slices.front(), slice);
    require_counts(slice);
    require_variance(slice);
  }
  require_new_files(slices);
  require_new_samples(slices);
}

}  // namespace tyndall
