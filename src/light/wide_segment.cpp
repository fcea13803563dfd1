// The importance of eight clusters at once for a segment. Its oracle in plain doubles is in the tests.
#include "light/wide_segment.h"

#include "light/wide_lanes.h"
#include "math/simd_math.h"

namespace tyndall {
namespace {

/// Share of a point's largest coordinate, or of its distance, that it may be off by.
constexpr float kPointRounding = 3e-7f, kDistanceRounding = 5e-7f;
/// As near to the line as this share of the distance from the segment's begin, all lights count the same.
constexpr float kNearestToBegin2 = 1e-12f;
/// Standard deviation of the lights' positions along one axis, over that along all three.
constexpr float kOneAxis = 0.57735027f;
// How the spread v of the lights about their mean, along each axis, changes what is estimated at the mean. Without the first
// the variance in dense media is higher, without the second that of forward scattering (docs/measurements.md).
constexpr float kNearer = 3;        ///< transmittance: as of that many sigma v nearer, ...
constexpr float kNearerAtMost = 2;  ///< ... but not of more standard deviations
constexpr float kBlur = 3;          ///< mean cosine of the phase function: less by that many v / r^2
constexpr float kLargestDepth = 80;
constexpr float kLargestImportance = 1e36f;
/// What fast_rsqrt() may lose, for the sphere and for squared cosines.
constexpr float kSeenWider = 1 + 2e-5f, kCosineRounding = 2e-5f;
constexpr float kLeastScattering8 = static_cast<float>(kLeastScattering);
constexpr float kHalfPi8 = 1.57079632679f;

Float8 at_least(Float8 x, float least) { return max(x, Float8(least)); }

/// atan2(h part, x) / length, for the part of the segment's length that is seen so: exact where it is short, too.
Float8 angle_per_length(Float8 h, Float8 x, float part, float length) {
  const Float8 y = h * part, ax = abs(x);
  const Mask8 steep = y > ax, behind = x < 0.0f;
  const Float8 q = choose(steep, ax, h) / choose(steep, y, ax);
  const Float8 r = q * choose(steep, 1.0f, part), per_length = 1 / length;
  const Float8 angle = q * choose(steep, per_length, part / length) * fast_atan_ratio(r * r);
  const Float8 base = choose(steep, kHalfPi8, choose(behind, 2 * kHalfPi8, 0.0f)) * per_length;
  return choose(steep != behind, base - angle, base + angle);
}

/// How the line passes eight places.
struct Passage8 {
  Float8 along;  ///< where its point closest to the place is
  Vector8 foot;  ///< from the place to that point
  Float8 h2;     ///< squared length of `foot`

  Passage8(const Vector8& place, const Vector8& d) : along(dot(place, d)), foot(d * along - place), h2(dot(foot, foot)) {}
};

/// Largest cosine of the angle between the axis and the direction to a point of the segment; see largest_cosine().
Float8 largest_cosine(const Emission8& emission, const Passage8& pass, const Vector8& d, Float8 from, Float8 till) {
  const Float8 a = emission.along(pass.foot), b = emission.along(d);
  const auto at = [&](Float8 s) { return emission.folded(a + s * b) * fast_rsqrt(at_least(pass.h2 + s * s, kTooNear)); };
  const Float8 stationary = choose(a == 0.0f, from, pass.h2 * b / a);
  return max(max(at(from), at(till)), at(min(max(stationary, from), till)));
}

/// The emission toward the place `s` of the line, as estimated.
struct Toward8 {
  const Emission8& emission;
  bool any;              ///< is directed
  Float8 across, along;  ///< components along the axis of the foot and of the line's direction
  Float8 bound;

  Float8 operator()(Float8 s, Float8 per_distance) const {
    if (!any) return 1;
    return emission.likely(emission.folded(across + s * along) * per_distance, bound);
  }
};

/// The place that halves the angle under which a part of the line is seen, from the squared distance of the line and
/// places and distances of its ends: h tan((a + b) / 2), in the form that does not cancel.
Float8 middle_of_angle(Float8 h2, Float8 from, Float8 to_begin, Float8 till, Float8 to_end) {
  const Float8 product = from * till;
  const Mask8 across = product < 0.0f;  // the foot is between the ends
  const Float8 above = choose(across, h2 * (from + till), from * to_end + till * to_begin);
  return above / choose(across, to_begin * to_end + h2 - product, to_begin + to_end);
}

/// The lights' mean and the line, the lights' spread across it included in the distance.
struct Line8 {
  Float8 along, h2, h, per_h, spread, spread2;

