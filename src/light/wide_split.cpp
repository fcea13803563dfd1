// Buckets hold componentwise minima and maxima, which cost two instructions a light, are exact, and do not depend on
// the order: boxes of positions and boxes of normals. A cone is read off the latter. What a split decides by may be
// rough; the bounds in the finished tree come from the lights themselves.
#include "light/wide_split.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <optional>
#include <vector>

#include "math/simd.h"

namespace tyndall {
namespace {

constexpr int kBuckets = 16;
constexpr std::uint32_t kWidth = 8;
/// Of larger sets every second, third ... light is looked at.
constexpr std::size_t kSample = 8192;
using Range = std::span<BuildLight>;

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

/// Twice the light's centre.
float place(const BuildLight& light, int axis) { return light.low[axis] - light.minus_high[axis]; }

/// The lights' centres along one axis, cut into equal buckets.
struct Grid {
  float low = kInfinity, high = -kInfinity, per_length = 0;

  void finish() {
    per_length = high > low ? kBuckets / (high - low) : 0.0f;
    if (!std::isfinite(per_length)) per_length = 0;
  }
  bool flat() const { return per_length == 0; }
  int of(float place) const { return std::clamp(static_cast<int>((place - low) * per_length), 0, kBuckets - 1); }
};

using Grids = std::array<Grid, 3>;
using Buckets = std::array<std::array<Bucket, kBuckets>, 3>;

/// Every how manyeth light is looked at.
std::size_t stride(Range lights) { return (lights.size() + kSample - 1) / kSample; }

Grids make_grids(Range lights) {
  Grids grids;
  const std::size_t step = stride(lights);
  for (std::size_t i = 0; i < lights.size(); i += step) {
    for (int axis = 0; axis < 3; ++axis) {
      const float x = place(lights[i], axis);
      grids[axis].low = std::min(grids[axis].low, x);
      grids[axis].high = std::max(grids[axis].high, x);
    }
  }
  for (Grid& grid : grids) grid.finish();
  return grids;
}

/// Flattened, for SIMD.
[[gnu::flatten]] void fill(Buckets& buckets, Range lights, const Grids& grids) {
  const std::size_t step = stride(lights);
  for (std::size_t i = 0; i < lights.size(); i += step) {
    const BuildLight& light = lights[i];
    const Float8 first = first_words(light), last = last_words(light);
    for (int axis = 0; axis < 3; ++axis) {
      if (!grids[axis].flat()) buckets[axis][grids[axis].of(place(light, axis))].add(first, last, light.intensity);
    }
  }
}

struct Cut {
  int axis = 0, last = 0;  ///< last bucket of the first side
  float cost = kInfinity;
  float first = 0, second = 0;  ///< measures of both sides
};

/// The cheapest cut between the buckets of one axis, by unions from both ends.
[[gnu::flatten]] Cut best_cut(const std::array<Bucket, kBuckets>& buckets, float scale) {
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
    if (cost < best.cost) best = {0, bucket[r], cost, first.of[r], second.of[r]};
  }
  return best;
}

/// A part of a node's lights, and what the heuristic says of keeping it whole.
struct Part {
  Range lights;
  double measure = 0;
};

std::array<Part, 2> halves(Range lights, double measure) {
  const std::size_t middle = lights.size() / 2;
  return {{{lights.first(middle), measure / 2}, {lights.subspan(middle), measure / 2}}};
}

/// Two parts that are not empty; in half when nothing tells the lights apart.
/// Moves those for which `first` holds to the front and gives their number. Without branches, which would be guessed
/// wrong every other time; large sets need too much space for that.
template <typename F>
std::size_t partition(Range lights, const F& first) {
  constexpr std::size_t kLarge = 65536;
  if (lights.size() > kLarge)
    return static_cast<std::size_t>(std::partition(lights.begin(), lights.end(), first) - lights.begin());
  thread_local std::vector<BuildLight> rest;
  if (rest.size() < lights.size()) rest.resize(std::min(std::bit_ceil(lights.size()), kLarge));
  std::size_t front = 0, back = 0;
  for (const BuildLight& light : lights) {
    const bool is_first = first(light);
    rest[back] = light;
    lights[front] = light;
    front += is_first;
    back += !is_first;
  }
  std::copy(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(back),
            lights.begin() + static_cast<std::ptrdiff_t>(front));
  return front;
}

std::array<Part, 2> split(const Part& part) {
  const Range lights = part.lights;
  const Grids grids = make_grids(lights);
  Buckets buckets;
  fill(buckets, lights, grids);

  // Cuts across short sides make slivers: they cost in proportion to the longest side over this one.
  float longest = 0;
  for (const Grid& grid : grids) longest = std::max(longest, grid.high - grid.low);
  Cut best;
  for (int axis = 0; axis < 3; ++axis) {
    if (grids[axis].flat()) continue;
    Cut cut = best_cut(buckets[axis], 1 / longest);
    cut.axis = axis;
    cut.cost *= longest / (grids[axis].high - grids[axis].low);
    if (cut.cost < best.cost) best = cut;
  }
  if (!(best.cost < kInfinity)) return halves(lights, part.measure);

  const Grid& grid = grids[best.axis];
  const std::size_t count =
      partition(lights, [&](const BuildLight& light) { return grid.of(place(light, best.axis)) <= best.last; });
  if (count == 0 || count == lights.size()) return halves(lights, part.measure);
  const double area = double(longest) * longest;
  return {{{lights.first(count), best.first * area}, {lights.subspan(count), best.second * area}}};
}

/// Up to eight parts in order.
struct Parts {
  std::array<Part, kWidth> of;
  std::size_t size = 1;

