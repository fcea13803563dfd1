/// The importance of the wide tree's clusters in plain double precision, one at a time.
#pragma once

#include "light/wide_segment.h"

namespace tyndall::test {

struct OracleImportance {
  double value = 0;   ///< in units of intensity / length^2, as child_importance() with the scale taken in
  double upper = 0;   ///< without the cosines: the unit of rounding
  double margin = 1;  ///< how far, in cosines, the tests for "none" were from deciding otherwise
};

/// pi f |cos| for a lobe as wide as the facets' slopes and the cluster's spread make it: D G / 4 and so on, written out.
inline double oracle_lobe(const QueryLobe& lobe, Vec3d toward, double cosine, double variance) {
  const double at = lobe.slope2_t + lobe.spread_t * variance, ab = lobe.slope2_b + lobe.spread_b * variance;
  const Vec3d h{lobe.sin_o + lobe.eta * dot(Vec3d(lobe.tangent), toward), lobe.eta * dot(Vec3d(lobe.bitangent), toward),
                lobe.cos_o + (lobe.eta != 1 ? -lobe.eta : 1.0) * cosine};
  const Vec3d m = normalize(h);
  const double e = m.x * m.x / at + m.y * m.y / ab + m.z * m.z;
  const double D = 1 / (std::sqrt(at * ab) * e * e);  // pi times the density
  const double a2 = 0.5 * (lobe.slope2_t + lobe.slope2_b);
  const auto lambda = [&](double z) { return std::sqrt(a2 * (1 - z * z) / (z * z) + 1); };  // 1 + 2 Lambda
  return lobe.scale * D / ((lambda(lobe.cos_o) + lambda(cosine)) * lobe.cos_o);
}

inline OracleImportance oracle_importance(const Cluster& c, const WideQuery& q) {
  const Vec3d low(c.box.min), high(c.box.max), half = (high - low) * 0.5, d = (low + high) * 0.5 - Vec3d(q.p), n(q.n);
  const double radius = length(half), distance = length(d);
  OracleImportance result;
  if (radius == 0 && distance == 0) return result;
  const Vec3d mean = c.mean - Vec3d(q.p);
  const double reckoned = std::sqrt(dot(mean, mean) + 0.5 * c.variance);
  result.upper = c.intensity / (reckoned * reckoned);

  double factor = 1;
  if (!c.normals.full()) {
    const Vec3d axis = normalize(Vec3d(c.normals.axis));
    double bound = 1;
    if (distance > radius) {
      double theta = std::acos(std::clamp(-dot(axis, d) / distance, -1.0, 1.0));
      if (c.two_sided) theta = std::min(theta, kPi - theta);
      bound = std::cos(std::max(theta - c.normals.theta - std::asin(radius / distance), 0.0));
      result.margin = std::min(result.margin, std::abs(bound - std::cos(double(c.theta_e))));
      if (bound <= std::cos(double(c.theta_e))) return result;
      bound = std::max(bound, 1e-3);
    }
    double ahead = -dot(axis, mean) / reckoned;
    if (c.two_sided) ahead = std::abs(ahead);
    const double narrow = 0.5 * (1 + std::cos(double(c.normals.theta)));
    factor *= std::max(narrow * std::max(ahead, 0.0) + 0.5 * (1 - narrow) * bound, 0.15 * bound);
  }
  if (q.surface) {
    const double reach = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
    if (!q.transmissive) {
      result.margin = std::min(result.margin, std::abs(dot(n, d) + reach) / (distance + radius));
      if (dot(n, d) + reach <= 0) return result;
    }
    const double height = q.transmissive ? std::abs(dot(n, mean)) : dot(n, mean);
    const double cosine = std::clamp(std::max(height, 0.3 * (height + reach)) / reckoned, 1e-3, 1.0);
    double scattered = q.lobe_count == 0 ? cosine : q.diffuse * cosine;
    for (int i = 0; i < q.lobe_count; ++i) {
      const bool above = dot(n, d) + reach > 0, below = dot(n, d) - reach < 0;
      if (q.lobes[i].eta != 1 ? below : above)
        scattered += oracle_lobe(q.lobes[i], mean / reckoned, cosine, c.variance / (reckoned * reckoned));
    }
    factor *= scattered;
  } else if (q.g != 0) {
    const double g = q.g / std::sqrt(1 + c.variance / (reckoned * reckoned)), x = dot(Vec3d(q.forward), mean) / reckoned;
    factor *= (1 - g * g) / std::pow(1 + g * g - 2 * g * x, 1.5);
  }
  result.value = factor * result.upper;
  return result;
}

/// A segment as the oracle takes it: that of the wide tree, in doubles.
struct OracleSegment {
  Vec3d p, d;
  double from, till;

