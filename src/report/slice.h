/// What a rendered image says of itself: which samples of which pixels of which scene it holds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/image.h"
#include "tyndall/slice.h"

namespace tyndall {

/// One render: `samples` samples of `seed`, from number `first` on, in every pixel of `crop`.
struct SliceSource {
  std::uint64_t seed = 0;
  int first = 0, samples = 0;
  PixelBounds crop;
};

/// An image file that is to be merged, without its pixels.
struct Slice {
  std::string path;
  Image header;
  std::string scene_hash;
  std::vector<SliceSource> sources;  ///< one of a render; all that went into it, of a merged image
  std::optional<SliceInfo> part;     ///< when it was rendered as a slice of more
};

/// Reads attributes tyndall/sceneHash and tyndall/slices, or (of a plain render) tyndall/seed and tyndall/samples.
/// Throws Error (scene) when it is no EXR that Tyndall rendered.
Slice read_slice(const std::string& path);

/// As attribute tyndall/slices holds it: "seed 7 samples 64 crop 0,480,0,270; seed 8 samples 64 from 128 crop ...", sorted.
std::string sources_text(std::vector<SliceSource> sources);

/// The pixels in both; no pixel: width or height not above 0.
PixelBounds intersection(const PixelBounds& a, const PixelBounds& b);

/// All channels but SampleCount and Dof, which slices may lack: merging adds them; and exact sums, which are of slices alone.
bool is_shared_channel(const std::string& name);

/// What slices of one render, made alike, have in common, as text: their sums can be added. Nothing when it is no slice.
std::optional<std::string> render_of(const Image& header, const std::optional<SliceInfo>& part);

/// Throws Error (scene), naming the slices, for what cannot be merged: other scenes or frames, other channels, samples
/// that would count twice, means whose counts are not known, variances of single samples.
void require_mergeable(const std::vector<Slice>& slices);

}  // namespace tyndall
