#include "light/segment_importance.h"

#include "light/emission_angle.h"

namespace tyndall {
namespace {

/// Points on rays are floats: off by this share of their largest coordinate.
constexpr double kPointRounding = 3e-7;
/// As near to the line as this share of the distance from the segment's begin, for lights right there of its length, all lights
/// count the same: rays are not known better, and the integral of 1 / r^2 has to be finite.
constexpr double kNearest = 1e-6;
/// A cluster of radius r blurs the phase function as lights of this variance about its centre, over r^2.
constexpr double kBlur = 0.3;
constexpr double kLargestG = 0.999;

/// The segment as a cluster's centre sees it.
struct View {
  Vec3d aside;        ///< from the centre to the line's closest point
  double along;       ///< where on the ray that is
  double h;           ///< its distance
  double from, till;  ///< the segment's ends, measured from there
  double nearest;     ///< its point closest to the centre, likewise

  View(const Segment& s, Vec3d center) {
    const Vec3d to_center = center - s.o;
    along = dot(to_center, s.d);
    aside = s.d * along - to_center;
    h = length(aside);
    from = s.t0 - along;
    till = s.t1 - along;
    nearest = std::clamp(0.0, from, till);
  }
};

/// Integral over the angle of scattering x transmittance x phase function, relative to isotropic scattering in the bin
/// that scatters most. A blurred Henyey-Greenstein function is one with a smaller mean cosine.
double scattering_angle(const Segment& s, const View& view, double h, double variance) {
  double sum = 0;
  for (const Segment::Bin& bin : s.bins) {
    const double from = bin.begin - view.along, till = bin.end - view.along;
    const double angle = subtended_angle(h, from, till), place = middle_of_angle(h, from, till);
    const double distance = std::sqrt(h * h + place * place);
    const double blurred = s.g * distance / std::sqrt(distance * distance + variance) * (1 - angle * angle / 24);
    sum += angle * bin.scattering * bin.transmittance(distance) * phase_ratio(blurred, -place / distance);
  }
  return sum;
}

}  // namespace

Segment::Segment(const SegmentQuery& q)
    : o(q.o),
      d(Vec3d(q.d) / tyndall::length(Vec3d(q.d))),
      reach(std::max({std::abs(q.o.x), std::abs(q.o.y), std::abs(q.o.z)})),
      t0(q.t0 * tyndall::length(Vec3d(q.d))),
      t1(q.t1 * tyndall::length(Vec3d(q.d))),
      length(std::min(t1 - t0, double(q.reach))),
      g(std::clamp(double(q.profile.g), -kLargestG, kLargestG)),
      importance(q.importance) {
  if (importance != MediaStrategy::product) return;
  const SegmentProfile& p = q.profile;
  const double most = *std::max_element(p.scattering.begin(), p.scattering.end()), per_most = most > 0 ? 1 / most : 0;
  for (std::size_t i = 0; i < SegmentProfile::kBins; ++i) {
    if (!(p.scattering[i] > 0) || !(p.edge[i] < p.edge[i + 1])) continue;
    bins.push_back({p.edge[i], p.edge[i + 1], p.scattering[i] * per_most, p.sigma[i], p.escape[i]});
  }
}

double Segment::lit_length() const {
  if (bins.empty()) return length;
  double lit = 0;
  for (const Bin& bin : bins) {
    const double within = std::min(bin.end, t0 + length) - bin.begin;
    lit += std::max(within, 0.0) * bin.scattering * bin.transmittance(kInfinity);
  }
  return lit;
}

double subtended_angle(double h, double from, double till) {
  if (till == kInfinity) return std::atan2(h, from);
  return std::atan2(h * (till - from), h * h + from * till);
}

// h tan((a + b) / 2), in the form that does not cancel: ends on both sides of the foot, or on one.
double middle_of_angle(double h, double from, double till) {
  const double a = std::sqrt(h * h + from * from);
  if (till == kInfinity) return from < 0 ? h * h / (a - from) : from + a;
  const double b = std::sqrt(h * h + till * till);
  const double middle =
      from * till < 0 ? h * h * (from + till) / (a * b + h * h - from * till) : (from * b + till * a) / (a + b);
  return std::clamp(middle, from, till);
}

double phase_ratio(double g, double cosine) {
  const double d2 = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (d2 * std::sqrt(d2));
}

// cos(s) = (A + s B) / sqrt(h^2 + s^2) with A = axis.aside, B = axis.d is stationary at s = h^2 B / A only, which is a
// maximum for A > 0; so the largest value is there, as near as the segment comes to it, or at an end.
double largest_cosine(Vec3d axis, Vec3d aside, Vec3d d, double from, double till) {
  const double a = dot(axis, aside), b = dot(axis, d), h2 = dot(aside, aside);
  const auto at = [&](double s) {
    if (std::isinf(s)) return s > 0 ? b : -b;
    const double r = std::sqrt(h2 + s * s);
    return r > 0 ? (a + s * b) / r : std::abs(b);
  };
  double best = std::max(at(from), at(till));
  if (a > 0) best = std::max(best, at(std::clamp(h2 * b / a, from, till)));
  return std::clamp(best, -1.0, 1.0);
}

double importance(const ClusterBounds& cluster, bool two_sided, const Segment& s) {
  const Vec3d low(cluster.box.min), high(cluster.box.max);
  const double radius = length((high - low) * 0.5);
  const View view(s, low * 0.5 + high * 0.5);
  const double distance = std::sqrt(view.h * view.h + view.nearest * view.nearest);

  // The sphere around the box is seen under theta_u at most; from inside it nothing is known of directions.
  const double seen = radius + kPointRounding * (largest_coordinate(s.o) + std::abs(view.along + view.nearest));
  double factor = 1;
  if (distance > seen && cluster.cos_o > -1) {
    const Vec3d axis(cluster.axis);
    const auto over = [&](double from, double till) {
      const double ahead = largest_cosine(axis, view.aside, s.d, from, till);
      return two_sided ? std::max(ahead, largest_cosine(-axis, view.aside, s.d, from, till)) : ahead;
    };
    const Angle theta_u = Angle::from_sine(seen / distance);
    factor = emission_factor(cluster, Angle::from_cosine(over(view.from, view.till)), theta_u);
    if (factor == 0) return 0;
    if (s.importance == MediaStrategy::closest) {
      const double there = emission_factor(cluster, Angle::from_cosine(over(view.nearest, view.nearest)), theta_u);
      factor = std::max(there, kLeastFactor);
    }
  }

  const double to_begin = std::sqrt(view.h * view.h + view.from * view.from);
  const double least = std::max(0.5 * radius, kNearest * (to_begin > 0 ? to_begin : s.length));
  if (s.importance == MediaStrategy::closest) {
    const double clamped = std::max(distance, least);
    return factor * cluster.intensity * s.length / (clamped * clamped);
  }
  const double h = std::max(view.h, least), angle = subtended_angle(h, view.from, view.till);
  const double scattered = s.bins.empty() ? angle : scattering_angle(s, view, h, kBlur * radius * radius);
  return factor * cluster.intensity * std::max(scattered, kLeastScattering * angle) / h;
}

double greatest_importance(const ClusterBounds& cluster, bool two_sided, const Segment& s) {
  const double predicted = importance(cluster, two_sided, s);
  const Vec3d low(cluster.box.min), high(cluster.box.max);
  const View view(s, low * 0.5 + high * 0.5);
  const double distance = std::sqrt(view.h * view.h + view.nearest * view.nearest), radius = length((high - low) * 0.5);
  if (!(predicted > 0)) return 0;
  if (!(distance > radius)) return kInfinity;
  const double nearer = distance / (distance - radius);
  return predicted * nearer * nearer;
}

}  // namespace tyndall
