#include "transport/media_directions.h"

#include <algorithm>
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

/// Cells seen from a point.
struct Cells8 {
  Float8 x, y, z;  ///< from there to the centers
  Float8 distance2, radius;

  Cells8(const BrightMedia& media, std::size_t first, Vec3 p)
      : x(load8(&media.x()[first]) - p.x),
        y(load8(&media.y()[first]) - p.y),
        z(load8(&media.z()[first]) - p.z),
        distance2(x * x + y * y + z * z),
        radius(max(load8(&media.radius()[first]), sqrt(distance2) * kLeastSine)) {}

  Mask8 around() const { return distance2 <= radius * radius; }  ///< the point is inside
  /// 1 - cos of the cone's angle; 2 is the whole sphere.
  Float8 height() const {
    const Float8 sine2 = min(radius * radius / max(distance2, Float8(1e-37f)), Float8(1.0f));
    return choose(around(), Float8(2.0f), sine2 / (1.0f + sqrt(1.0f - sine2)));
  }
};

}  // namespace

MediaDirections::MediaDirections(const BrightMedia& media, const PointQuery& query) : media_(&media), p_(query.p) {
  for (std::size_t i = 0; i < media.size(); i += 8) {
    const Cells8 cells(media, i, p_);
    Float8 above = cells.x * query.n.x + cells.y * query.n.y + cells.z * query.n.z;
    if (query.transmissive) above = abs(above);
    const Float8 cosine = (above + cells.radius) / sqrt(max(cells.distance2, Float8(1e-37f)));
    const Float8 facing = choose(cells.around(), Float8(1.0f), min(max(cosine, Float8(0.0f)), Float8(1.0f)));
    const Float8 seen = min(cells.radius * cells.radius / max(cells.distance2, Float8(1e-37f)), Float8(1.0f));
    const Float8 importance = load8(&media.radiance()[i]) * facing * seen;
    store8(&importance_[i], importance);
    total_ += reduce(importance);
  }
  const float light = kPi * total_;
  if (!(light > 0) || !std::isfinite(light)) return;
  // Narrow lobes are sampled better by themselves.
  share_ = kMostGuided * query.diffuse * light / (light + media.in_scattered(p_));
  if (share_ < kLeastGuided) share_ = 0;
}

Vec3 MediaDirections::sample(float u, Vec2 on_cone) const {
  float left = u * total_;
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < media_->size(); ++i) {
    if (importance_[i] == 0) continue;
    chosen = i;
    left -= importance_[i];
    if (left < 0) break;
  }
  const Vec3 to = Vec3{media_->x()[chosen], media_->y()[chosen], media_->z()[chosen]} - p_;
  alignas(32) std::array<float, 8> heights;
  const std::size_t first = chosen / 8 * 8;
  store8(heights.data(), Cells8(*media_, first, p_).height());
  const Vec3 axis = length_squared(to) > 0 ? normalize(to) : Vec3{0, 0, 1};
  return Frame::around(axis).to_world(square_to_uniform_cone(on_cone, heights[chosen - first]));
}

float MediaDirections::pdf(Vec3 w) const {
  float sum = 0;
  for (std::size_t i = 0; i < media_->size(); i += 8) {
    const Cells8 cells(*media_, i, p_);
    // By the distance at which the direction passes: cosines would lose the bits of narrow cones.
    const Float8 cx = cells.y * w.z - cells.z * w.y, cy = cells.z * w.x - cells.x * w.z, cz = cells.x * w.y - cells.y * w.x;
    const Float8 ahead = cells.x * w.x + cells.y * w.y + cells.z * w.z;
    const Mask8 passed = cx * cx + cy * cy + cz * cz <= cells.radius * cells.radius && ahead > 0.0f;
    const Mask8 inside = cells.around() || passed;
    sum += reduce(choose(inside, load8(&importance_[i]) / cells.height(), Float8(0.0f)));
  }
  return sum / (2 * kPi * total_);
}

}  // namespace tyndall
