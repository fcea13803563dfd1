#include "transport/vertex/media_directions.h"

#include <cmath>

#include "math/frame.h"
#include "math/simd.h"
#include "math/warp.h"

namespace tyndall {
namespace {

/// Of the directions, at most.
constexpr float kMostGuided = 0.5f;
constexpr float kLeastGuided = 1 / 64.0f;  ///< a smaller share is not worth its time
/// Cones are this wide at least, so that single precision can tell what lies inside.
constexpr float kLeastSine = 0.01f;

}  // namespace

MediaDirections::MediaDirections(const BrightMedia& media, const PointQuery& query, bool emission_sought)
    : size_(media.size()) {
  float all = 0;  // of the importance, whatever side of the surface it is on
  for (std::size_t i = 0; i < size_; i += 8) {
    const Float8 x = load8(&media.x()[i]) - query.p.x, y = load8(&media.y()[i]) - query.p.y,
                 z = load8(&media.z()[i]) - query.p.z;
    const Float8 distance2 = x * x + y * y + z * z, safe2 = max(distance2, Float8(1e-37f));
    const Float8 radius = max(load8(&media.radius()[i]), sqrt(distance2) * kLeastSine), radius2 = radius * radius;
    const Mask8 around = distance2 <= radius2;  // the point is inside
    const Float8 sine2 = min(radius2 / safe2, Float8(1.0f));
    const Float8 height = choose(around, Float8(2.0f), sine2 / (1.0f + sqrt(1.0f - sine2)));
    Float8 above = x * query.n.x + y * query.n.y + z * query.n.z;
    if (query.transmissive) above = abs(above);
    const Float8 cosine = (above + radius) / sqrt(safe2);
    const Float8 facing = choose(around, Float8(1.0f), min(max(cosine, Float8(0.0f)), Float8(1.0f)));
    const Float8 around_it = load8(&media.radiance()[i]) * sine2, importance = around_it * facing;
    all += reduce(around_it);
    total_ += reduce(importance);
    store8(&x_[i], x), store8(&y_[i], y), store8(&z_[i], z);
    store8(&radius2_[i], choose(around, Float8(kInfinity), radius2));
    store8(&density_[i], importance / height);
    store8(&height_[i], height);
  }
  const float light = kPi * total_;
  if (!(light > 0) || !std::isfinite(light)) return;
  // Narrow lobes are sampled better by themselves.
  const float as_light = emission_sought ? kPi * all * media.emission_share() : 0.0f;
  share_ = kMostGuided * query.diffuse * light / (light + as_light + media.in_scattered(query.p));
  if (share_ < kLeastGuided) share_ = 0;
}

Vec3 MediaDirections::sample(float u, Vec2 on_cone) const {
  float left = u * total_;
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    if (density_[i] == 0) continue;
    chosen = i;
    left -= density_[i] * height_[i];
    if (left < 0) break;
  }
  const Vec3 to{x_[chosen], y_[chosen], z_[chosen]};
  const Vec3 axis = length_squared(to) > 0 ? normalize(to) : Vec3{0, 0, 1};
  return Frame::around(axis).to_world(square_to_uniform_cone(on_cone, height_[chosen]));
}

float MediaDirections::pdf(Vec3 w) const {
  float sum = 0;
  for (std::size_t i = 0; i < size_; i += 8) {
    const Float8 x = load8(&x_[i]), y = load8(&y_[i]), z = load8(&z_[i]), radius2 = load8(&radius2_[i]);
    // By the distance at which the direction passes: cosines would lose the bits of narrow cones.
    const Float8 cx = y * w.z - z * w.y, cy = z * w.x - x * w.z, cz = x * w.y - y * w.x;
    const Mask8 ahead = x * w.x + y * w.y + z * w.z > 0.0f || radius2 == Float8(kInfinity);
    const Mask8 passed = cx * cx + cy * cy + cz * cz <= radius2 && ahead;
    sum += reduce(choose(passed, load8(&density_[i]), Float8(0.0f)));
  }
  return sum / (2 * kPi * total_);
}

}  // namespace tyndall