  Line8(const Passage8& mean, Float8 deviation, float from)
      : along(mean.along), spread(kOneAxis * deviation), spread2(spread * spread) {
    const Float8 to_begin = from - along;
    h2 = max(max(mean.h2 + spread2, kNearestToBegin2 * (mean.h2 + to_begin * to_begin)), Float8(kTooNear));
    per_h = fast_rsqrt(h2);
    h = h2 * per_h;
  }
  Float8 distance(Float8 s) const {
    const Float8 r2 = h2 + s * s;
    return r2 * fast_rsqrt(r2);
  }
};

/// Henyey-Greenstein relative to isotropic scattering.
Float8 phase_ratio(Float8 g, Float8 cosine) {
  const Float8 g2 = g * g, per_d = fast_rsqrt(1 + g2 - 2 * g * cosine);
  return (1 - g2) * per_d * per_d * per_d;
}

/// A bin as eight places see it.
struct Part8 {
  Float8 angle;         ///< that it is seen under, per length of the segment
  Float8 place, per_r;  ///< in the middle of it, and 1 / the distance there
};
using Parts8 = std::array<Part8, SegmentProfile::kBins>;

/// In a pass of its own: each of the two has enough independent work to hide its latencies behind.
void see_parts(const WideSegment& segment, const Line8& line, Parts8& parts) {
  Float8 to_begin = 0;
  float last = kInfinity;
  for (int i = 0; i < segment.bins; ++i) {
    const WideSegment::Bin& bin = segment.bin[static_cast<std::size_t>(i)];
    Part8& part = parts[static_cast<std::size_t>(i)];
    const Float8 from = bin.begin - line.along, till = bin.end - line.along;
    if (bin.begin != last) to_begin = line.distance(from);
    const Float8 to_end = line.distance(till);
    part.angle = angle_per_length(line.h, line.h2 + from * till, bin.length, segment.length);
    part.place = middle_of_angle(line.h2, from, to_begin, till, to_end);
    part.per_r = fast_rsqrt(line.h2 + part.place * part.place);
    to_begin = to_end;
    last = bin.end;
  }
}

/// Integral over the angle, per length, of scattering x transmittance x phase function x emission, as
/// scattering_angle() in segment_importance.cpp.
Float8 scattered_per_length(const WideSegment& segment, const Line8& line, const Toward8& toward) {
  Parts8 parts;
  see_parts(segment, line, parts);
  Float8 sum = 0;
  for (int i = 0; i < segment.bins; ++i) {
    const WideSegment::Bin& bin = segment.bin[static_cast<std::size_t>(i)];
    const auto& [angle, place, per_r] = parts[static_cast<std::size_t>(i)];
    Float8 weight = bin.scattering * toward(place, per_r);
    if (bin.sigma > 0) {
      const Float8 nearer = min(kNearer * bin.sigma * line.spread2, kNearerAtMost * line.spread);
      const Float8 r = max((line.h2 + place * place) * per_r - nearer, Float8(0.0f));
      weight *= fast_exp_minus(min(r * bin.sigma, Float8(bin.escape)));
    }
    if (segment.g != 0) {
      const Float8 turn = angle * segment.length, narrow = max(1 - kBlur * line.spread2 * per_r * per_r, Float8(0.0f));
      weight *= phase_ratio(segment.g * narrow * (1 - turn * turn * (1.0f / 24)), -place * per_r);
    }
    sum += weight * angle;
  }
  return sum;
}

/// What the clusters send to the segment, per intensity and length; `bound` on the cosine of emission.
Float8 received(const WideSegment& segment, const Places8& at, const Emission8& emission, Float8 bound) {
  const Passage8 mean(at.mean, splat8(segment.d));
  const Line8 line(mean, at.deviation, segment.from);
  const Toward8 toward{emission, any_of(emission.directed), emission.along(mean.foot), emission.along(splat8(segment.d)),
                       bound};
  const Float8 from = segment.from - line.along, till = segment.till - line.along;
  if (segment.importance == MediaStrategy::closest) {
    const Float8 nearest = min(max(Float8(0.0f), from), till), per_r = fast_rsqrt(line.h2 + nearest * nearest);
    return toward(nearest, per_r) * per_r * per_r;
  }
  const Float8 angle = angle_per_length(line.h, line.h2 + from * till, segment.length, segment.length);
  if (segment.bins > 0) return max(scattered_per_length(segment, line, toward), kLeastScattering8 * bound * angle) * line.per_h;
  const Float8 place = middle_of_angle(line.h2, from, line.distance(from), till, line.distance(till));
  return toward(place, fast_rsqrt(line.h2 + place * place)) * angle * line.per_h;
}

}  // namespace

WideSegment WideSegment::from_segment(const Segment& s, double to_unit, Vec3d middle) {
  const auto largest = [](Vec3d v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
  const Vec3d o = s.o * to_unit;
  const double near = std::clamp(dot(middle - o, s.d), s.t0 * to_unit, s.t1 * to_unit);
  const Vec3d p = o + s.d * near;
  const double shrink = std::min(1.0, WideQuery::kFar / std::max(largest(p), 1e-300)), scale = to_unit * shrink,
               per_scale = 1 / std::max(scale, 1e-300);
  const auto place = [&](double t) {
    return static_cast<float>(std::clamp((t * to_unit - near) * shrink, -double(kFar), double(kFar)));
  };

  WideSegment w;
  w.p = to_vec3(p * shrink);
  w.d = to_vec3(s.d);
  w.from = place(s.t0);
  w.till = place(s.t1);
  w.length = std::max(w.till - w.from, kShort);
  w.rounding = static_cast<float>(kPointRounding * shrink * (s.reach * to_unit + std::abs(near)));
  w.g = static_cast<float>(s.g);
  w.importance = s.importance;
  w.to_world = s.importance == MediaStrategy::closest ? s.length * scale * scale : w.length * scale;
  for (const Segment::Bin& b : s.bins) {
    Bin& bin = w.bin[static_cast<std::size_t>(w.bins)];
    bin = {place(b.begin),
           place(b.end),
           0,
           static_cast<float>(b.scattering),
           static_cast<float>(std::min(b.sigma * per_scale, 1e30)),
           static_cast<float>(std::min(b.escape, double(kLargestDepth)))};
    bin.length = bin.end - bin.begin;
    if (bin.length >= kShort) ++w.bins;
  }
  return w;
}

// As for points, bounds decide whether a cluster can contribute at all, and how much is estimated from the mean of its lights:
// their variance across the line adds to the squared distance, the cosines are those at the mean with a share of the bounds.
[[gnu::flatten]] ChildImportance child_importance(const WideNode& node, const WideSegment& segment) {
  const Places8 at(node, segment.p);
  const Vector8 d = splat8(segment.d);
  const Passage8 pass(at.center, d);
  const Float8 from = segment.from - pass.along, till = segment.till - pass.along;
  const Float8 nearest = min(max(Float8(0.0f), from), till), r2 = pass.h2 + nearest * nearest;

  // The sphere around the box, as far as points are known, is seen under theta_u at most.
  const Vector8 &c = at.center, &half = at.half;
  const Float8 reach1 = abs(c.x) + abs(c.y) + abs(c.z) + half.x + half.y + half.z;
  const Float8 seen = sqrt(dot(half, half)) * kSeenWider + (segment.rounding + kDistanceRounding * reach1);
  const Float8 sin_u = min(seen * fast_rsqrt(at_least(r2, kTooNear)), Float8(1.0f));
  const Angle8 theta_u{sqrt(1 - sin_u * sin_u), sin_u};

  // The least angle between the axis and the direction to a point of the segment, less normals' cone and sphere.
  const Emission8 emission(node);
  const Float8 cosine = min(largest_cosine(emission, pass, d, from, till), Float8(1.0f));
  const Float8 cos_beyond = emission.cosine_beyond(Angle8::of(cosine, 1 + kCosineRounding), theta_u, 1.0f);
  const Mask8 outside = r2 > max(seen * seen, Float8(kTooNear));
  const Float8 intensity = load8_upper(node.intensity);
  const Mask8 none = intensity == 0.0f || (outside && emission.none(cos_beyond));
  const Float8 bound = choose(outside && emission.directed, max(cos_beyond, Float8(kLeastLaneFactor)), 1.0f);

  const Float8 importance = intensity * received(segment, at, emission, bound);
  ChildImportance result;
  store8(result.of.data(), choose(none, 0.0f, min(at_least(importance, kLeastImportance), Float8(kLargestImportance))));
  return result;
}

}  // namespace tyndall