  explicit OracleSegment(const WideSegment& s) : p(s.p), d(s.d), from(s.from), till(s.till) {}
};

/// The wide tree's reckoning of the emission: the cosine at the lights' mean, with a share of the bound.
inline double oracle_emission(const Cluster& c, double ahead, double bound) {
  if (c.normals.full()) return 1;
  if (c.two_sided) ahead = std::abs(ahead);
  const double narrow = 0.5 * (1 + std::cos(double(c.normals.theta)));
  return std::max(narrow * std::max(ahead, 0.0) + 0.5 * (1 - narrow) * bound, 0.15 * bound);
}

/// Largest cosine of emission toward any point of the segment; 0: none. `margin` as in OracleImportance.
inline double oracle_bound(const Cluster& c, const WideSegment& w, double& margin) {
  const OracleSegment s(w);
  const Vec3d low(c.box.min), high(c.box.max), half = (high - low) * 0.5, to = (low + high) * 0.5 - s.p;
  const double along = dot(to, s.d), from = s.from - along, till = s.till - along;
  const Vec3d foot = s.d * along - to;
  const double nearest = std::clamp(0.0, from, till), distance = std::sqrt(dot(foot, foot) + nearest * nearest);
  const double reach1 = std::abs(to.x) + std::abs(to.y) + std::abs(to.z) + half.x + half.y + half.z;
  const double seen = length(half) + w.rounding + 5e-7 * reach1;
  margin = std::abs(distance / seen - 1);
  if (distance <= seen || c.normals.full()) return 1;
  const Vec3d axis = normalize(Vec3d(c.normals.axis));
  double cosine = largest_cosine(axis, foot, s.d, from, till);
  if (c.two_sided) cosine = std::max(cosine, largest_cosine(-axis, foot, s.d, from, till));
  const double theta = std::acos(cosine), theta_u = std::asin(seen / distance);
  const double bound = std::cos(std::max(theta - c.normals.theta - theta_u, 0.0));
  margin = std::min(margin, std::abs(bound - std::cos(double(c.theta_e))));
  return bound <= std::cos(double(c.theta_e)) ? 0 : std::max(bound, 1e-3);
}

/// `upper`: without emission, phase function and transmittance.
inline OracleImportance oracle_importance(const Cluster& c, const WideSegment& w) {
  OracleImportance result;
  const double bound = oracle_bound(c, w, result.margin);
  const OracleSegment s(w);
  const Vec3d to = c.mean - s.p;
  const double along = dot(to, s.d), from = s.from - along, till = s.till - along, spread = c.variance / 3;
  const Vec3d foot = s.d * along - to, axis = normalize(Vec3d(c.normals.axis));
  const double foot2 = dot(foot, foot), h = std::sqrt(std::max(foot2 + spread, 1e-12 * (foot2 + from * from)));
  if (foot2 < 1e-6 * dot(to, to)) result.margin = 0;  // which way the line passes is lost in rounding
  const auto emission = [&](double place) {
    return oracle_emission(c, (dot(axis, foot) + place * dot(axis, s.d)) / std::hypot(h, place), bound);
  };
  const double angle = subtended_angle(h, from, till);
  double value = 0;
  if (w.importance == MediaStrategy::closest) {
    const double nearest = std::clamp(0.0, from, till);
    result.upper = c.intensity / (h * h + nearest * nearest);
    value = result.upper * emission(nearest);
  } else if (w.bins == 0) {
    result.upper = c.intensity * angle / h / w.length;
    value = result.upper * emission(middle_of_angle(h, from, till));
  } else {
    result.upper = c.intensity * angle / h / w.length;
    double sum = 0;
    for (int i = 0; i < w.bins; ++i) {
      const WideSegment::Bin& bin = w.bin[static_cast<std::size_t>(i)];
      const double a = bin.begin - along, b = bin.end - along, part = subtended_angle(h, a, b);
      const double place = middle_of_angle(h, a, b), r = std::hypot(h, place);
      const double blur = std::max(1 - 3 * spread / (r * r), 0.0) * (1 - part * part / 24);
      const double through = std::max(r - std::min(3 * bin.sigma * spread, 2 * std::sqrt(spread)), 0.0);
      const double T = std::exp(-std::min(bin.sigma * through, double(bin.escape)));
      sum += part * bin.scattering * T * phase_ratio(w.g * blur, -place / r) * emission(place);
    }
    value = c.intensity / h / w.length * std::max(sum, kLeastScattering * bound * angle);
  }
  result.value = bound > 0 ? value : 0;
  return result;
}

}  // namespace tyndall::test
