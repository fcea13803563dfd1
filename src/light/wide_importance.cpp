// The importance of eight clusters at once for a point. Its oracle in plain doubles is in the tests.
#include "light/wide_glossy.h"
#include "light/wide_lanes.h"

namespace tyndall {
namespace {

/// In cosines, for the receiver's plane.
constexpr float kSlack = 4e-6f;
/// Of the largest cosine at which light can arrive, at least this share is used for a cluster.
constexpr float kShareOfReceived = 0.3f;

}  // namespace

// The bounds of the paper decide whether a cluster can contribute at all. How much is estimated from the mean of its lights:
// distance^2 to it plus half their variance, and the cosines there with a share of the bounds; the variance is less than by the
// bounds alone (docs/measurements.md). Flattened, since GCC calls the library's small functions one by one otherwise.
[[gnu::flatten]] ChildImportance child_importance(const WideNode& node, const WideQuery& query) {
  const Places8 at(node, query.p);
  const Vector8& d = at.center;
  const Vector8& half = at.half;
  const Float8 radius2 = dot(half, half), d2 = dot(d, d);
  const Float8 spread2 = dot(at.mean, at.mean) + 0.5f * at.deviation * at.deviation;
  const Float8 per_distance = 1 / sqrt(max(spread2, Float8(kTooNear)));

  // A light without extent at the very point gives nothing that could be used.
  const Float8 intensity = load8_upper(node.intensity);
  const Float8 reach1 = abs(d.x) + abs(d.y) + abs(d.z) + half.x + half.y + half.z;
  Mask8 none = reach1 == 0.0f || intensity == 0.0f;

  // The sphere around the box is seen under theta_u; from inside it nothing is known of directions.
  const Mask8 outside = d2 > max(radius2 * kWider, Float8(kTooNear));
  const Float8 wider2 = radius2 * kWider;
  const Angle8 theta_u{sqrt(max(d2 - wider2, Float8(0.0f))), sqrt(wider2)};

  // How far beyond the normals' cone, as far as the sphere reaches, the point lies.
  const Emission8 emission(node);
  const Angle8 theta = Angle8::of(emission.folded(-emission.along(d)), d2);
  const Float8 cos_beyond = emission.cosine_beyond(theta, theta_u, 1 / max(d2, Float8(kTooNear)));
  none = none || (outside && emission.none(cos_beyond));
  const Float8 bound = choose(outside, max(cos_beyond, Float8(kLeastLaneFactor)), 1.0f);
  const Float8 ahead = emission.folded(-emission.along(at.mean)) * per_distance;
  Float8 factor = emission.likely(ahead, bound);

  const Vector8 toward = at.mean * per_distance;
  const Float8 variance = at.deviation * at.deviation * per_distance * per_distance;
  if (query.surface) {
    const Vector8 n = splat8(query.n);
    const Float8 reach = abs(n.x) * half.x + abs(n.y) * half.y + abs(n.z) * half.z;
    if (!query.transmissive) none = none || dot(n, d) + reach <= -kSlack * reach1;
    const Float8 along = dot(n, at.mean), height = query.transmissive ? abs(along) : along;
    const Float8 received = max(height, kShareOfReceived * (height + reach)) * per_distance;
    const Float8 cosine = min(max(received, Float8(kLeastLaneFactor)), Float8(1.0f));
    if (query.lobe_count == 0) {
      factor *= cosine;
    } else {
      const Float8 height_of_center = dot(n, d);
      const Arrival arrival{toward, variance, cosine, height_of_center + reach, height_of_center - reach};
      Float8 scattered = query.diffuse * cosine;
      for (int i = 0; i < query.lobe_count; ++i) scattered += glossy(query.lobes[i], arrival);
      factor *= scattered;
    }
  } else if (query.g != 0) {
    factor *= phase(query.g, query.forward, toward, variance);
  }
  const Float8 importance = max(factor * intensity * per_distance * per_distance, Float8(kLeastImportance));
  ChildImportance result;
  store8(result.of.data(), choose(none, 0.0f, importance));
  return result;
}

}  // namespace tyndall