  void replace(std::size_t i, std::span<const Part> by) {
    std::move_backward(of.begin() + i + 1, of.begin() + size, of.begin() + size + by.size() - 1);
    std::copy(by.begin(), by.end(), of.begin() + i);
    size += by.size() - 1;
  }
};

/// The part that it pays most to split; only such as do not fit one node.
std::optional<std::size_t> worst(const Parts& parts) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < parts.size; ++i) {
    if (parts.of[i].lights.size() <= kWidth) continue;
    if (!found || parts.of[i].measure > parts.of[*found].measure) found = i;
  }
  return found;
}

/// The smallest part that the free places could take light by light: that saves a node.
std::optional<std::size_t> smallest(const Parts& parts) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < parts.size; ++i) {
    const std::size_t n = parts.of[i].lights.size();
    if (n < 2 || parts.size - 1 + n > kWidth) continue;
    if (!found || n < parts.of[*found].lights.size()) found = i;
  }
  return found;
}

}  // namespace

BuildLight BuildLight::from(const TreeLight& light, double to_unit, double intensity) {
  const LightBounds& b = light.bounds;
  BuildLight l;
  for (int k = 0; k < 3; ++k) {
    l.low[k] = static_cast<float>(b.box.min[k] * to_unit);
    l.minus_high[k] = static_cast<float>(-(b.box.max[k] * to_unit));
    l.axis[k] = b.normals.axis[k];
  }
  l.theta_o = b.normals.theta;
  l.theta_e = b.theta_e;
  const double reach = std::max(double(b.normals.theta), 0.0) + 2.0 / 3 * b.theta_e;
  l.cos_reach = reach >= kPi ? -1.0f : static_cast<float>(std::cos(reach));
  l.intensity = std::max(static_cast<float>(b.intensity / intensity), 1e-37f);
  l.light = light.light & 0x7fffffff;
  l.two_sided = b.two_sided;
  return l;
}

LightBounds BuildLight::bounds() const {
  LightBounds b;
  b.box = {{low[0], low[1], low[2]}, {-minus_high[0], -minus_high[1], -minus_high[2]}};
  b.normals = DirectionCone::around({axis[0], axis[1], axis[2]}, theta_o);
  b.theta_e = theta_e;
  b.intensity = intensity;
  b.two_sided = two_sided;
  return b;
}

Division divide(std::span<BuildLight> lights) {
  assert(!lights.empty());
  Parts parts;
  parts.of[0] = {lights, 1};
  while (parts.size < kWidth) {
    const auto i = worst(parts);
    if (!i) break;
    const auto two = split(parts.of[*i]);
    parts.replace(*i, two);
  }
  while (const auto i = smallest(parts)) {
    std::array<Part, kWidth> single;
    const Range whole = parts.of[*i].lights;
    for (std::size_t k = 0; k < whole.size(); ++k) single[k] = {whole.subspan(k, 1), 0};
    parts.replace(*i, std::span(single).first(whole.size()));
  }
  Division division{};
  for (std::size_t i = 0; i < parts.size; ++i) division[i] = static_cast<std::uint32_t>(parts.of[i].lights.size());
  return division;
}

}  // namespace tyndall
