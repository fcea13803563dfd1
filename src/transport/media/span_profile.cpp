#include "transport/media/span_profile.h"

#include <algorithm>
#include <cmath>

#include "volume/coarse.h"

namespace tyndall {
namespace {

/// Optical depth at which a span without end is taken to be over.
constexpr float kDeep = 16;
/// A medium so thin that it is this wide scatters nothing: squares of distances must stay finite.
constexpr float kFarthest = 1e18f;
/// Share of the bins that are spaced evenly, whatever is scattered where.
constexpr float kEvenShare = 0.25f;
/// The optical depth out of the media is taken as this many times that to the nearer of their ends on the span
/// (docs/measurements.md).
constexpr float kSideways = 2;

/// Transmittance of layers of optical depth x, and its mean within the last of them.
class Attenuation {
 public:
  float pass(float x) {
    const float passed = std::exp(-x), before = left_;
    left_ *= passed;
    return before * (x > 1e-3f ? (1 - passed) / x : 1 - 0.5f * x);
  }

 private:
  float left_ = 1;
};

/// Where the span's media can scatter.
struct Extent {
  float begin = kInfinity, end = 0;
  bool uniform = true;  ///< one part, and the same everywhere in it
};

Extent extent_of(const Span& span) {
  Extent e;
  for (const SpanPart& part : span.parts) {
    bool scatters = false, homogeneous = true;
    const float passed = e.end;
    for (const ParticipatingMedium* medium : part.media) {
      homogeneous = homogeneous && medium->homogeneous();
      if (!medium->scatters()) continue;
      const auto range = coarse_extent({&medium, 1}, span.ray, part.t0, part.t1);
      if (!range) continue;
      scatters = true;
      e.begin = std::min(e.begin, range->first);
      e.end = std::max(e.end, range->second);
    }
    if (scatters) e.uniform = homogeneous && passed == 0;
  }
  return e;
}

/// Of distances that increase, but for where they begin anew.
class SpanOptics {
 public:
  explicit SpanOptics(const Span& span) : span_(span) {}

  CoarseOptics at(float t) {
    const SpanPart& part = span_.part_at(t);
    if (t < part.t0 || t > part.t1) return {};  // between parts
    if (&part != part_) {
      part_ = &part;
      ray_ = CoarseRay(part.view(), span_.ray);
    }
    return ray_.at(t);
  }

