/// Joining renders of one scene: different seeds make one less noisy picture, different crops one larger picture.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/deep_image.h"
#include "tyndall/image.h"
#include "tyndall/slice.h"

namespace tyndall {

struct MergeSettings {
  bool fill_black = false;  ///< pixels that no slice holds become 0 with SampleCount 0 instead of an error
};

/// How many of a render's slices came.
struct SliceTally {
  int count = 0, total = 0;  ///< slices, and samples a pixel that they were asked for
  std::vector<int> missing;  ///< neither whole nor there, from 1
  std::string command;       ///< that rendered the first one here: tyndall/command; may be empty
  SliceChoice of_command;    ///< its slice
};

struct Merged {
  Image image;
  std::optional<DeepImage> deep;      ///< of slices that have what it takes
  std::size_t images = 0;             ///< that went in
  std::vector<std::string> left_out;  ///< slices that could not be read, with the reason
  std::vector<SliceTally> slices;     ///< of each render that some of them are slices of
  std::optional<double> relmse;       ///< estimated, as RenderJob does; nothing where Variance is not known
  bool complete() const {
    return left_out.empty() && std::all_of(slices.begin(), slices.end(), [](const SliceTally& t) { return t.missing.empty(); });
  }
};

/// Merge images that render or merge_slices made (.exr), weighted by their sample counts pixel by pixel, in doubles.
/// The order of `paths` does not matter, not even to the last bit, and merging merged images gives what merging all
/// would, up to the rounding to floats.
///
/// The data window is the box around all slices. All channels are weighted means, exactly what one pass over all samples
/// would give (up to the floats of the slices):
///     R G B A, light, Albedo, N ...    by sample count
///     Z, P by SurfaceCount, Zvol by VolumeCount: means over the samples that hit something, as in a render
///     SampleCount (always there), SurfaceCount, VolumeCount    sums
///     mattes by sample count, id by id, then cut to their ranks again
///     Variance of the weighted mean of independent renders:    sum n_i^2 V_i / N^2,
///     Dof, degrees of freedom of that:    N^2 / sum (n_i^2 / dof_i), dof 1 of a plain render   [Satterthwaite 1946,
///         with variances in proportion to 1/n_i: from the counts alone, so that it is not correlated with the noise]
/// Slices of one render (RenderSettings::slice) are added exactly: all of them give the image of the render that was not
/// sliced, bit for bit, and what came of them, with Variance and SampleCount, that of a render of so many samples. Where all
/// files are slices, of whatever renders, one that is missing or damaged is left out.
///
/// Attributes: tyndall/samples (an integer where all pixels have as many, else text "4..8"), tyndall/seed (all, listed),
/// tyndall/slices (what went in: sources_text), tyndall/options (the distinct ones, " | " between), tyndall/renderTime
/// (sum), tyndall/date (latest); others are kept where all slices agree.
///
/// Throws Error (scene) for slices that do not go together (require_mergeable) and for pixels that none holds.
Merged merge_slices(const std::vector<std::string>& paths, const MergeSettings& settings = {});

}  // namespace tyndall
