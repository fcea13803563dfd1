/// Reads a grid along one ray, again and again in the same brick.
#pragma once

#include <algorithm>
#include <cmath>

#include "volume/brick_grid.h"
#include "volume/grid_ray.h"

namespace tyndall {

/// Of several look-ups.
struct ValueSum {
  float sum = 0, min = kInfinity, max = -kInfinity;
};

/// Where the ray lies on the axes of the brick that is read, and that brick's voxels: what many look-ups there share.
class BrickReader {
 public:
  BrickReader() = default;
  /// To the leaf `node` of `grid`, whose lower corner is `corner`; `ray` in the grid's local coordinates.
  void enter(const BrickGrid& grid, const GridRay& ray, std::uint32_t node, const Index3& corner) {
    bricks_ = &grid.bricks();
    brick_ = grid.node(node).first;
    plane_ = bricks_->plane(brick_, 0);
    line_ = ray.line();
    for (std::size_t i = 0; i < 3; ++i) line_.o[i] -= static_cast<double>(corner[i]);
  }

  /// First channel at t of the ray, clamped to the brick, so that no rounding leaves the range of its majorant.
  float value(double t) const { return bricks_->read(plane_, BrickPoint(line_, t)); }
  /// Of so many points of the ray that are `step` apart, likewise.
  ValueSum sum(double t, double step, int count) const {
    constexpr int kAtOnce = BrickPoints::kCount;
    ValueSum sum;
    for (int i = 0; i < count; i += kAtOnce) {
      const Float8 values = bricks_->read(plane_, BrickPoints(line_, t + i * step, step));
      const Mask8 counted = count_to_8() < static_cast<float>(count - i);
      sum.sum += reduce(choose(counted, values, 0.0f));
      sum.min = std::min(sum.min, hmin(choose(counted, values, sum.min)));
      sum.max = std::max(sum.max, hmax(choose(counted, values, sum.max)));
    }
    return sum;
  }
  /// All channels.
  void values(double t, float* out) const {
    const BrickPoint point(line_, t);
    for (int c = 0; c < bricks_->channels(); ++c) out[c] = bricks_->read(bricks_->plane(brick_, c), point);
  }

  /// t at which the ray crosses the plane of brick coordinate `x` on an axis; infinite if it does not.
  double crossing(int axis, double x) const {
    return line_.d[axis] == 0 ? double{kInfinity} : (x - line_.o[axis]) / line_.d[axis];
  }
  /// The first t beyond this one at which the ray crosses a face between cells; infinite where the brick has one value.
  double next_face(double t) const {
    double first = kInfinity;
    if (plane_.number == 0) return first;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = line_.o[axis] + t * line_.d[axis], ahead = line_.d[axis] > 0 ? 1 : -1;
      double face = ahead > 0 ? std::floor(x) + 1 : std::ceil(x) - 1;
      if (!(crossing(axis, face) > t)) face += ahead;  // on it, but for rounding
      first = std::min(first, crossing(axis, face));
    }
    return std::max(first, std::nextafter(t, double{kInfinity}));
  }
  /// Of the brick, that holds the point at t: bit 0, 1, 2 for the upper half along x, y, z.
  unsigned octant(double t) const {
    constexpr double kMiddle = kBrickCells / 2;
    const auto upper = [&](int i) { return line_.o[i] + t * line_.d[i] >= kMiddle ? 1u : 0u; };
    return upper(0) | upper(1) << 1 | upper(2) << 2;
  }

 private:
  Line line_;
  BrickStore::Plane plane_;  // of the first channel
  const BrickStore* bricks_ = nullptr;
  std::uint32_t brick_ = 0;
};

}  // namespace tyndall