 private:
  const Span& span_;
  const SpanPart* part_ = nullptr;
  CoarseRay ray_;
};

/// An end for spans without one: where what lies behind is too attenuated to matter.
float last_distance(const Span& span, const Extent& e) {
  if (e.end < kInfinity) return e.end;
  const SpanPart& last = span.parts.back();
  const float from = std::max(last.t0, e.begin);
  float sigma_t = 0, settled = from;
  for (const ParticipatingMedium* medium : last.media) {
    if (medium->homogeneous()) {
      const auto [sigma_a, sigma_s] = medium->optics_at(span.ray.o);
      sigma_t += mean(sigma_a + sigma_s);
    } else if (const auto range = coarse_extent({&medium, 1}, span.ray, last.t0, last.t1)) {
      settled = std::max(settled, range->second);
    }
  }
  return std::max(settled, from + kDeep / sigma_t);
}

}  // namespace

std::optional<SpanProfile> SpanProfile::of(const Span& span, Bins bins) {
  const Extent extent = extent_of(span);
  if (!(extent.begin < extent.end)) return std::nullopt;
  SpanProfile profile(bins);
  profile.enters_ = extent.begin > 0;
  profile.leaves_ = extent.end < span.t_end;
  SpanOptics optics(span);
  if (extent.uniform) {
    const CoarseOptics o = optics.at(extent.begin);
    if (!(o.sigma_s > 0) || !(kDeep / o.sigma_t < kFarthest)) return std::nullopt;
    profile.place_evenly(extent.begin, extent.end, o.sigma_t);
    profile.fill([o](float) { return o; });
  } else {
    const float last = last_distance(span, extent);
    if (!(last < kFarthest)) return std::nullopt;
    const auto at = [&](float t) { return optics.at(t); };
    profile.place_by_looks(at, extent.begin, last);
    profile.fill(at);
    profile.edge_[profile.bins_] = extent.end;
  }
  return profile;
}

/// Edges where exp(-depth / 2) has fallen by equal steps, in closed form.
void SpanProfile::place_evenly(float begin, float end, float sigma_t) {
  const float low = end < kInfinity ? std::exp(-0.5f * std::min(sigma_t * (end - begin), kDeep)) : std::exp(-0.5f * kDeep);
  const bool thin = 1 - low < 1e-3f;
  for (std::size_t k = 0; k < bins_; ++k) {
    const float share = static_cast<float>(k) / static_cast<float>(bins_);
    edge_[k] = begin + (thin ? share * (end - begin) : -2 / sigma_t * std::log1p(-share * (1 - low)));
  }
  edge_[bins_] = end;
}

/// Edges that follow sigma_s x sqrt(transmittance), so that light from deep in the medium gets its bins as well; the medium is
/// read half as many times as there are bins.
template <typename F>
void SpanProfile::place_by_looks(const F& optics, float begin, float end) {
  const std::size_t looks = bins_ / 2;
  const float step = (end - begin) / static_cast<float>(looks);
  std::array<float, kMostBins / 2> scattered;
  Attenuation attenuation;
  float sum = 0;
  for (std::size_t i = 0; i < looks; ++i) {
    const CoarseOptics o = optics(begin + (static_cast<float>(i) + 0.5f) * step);
    scattered[i] = o.sigma_s * step * attenuation.pass(0.5f * o.sigma_t * step);
    sum += scattered[i];
  }
  const float even = sum > 0 ? kEvenShare / (1 - kEvenShare) * sum / static_cast<float>(looks) : 1.0f;
  std::array<float, kMostBins / 2 + 1> at, cumulative;
  at[0] = begin;
  cumulative[0] = 0;
  for (std::size_t i = 0; i < looks; ++i) {
    at[i + 1] = i + 1 == looks ? end : begin + static_cast<float>(i + 1) * step;
    cumulative[i + 1] = cumulative[i] + scattered[i] + even;
  }
  place_at_shares({at.data(), looks + 1}, {cumulative.data(), looks + 1});
}

/// Edges at equal shares of an increasing function that is given at `at` and linear in between.
void SpanProfile::place_at_shares(std::span<const float> at, std::span<const float> cumulative) {
  std::size_t i = 0;
  edge_[0] = at.front();
  edge_[bins_] = at.back();
  for (std::size_t k = 1; k < bins_; ++k) {
    const float wanted = cumulative.back() * static_cast<float>(k) / static_cast<float>(bins_);
    while (i + 2 < at.size() && cumulative[i + 1] < wanted) ++i;
    const float rise = cumulative[i + 1] - cumulative[i];
    const float share = rise > 0 ? std::clamp((wanted - cumulative[i]) / rise, 0.0f, 1.0f) : 0.0f;
    edge_[k] = at[i] + share * (at[i + 1] - at[i]);
  }
}

/// `optics`: of a distance.
template <typename F>
void SpanProfile::fill(const F& optics) {
  Attenuation attenuation;
  for (std::size_t i = 0; i < bins_; ++i) {
    const bool endless = edge_[i + 1] == kInfinity;
    const CoarseOptics o = optics(endless ? edge_[i] : 0.5f * (edge_[i] + edge_[i + 1]));
    const float length = endless ? kDeep / o.sigma_t : edge_[i + 1] - edge_[i];
    sigma_t_[i] = o.sigma_t;
    scattering_[i] = o.sigma_s * attenuation.pass(o.sigma_t * length);
    depth_[i + 1] = depth_[i] + o.sigma_t * length;
    scattered_ += scattering_[i] * length;
    settled_ = edge_[i] + length;
    if (scattering_[i] > 0 && scattered_ > 0) reach_ = settled_ - edge_.front();
  }
}

std::size_t SpanProfile::bin_at(float t) const {
  const auto first = edge_.begin() + 1, last = edge_.begin() + static_cast<std::ptrdiff_t>(bins_);
  return static_cast<std::size_t>(std::upper_bound(first, last, t) - first);
}

float SpanProfile::transmittance(float t) const {
  const std::size_t i = bin_at(t);
  return std::exp(-(depth_[i] + sigma_t_[i] * std::max(t - edge_[i], 0.0f)));
}

float SpanProfile::way_out(float depth) const {
  if (end() == kInfinity) return kInfinity;
  const float ahead = optical_depth() - depth;
  if (!enters_ && !leaves_) return std::max(depth, ahead);
  return kSideways * std::min(enters_ ? depth : kInfinity, leaves_ ? ahead : kInfinity);
}

SegmentProfile SpanProfile::coarse(float g) const {
  const std::size_t group = bins_ / SegmentProfile::kBins;
  SegmentProfile p;
  p.g = g;
  const float average = optical_depth() / (settled_ - begin());
  for (std::size_t j = 0; j < SegmentProfile::kBins; ++j) {
    const std::size_t first = j * group, end = first + group;
    p.edge[j] = edge_[first];
    p.edge[j + 1] = edge_[end];
    float sum = 0, length = 0;
    for (std::size_t i = first; i < end; ++i) {
      const float own = std::min(edge_[i + 1], settled_) - edge_[i];
      sum += scattering_[i] * own;
      length += own;
    }
    p.scattering[j] = length > 0 ? sum / length : 0.0f;
    // Toward lights the medium is taken to be as dense as here and along the ray, and as wide.
    const std::size_t middle = first + group / 2;
    p.sigma[j] = 0.5f * (sigma_t_[middle] + average);
    p.escape[j] = way_out(depth_[middle]);
  }
  return p;
}

}  // namespace tyndall
