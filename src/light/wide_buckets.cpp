// Buckets hold componentwise minima and maxima, which cost two instructions a light, are exact, and do not depend on
// the order: boxes of positions and boxes of normals. A cone is read off the latter. What a split decides by may be
// rough; the bounds in the finished tree come from the lights themselves.
#include "light/wide_buckets.h"

#include <array>
#include <cmath>

#include "math/simd.h"

namespace tyndall {
namespace {

constexpr int kBuckets = BucketGrid::kBuckets;
/// Of larger sets every second, third ... light is looked at.
constexpr std::size_t kSample = 8192;
using Range = std::span<const BuildLight>;

/// The words of a BuildLight from `low` and from `axis` on.
Float8 first_words(const BuildLight& l) { return load8(l.low); }
Float8 last_words(const BuildLight& l) { return load8(l.axis); }

struct Bucket {
  Float8 low_first = kInfinity, low_last = kInfinity, high_last = -kInfinity;
  double intensity = 0;
  std::uint32_t count = 0;

  void add(Float8 first, Float8 last, float strength) {
    low_first = min(low_first, first);
    low_last = min(low_last, last);
    high_last = max(high_last, last);
    intensity += strength;
    ++count;
  }
  void add(const Bucket& b) {
    low_first = min(low_first, b.low_first);
    low_last = min(low_last, b.low_last);
    high_last = max(high_last, b.high_last);
    intensity += b.intensity;
    count += b.count;
  }
};

/// The unions of buckets on one side of each cut, a row each.
struct Sides {
  alignas(32) float low_first[kBuckets][8], low_last[kBuckets][8], high_last[kBuckets][8];
  alignas(32) float intensity[kBuckets];

  void set(int i, const Bucket& b) {
    store8(low_first[i], b.low_first);
    store8(low_last[i], b.low_last);
    store8(high_last[i], b.high_last);
    intensity[i] = static_cast<float>(b.intensity);
  }
};

Float8 column(const float (*rows)[8], int word) {
  return Float8([&](int i) { return rows[i][word]; });
}

/// Intensity x area x solid angle [2018, eq. 1 and 2] of eight sides, lengths multiplied by `scale` so that squares
/// stay in range. The solid angle of normals and skirt is that of one cone, theta_o + 2/3 theta_e wide: the same for
/// theta_o = 0, theta_e = pi/2, and within 5 % elsewhere.
[[gnu::flatten]] Float8 measures(const Sides& s, int begin, float scale) {
  const auto extent = [&](int k) { return (-column(s.low_first + begin, k + 3) - column(s.low_first + begin, k)) * scale; };
  const Float8 x = extent(0), y = extent(1), z = extent(2);
  const Float8 area = x * y + y * z + z * x + 1e-3f * (x * x + y * y + z * z);

  // The narrowest cone about the middle m of a box of unit vectors, half its diagonal e: |n - m| <= e.
  Float8 middle2 = 0, spread2 = 0;
  for (int k = 0; k < 3; ++k) {
    const Float8 high = column(s.high_last + begin, k), low = column(s.low_last + begin, k);
    middle2 += 0.25f * (high + low) * (high + low);
    spread2 += 0.25f * (high - low) * (high - low);
  }
  const Float8 spread = min(max((1 + middle2 - spread2) / (2 * sqrt(middle2) + 1e-30f), Float8(-1.0f)), Float8(1.0f));
  const Float8 reach = column(s.low_last + begin, 5);
  const Float8 both = spread * reach - sqrt((1 - spread * spread) * (1 - reach * reach));
  return load8(s.intensity + begin) * area * (1 - choose(spread <= -reach, -1.0f, both));
}

struct Measures {
  alignas(32) std::array<float, kBuckets> of;
};

Measures all_measures(const Sides& sides, int rows, float scale) {
  Measures m;
  for (int i = 0; i < rows; i += 8) store8(m.of.data() + i, measures(sides, i, scale));
  return m;
}

using Grids = std::array<BucketGrid, 3>;
using Buckets = std::array<std::array<Bucket, kBuckets>, 3>;

/// The step between the lights that are looked at.
std::size_t stride(Range lights) { return (lights.size() + kSample - 1) / kSample; }

Grids make_grids(Range lights) {
  Grids grids;
  const std::size_t step = stride(lights);
  for (std::size_t i = 0; i < lights.size(); i += step) {
    for (int axis = 0; axis < 3; ++axis) {
      const float x = BucketGrid::place(lights[i], axis);
      grids[axis].low = std::min(grids[axis].low, x);
      grids[axis].high = std::max(grids[axis].high, x);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    BucketGrid& grid = grids[axis];
    grid.axis = axis;
    grid.per_length = grid.high > grid.low ? kBuckets / (grid.high - grid.low) : 0.0f;
    if (!std::isfinite(grid.per_length)) grid.per_length = 0;
  }
  return grids;
}

/// Flattened, for SIMD.
[[gnu::flatten]] void fill(Buckets& buckets, Range lights, const Grids& grids) {
  const std::size_t step = stride(lights);
  for (std::size_t i = 0; i < lights.size(); i += step) {
    const BuildLight& light = lights[i];
    const Float8 first = first_words(light), last = last_words(light);
    for (int axis = 0; axis < 3; ++axis) {
      if (!grids[axis].flat()) buckets[axis][grids[axis].of(light)].add(first, last, light.intensity);
    }
  }
}

struct Cut {
  int last = 0;  ///< bucket of the first side
  float cost = kInfinity;
  float first = 0, second = 0;  ///< measures of both sides
};

/// The cheapest cut between the buckets of one axis, by unions from both ends.
[[gnu::flatten]] Cut best_between(const std::array<Bucket, kBuckets>& buckets, float scale) {
  // Row r: the buckets up to the r-th that is not empty, and the rest. Cuts elsewhere give nothing new.
  std::array<int, kBuckets> bucket;
  int rows = 0;
  for (int i = 0; i < kBuckets; ++i)
    if (buckets[i].count > 0) bucket[rows++] = i;
  Sides before, after;
  Bucket prefix, suffix;
  for (int r = 0; r < rows; ++r) {
    prefix.add(buckets[bucket[r]]);
    before.set(r, prefix);
  }
  for (int r = rows; r-- > 0;) {
    after.set(r, suffix);
    suffix.add(buckets[bucket[r]]);
  }
  const Measures first = all_measures(before, rows - 1, scale), second = all_measures(after, rows - 1, scale);
  Cut best;
  for (int r = 0; r < rows - 1; ++r) {
    const float cost = first.of[r] + second.of[r];
    if (cost < best.cost) best = {bucket[r], cost, first.of[r], second.of[r]};
  }
  return best;
}

}  // namespace

std::optional<BucketCut> best_cut(Range lights) {
  const Grids grids = make_grids(lights);
  Buckets buckets;
  fill(buckets, lights, grids);

  // Cuts across short sides make slivers: they cost in proportion to the longest side over this one.
  float longest = 0;
  for (const BucketGrid& grid : grids) longest = std::max(longest, grid.high - grid.low);
  const double area = double(longest) * longest;
  float least = kInfinity;
  BucketCut best;
  for (const BucketGrid& grid : grids) {
    if (grid.flat()) continue;
    const Cut cut = best_between(buckets[grid.axis], 1 / longest);
    const float cost = cut.cost * (longest / (grid.high - grid.low));
    if (!(cost < least)) continue;
    least = cost;
    best = {grid, cut.last, cut.first * area, cut.second * area};
  }
  return least < kInfinity ? std::optional(best) : std::nullopt;
}

}  // namespace tyndall
