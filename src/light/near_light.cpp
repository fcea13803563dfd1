#include "light/near_light.h"

#include "light/wide_glossy.h"
#include "light/wide_lanes.h"

namespace tyndall {
namespace {

/// How eight boxes are seen from the point.
struct Boxes {
  Places8 at;
  Float8 d2;       ///< squared distance of the nearest places
  Vector8 toward;  ///< to the centers of the spheres around them, unit
  Angle8 radius;   ///< that the spheres are seen under; from inside: half a turn, and more

  Boxes(const WideNode& node, Vec3 p) : at(node, p) {
    const auto beyond = [](Float8 center, Float8 half) { return max(abs(center) - half, Float8(0.0f)); };
    const Vector8 gap{beyond(at.center.x, at.half.x), beyond(at.center.y, at.half.y), beyond(at.center.z, at.half.z)};
    d2 = dot(gap, gap);
    const Float8 center2 = max(dot(at.center, at.center), Float8(kTooNear)), per_distance = 1 / sqrt(center2);
    toward = at.center * per_distance;
    const Float8 sine = sqrt(dot(at.half, at.half)) * per_distance;
    radius = {choose(sine < 1.0f, sqrt(max(1 - sine * sine, Float8(0.0f))), -1.0f), choose(sine < 1.0f, sine, 0.0f)};
  }

  /// The directions next to `axis` in which the spheres are seen.
  Vector8 next_to(const Vector8& axis) const {
    const Float8 cosine = dot(axis, toward), sine = sqrt(max(1 - cosine * cosine, Float8(kTooNear)));
    const Float8 along = radius.sin / sine, rest = radius.cos - cosine * along;
    const Mask8 within = cosine >= radius.cos;
    return {choose(within, axis.x, toward.x * rest + axis.x * along), choose(within, axis.y, toward.y * rest + axis.y * along),
            choose(within, axis.z, toward.z * rest + axis.z * along)};
  }
};

/// Where a lobe mirrors the view from, which it scatters most of; of transmission, to the centers.
Vector8 best_direction(const QueryLobe& lobe, Vec3 n, const Boxes& boxes) {
  if (lobe.eta != 1) return boxes.toward;
  return boxes.next_to(splat8(n * lobe.cos_o - lobe.tangent * lobe.sin_o));
}

Float8 scattered_by_surface(const WideQuery& query, const Boxes& boxes) {
  const Vector8 n = splat8(query.n), &half = boxes.at.half;
  const Float8 height = dot(n, boxes.at.center), reach = abs(n.x) * half.x + abs(n.y) * half.y + abs(n.z) * half.z;
  const Float8 highest = max((query.transmissive ? abs(height) : height) + reach, Float8(0.0f));
  Float8 scattered = query.diffuse * min(highest / sqrt(max(boxes.d2, Float8(kTooNear))), Float8(1.0f));
  for (int i = 0; i < query.lobe_count; ++i) {
    const Vector8 best = best_direction(query.lobes[i], query.n, boxes);
    const Float8 cosine = min(max(abs(dot(n, best)), Float8(kLeastLaneFactor)), Float8(1.0f));
    scattered += glossy(query.lobes[i], {best, 0, cosine, height + reach, height - reach});
  }
  return scattered;
}

Float8 scattered_by_medium(const WideQuery& query, const Boxes& boxes) {
  if (query.g == 0) return 1;
  const Vec3 peak = query.g > 0 ? query.forward : -query.forward;
  return phase(std::abs(query.g), peak, boxes.next_to(splat8(peak)), 0);
}

}  // namespace

[[gnu::flatten]] NearestLight nearest_light(const WideNode& node, const WideQuery& query) {
  const Boxes boxes(node, query.p);
  const Float8 count = load8(node.count),
               scattered = query.surface ? scattered_by_surface(query, boxes) : scattered_by_medium(query, boxes);
  const Float8 intensity = load8_upper(node.intensity) * (1 + load8_upper(node.intensity_cv2));
  const Float8 brings = scattered * intensity / (max(count, Float8(1.0f)) * max(boxes.d2, Float8(kTooNear)));
  NearestLight result;
  store8(result.of.data(), choose(count <= 1.0f, 0.0f, choose(boxes.d2 <= kTooNear, kInfinity, brings)));
  return result;
}

}  // namespace tyndall
