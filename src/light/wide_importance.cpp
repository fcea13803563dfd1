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
/// Of the largest cosine that is possible, a cluster is reckoned with at least these shares: on the way out, and here.
constexpr float kShareOfEmission = 0.15f, kShareOfReceived = 0.3f;
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

// The bounds of the paper decide whether a cluster can contribute at all. How much is reckoned from the mean of its
// lights: distance^2 to it plus half their variance, and the cosines there with a share of the bounds. That leaves a
// third to a sixth of the variance of the bounds alone (tests/benchmark). Flattened, since GCC calls the library's
// small functions one by one otherwise.
[[gnu::flatten]] ChildImportance child_importance(const WideNode& node, const WideQuery& query) {
  const Vector8 d{load8(node.center[0]) - query.p.x, load8(node.center[1]) - query.p.y, load8(node.center[2]) - query.p.z};
  const Vector8 half{load8_upper(node.half[0]), load8_upper(node.half[1]), load8_upper(node.half[2])};
  const Float8 radius2 = dot(half, half), d2 = dot(d, d);
  const auto to_mean = [&](Float8 center, Float8 side, const std::int8_t* offset) {
    return center + load8(offset) * WideNode::kMeanStep * side;
  };
  const Vector8 mean{to_mean(d.x, half.x, node.mean[0]), to_mean(d.y, half.y, node.mean[1]),
                     to_mean(d.z, half.z, node.mean[2])};
  const Float8 deviation = load8_upper(node.deviation);
  const Float8 per_distance = 1 / sqrt(max(dot(mean, mean) + 0.5f * deviation * deviation, Float8(kTooNear)));

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
  const Mask8 two_sided = load8(node.flags) >= float(WideNode::kTwoSided);
  const auto facing = [&](const Vector8& to) {
    const Float8 along = -dot(axis, to) * WideNode::kStep;
    return choose(two_sided, abs(along), along);
  };
  const Float8 cos_o = load8(node.cos_o) * WideNode::kStep, cos_e = load8(node.cos_e) * WideNode::kStep;
  const Float8 sin_o = sqrt((1 - cos_o) * (1 + cos_o));
  const Angle8 theta_ou{cos_o * theta_u.cos - sin_o * theta_u.sin, sin_o * theta_u.cos + cos_o * theta_u.sin};
  const Float8 cos_beyond = Angle8::of(facing(d), d2).reduced_cosine(theta_ou, 1 / max(d2, Float8(kTooNear)));
  const Mask8 directed = cos_o > -1.0f;
  none = none || (directed && outside && cos_beyond <= cos_e - kEmissionSlack);

  // The wider the cone, the less its axis says.
  const Float8 bound = choose(outside, max(cos_beyond, Float8(kLeastFactor)), 1.0f);
  const Float8 narrow = 0.5f + 0.5f * cos_o;
  const Float8 likely = narrow * max(facing(mean) * per_distance, Float8(0.0f)) + (0.5f - 0.5f * narrow) * bound;
  Float8 factor = choose(directed, max(likely, kShareOfEmission * bound), 1.0f);

  if (query.surface) {
    const Vector8 n{query.n.x, query.n.y, query.n.z};
    const Float8 reach = abs(n.x) * half.x + abs(n.y) * half.y + abs(n.z) * half.z;
    if (!query.transmissive) none = none || dot(n, d) + reach <= -kSlack * reach1;
    const Float8 along = dot(n, mean), height = query.transmissive ? abs(along) : along;
    const Float8 received = max(height, kShareOfReceived * (height + reach)) * per_distance;
    factor *= min(max(received, Float8(kLeastFactor)), Float8(1.0f));
  }
  const Float8 importance = max(factor * intensity * per_distance * per_distance, Float8(kLeastImportance));
  ChildImportance result;
  store8(result.of.data(), choose(none, 0.0f, importance));
  return result;
}

}  // namespace tyndall
