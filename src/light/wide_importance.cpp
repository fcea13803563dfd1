// The importance of eight clusters at once. Its oracle in plain doubles is tests/support/wide_oracle.
//
// In single precision, so every quantity that a zero hangs on is first moved to the safe side by more than its rounding.
#include "light/wide_node.h"
#include "math/simd.h"

namespace tyndall {
namespace {

/// In cosines, for the receiver's plane and for the emission's reach; the latter has the steps of the stored axis in it.
constexpr float kSlack = 4e-6f;
constexpr float kEmissionSlack = 2e-4f;
/// Relative, for what the sphere around a box subtends.
constexpr float kWider = 1 + 4e-6f;
/// Squared distances below this have lost their bits: the point counts as inside.
constexpr float kTooNear = 1e-33f;
/// Factors never fall below this unless the test says "none": at the rim a cosine may round to 0 or below.
constexpr float kLeastFactor = 1e-3f;
/// What light that may contribute is worth at least.
constexpr float kLeastImportance = 1e-37f;

struct Vector8 {
  Float8 x, y, z;
};
Float8 dot(const Vector8& a, const Vector8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Cosine and sine of an angle at the point, both times the distance to the box's centre: all angles share that factor,
/// so that no square root of it is needed.
struct Angle8 {
  Float8 cos, sin;

  /// Between d and a unit vector along which it has the length `along`. The difference of squares loses up to 2e-3 of
  /// the sine at both ends, which it is given back, since larger sines are on the safe side below.
  static Angle8 of(Float8 along, Float8 d2) { return {along, sqrt(max(d2 * (1 + 4e-6f) - along * along, Float8(0.0f)))}; }
  /// cos(max(this - b, 0)) by the subtraction identity.
  Float8 reduced_cosine(const Angle8& b, Float8 per_distance2) const {
    const Mask8 within = cos >= b.cos || b.sin < 0.0f;  // negative: b is more than half a turn
    return choose(within, 1.0f, min((cos * b.cos + sin * b.sin) * per_distance2, Float8(1.0f)));
  }
};

}  // namespace

// Flattened: the library's small functions must not be called one by one.
[[gnu::flatten]] ChildImportance child_importance(const WideNode& node, const WideQuery& query) {
  const Vector8 d{load8(node.center[0]) - query.p.x, load8(node.center[1]) - query.p.y, load8(node.center[2]) - query.p.z};
  const Vector8 half{load8_upper(node.half[0]), load8_upper(node.half[1]), load8_upper(node.half[2])};
  const Float8 radius2 = dot(half, half), d2 = dot(d, d);
  const Float8 per_distance2 = 1 / max(max(d2, 0.25f * radius2), Float8(kTooNear));  // not beyond half the radius

  // A light without extent at the very point gives nothing that could be used.
  const Float8 intensity = load8_upper(node.intensity);
  const Float8 reach1 = abs(d.x) + abs(d.y) + abs(d.z) + half.x + half.y + half.z;
  Mask8 none = reach1 == 0.0f || intensity == 0.0f;

  // The sphere around the box is seen under theta_u; from inside it nothing is known of directions.
  const Mask8 outside = d2 > max(radius2 * kWider, Float8(kTooNear));
  const Float8 wider2 = radius2 * kWider;
  const Angle8 theta_u{sqrt(max(d2 - wider2, Float8(0.0f))), sqrt(wider2)};

  // How far beyond the normals' cone, as far as the sphere reaches, the point lies.
  const Vector8 axis{load8(node.axis[0]), load8(node.axis[1]), load8(node.axis[2])};
  const Float8 facing = -dot(axis, d) * WideNode::kStep;
  const Mask8 two_sided = load8(node.flags) >= float(WideNode::kTwoSided);
  const Angle8 theta = Angle8::of(choose(two_sided, abs(facing), facing), d2);
  const Float8 cos_o = load8(node.cos_o) * WideNode::kStep, cos_e = load8(node.cos_e) * WideNode::kStep;
  const Float8 sin_o = sqrt((1 - cos_o) * (1 + cos_o));
  const Angle8 theta_ou{cos_o * theta_u.cos - sin_o * theta_u.sin, sin_o * theta_u.cos + cos_o * theta_u.sin};
  const Float8 cos_beyond = theta.reduced_cosine(theta_ou, per_distance2);
  const Mask8 directed = outside && cos_o > -1.0f;
  none = none || (directed && cos_beyond <= cos_e - kEmissionSlack);
  Float8 factor = choose(directed, max(cos_beyond, Float8(kLeastFactor)), 1.0f);

  // The largest cosine at which its light can arrive.
  if (query.surface) {
    const Vector8 n{query.n.x, query.n.y, query.n.z};
    const Float8 height = dot(n, d);
    if (!query.transmissive) {
      const Float8 reach = abs(n.x) * half.x + abs(n.y) * half.y + abs(n.z) * half.z;
      none = none || height + reach <= -kSlack * reach1;
    }
    const Angle8 theta_i = Angle8::of(query.transmissive ? abs(height) : height, d2);
    factor *= choose(outside, max(theta_i.reduced_cosine(theta_u, per_distance2), Float8(kLeastFactor)), 1.0f);
  }
  const Float8 importance = max(factor * intensity * per_distance2, Float8(kLeastImportance));
  ChildImportance result;
  store8(result.of.data(), choose(none, 0.0f, importance));
  return result;
}

}  // namespace tyndall
