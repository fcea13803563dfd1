/// What the importances of eight clusters for points and for segments have in common. Single precision, so every
/// quantity that a zero hangs on is first moved to the safe side by more than its rounding.
#pragma once

#include "light/wide_node.h"
#include "math/simd.h"

namespace tyndall {

/// In cosines, for the emission's reach: it has the steps of the stored axis in it.
inline constexpr float kEmissionSlack = 2e-4f;
/// Relative, for what the sphere around a box subtends.
inline constexpr float kWider = 1 + 4e-6f;
/// Squared distances below this have lost their bits: the point counts as inside.
inline constexpr float kTooNear = 1e-33f;
/// Of the largest cosine of emission that is possible, at least this share is used for a cluster.
inline constexpr float kShareOfEmission = 0.15f;
/// Factors never fall below this unless the test says "none": at the rim a cosine may round to 0 or below.
inline constexpr float kLeastLaneFactor = 1e-3f;
/// Least value for light that may contribute.
inline constexpr float kLeastImportance = 1e-37f;

struct Vector8 {
  Float8 x, y, z;
};
inline Float8 dot(const Vector8& a, const Vector8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector8 operator-(const Vector8& a, const Vector8& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector8 operator*(const Vector8& a, Float8 s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vector8 splat8(Vec3 v) { return {v.x, v.y, v.z}; }

/// Cosine and sine of an angle, both times a length: angles at one point share it, so that no square root is needed.
struct Angle8 {
  Float8 cos, sin;

  /// Between d and a unit vector along which it has the length `along`. The difference of squares loses up to 2e-3 of
  /// the sine at both ends, which it is given back, since larger sines are on the safe side below.
  static Angle8 of(Float8 along, Float8 d2) { return {along, sqrt(max(d2 * (1 + 4e-6f) - along * along, Float8(0.0f)))}; }
  /// cos(max(this - b, 0)) by the subtraction identity.
  Float8 reduced_cosine(const Angle8& b, Float8 per_length2) const {
    const Mask8 within = cos >= b.cos || b.sin < 0.0f;  // negative: b is more than half a turn
    return choose(within, 1.0f, min((cos * b.cos + sin * b.sin) * per_length2, Float8(1.0f)));
  }
};

/// Where the children are, as seen from `origin`.
struct Places8 {
  Vector8 center, half;  ///< of the boxes
  Vector8 mean;          ///< of the lights
  Float8 deviation;      ///< of their positions

  Places8(const WideNode& node, Vec3 origin)
      : center{load8(node.center[0]) - origin.x, load8(node.center[1]) - origin.y, load8(node.center[2]) - origin.z},
        half{load8_upper(node.half[0]), load8_upper(node.half[1]), load8_upper(node.half[2])},
        mean{offset(center.x, half.x, node.mean[0]), offset(center.y, half.y, node.mean[1]),
             offset(center.z, half.z, node.mean[2])},
        deviation(load8_upper(node.deviation)) {}

 private:
  static Float8 offset(Float8 center, Float8 side, const std::int8_t* steps) {
    return center + load8(steps) * WideNode::kMeanStep * side;
  }
};

/// Directions into which the children's lights emit.
struct Emission8 {
  Vector8 axis;  ///< in steps
  Mask8 two_sided, directed;
  Float8 cos_o, cos_e;

  explicit Emission8(const WideNode& node)
      : axis{load8(node.axis[0]), load8(node.axis[1]), load8(node.axis[2])},
        two_sided(load8(node.flags) >= float(WideNode::kTwoSided)),
        cos_o(load8(node.cos_o) * WideNode::kStep),
        cos_e(load8(node.cos_e) * WideNode::kStep) {
    directed = cos_o > -1.0f;
  }
  /// The component along the axis of a vector that leaves the lights; of two-sided ones along either axis.
  Float8 along(const Vector8& v) const { return dot(axis, v) * WideNode::kStep; }
  Float8 folded(Float8 component) const { return choose(two_sided, abs(component), component); }
  /// Cosine of what is left of theta when the normals' cone and what the cluster subtends are taken off.
  Float8 cosine_beyond(const Angle8& theta, const Angle8& theta_u, Float8 per_length2) const {
    const Float8 sin_o = sqrt((1 - cos_o) * (1 + cos_o));
    const Angle8 theta_ou{cos_o * theta_u.cos - sin_o * theta_u.sin, sin_o * theta_u.cos + cos_o * theta_u.sin};
    return theta.reduced_cosine(theta_ou, per_length2);
  }
  /// No light goes there.
  Mask8 none(Float8 cosine_beyond) const { return directed && cosine_beyond <= cos_e - kEmissionSlack; }
  /// What is used, from the cosine `ahead` at the lights' mean and the bound: the wider the cone, the less its
  /// axis says.
  Float8 likely(Float8 ahead, Float8 bound) const {
    const Float8 narrow = 0.5f + 0.5f * cos_o;
    const Float8 mixed = narrow * max(ahead, Float8(0.0f)) + (0.5f - 0.5f * narrow) * bound;
    return choose(directed, max(mixed, kShareOfEmission * bound), 1.0f);
  }
};

}  // namespace tyndall
