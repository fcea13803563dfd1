/// A ray among the nodes of a BrickGrid.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "volume/brick_grid.h"

namespace tyndall {

/// Steps from node to node through a grid's tree, in local coordinates and double precision; t is that of the world ray.
///
/// The position is kept as integer cell coordinates which cross exactly one face a step, so that rays in faces, along
/// axes, from corners and to infinity end after at most about one step for each face passed, whatever the rounding of
/// t. A direction of 0 or -0 along an axis never reaches a face of it.
class GridRay {
 public:
  GridRay() = default;
  GridRay(const Affine& to_local, const Ray& ray) : o_(to_local.point(ray.o)), d_(to_local.vector(ray.d)) {
    for (int i = 0; i < 3; ++i) {
      // Slower than this it reaches no face either, and 1 / d would overflow.
      if (std::abs(d_[i]) < 1e-200) d_[i] = 0;
      const double d = d_[i];
      forward_[static_cast<std::size_t>(i)] = d > 0 ? -1 : 0;
      inverse_[i] = d == 0 ? 0 : 1 / d;
      never_[i] = d == 0 ? kInf : 0;
    }
  }

  /// For reading the grid along the ray.
  Line line() const { return {{o_[0], o_[1], o_[2], 0}, {d_[0], d_[1], d_[2], 0}}; }
  GridVec at(double t) const { return {{o_[0] + t * d_[0], o_[1] + t * d_[1], o_[2] + t * d_[2]}}; }

  /// Cells a unit of t.
  double speed() const { return std::sqrt(d_[0] * d_[0] + d_[1] * d_[1] + d_[2] * d_[2]); }

  /// The part of [t0, t1] inside `box`; (infinity, -infinity) if there is none.
  std::pair<double, double> clip(const Box3d& box, double t0, double t1) const {
    double begin = t0, end = box.empty() ? -kInf : t1;
    for (int i = 0; i < 3; ++i) {
      if (d_[i] == 0) {
        if (!(o_[i] >= box.lo[i] && o_[i] <= box.hi[i])) end = -kInf;
        continue;
      }
      const double a = (box.lo[i] - o_[i]) * inverse_[i], b = (box.hi[i] - o_[i]) * inverse_[i];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    return begin < end ? std::pair{begin, end} : std::pair{kInf, -kInf};
  }

  /// Go to the root's cell at t; cells outside `box` are never entered.
  void enter(const BrickGrid& grid, const Box3d& box, double t) {
    const GridVec p = at(t);
    for (std::size_t i = 0; i < 3; ++i) {
      first_[i] = static_cast<std::int64_t>(std::floor(box.lo.v[i]));
      last_[i] = std::max(first_[i], static_cast<std::int64_t>(std::ceil(box.hi.v[i])) - 1);
      cell_[i] = std::clamp(static_cast<std::int64_t>(p.v[i]), first_[i], last_[i]);
    }
    level_ = grid.root_level();
    stack_[level_] = grid.root();
  }
  /// Twice the faces of bricks that a line can pass.
  std::uint64_t most_steps() const {
    std::uint64_t faces = 0;
    for (std::size_t i = 0; i < 3; ++i) faces += static_cast<std::uint64_t>((last_[i] - first_[i]) / 8 + 2);
    return 2 * faces;
  }

  std::uint32_t node() const { return stack_[level_]; }  ///< kNone where it is empty
  int level() const { return level_; }
  Index3 corner() const {
    const std::int64_t mask = ~(BrickGrid::extent(level_) - 1);
    return {cell_[0] & mask, cell_[1] & mask, cell_[2] & mask};
  }

  /// To the child of the node, which must not be a leaf.
  void descend(const BrickGrid& grid) {
    const std::uint32_t child = grid.child(stack_[level_], level_, cell_);
    stack_[--level_] = child;
  }

  /// Where the ray leaves the node, not before t; remembers through which face.
  double exit(double t) {
    const std::int64_t size = BrickGrid::extent(level_);
    double at[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t face = (cell_[i] & ~(size - 1)) + (forward_[i] & size);
      at[i] = (static_cast<double>(face) - o_.v[i]) * inverse_.v[i] + never_.v[i];
    }
    exit_axis_ = at[0] < at[1] ? 0 : 1;
    if (at[2] < at[exit_axis_]) exit_axis_ = 2;
    return std::max(at[exit_axis_], t);
  }

  /// Cross the face found by exit() at t, up to the deepest node that holds the new cell too. The coordinates of the
  /// other axes follow the ray but stay in the old node's range. False: the ray has left the box.
  bool leave(const BrickGrid& grid, double t) {
    const std::int64_t size = BrickGrid::extent(level_);
    const Index3 lo = corner();
    const GridVec p = at(t);
    std::int64_t moved = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t inside =
          std::clamp(static_cast<std::int64_t>(p.v[i]), std::max(lo[i], first_[i]), std::min(lo[i] + size - 1, last_[i]));
      const std::int64_t beyond = forward_[i] ? lo[i] + size : lo[i] - 1;
      const std::int64_t next = i == exit_axis_ ? beyond : inside;
      moved |= next ^ cell_[i];
      cell_[i] = next;
    }
    if (cell_[exit_axis_] < first_[exit_axis_] || cell_[exit_axis_] > last_[exit_axis_]) return false;
    const int root = grid.root_level();
    while (level_ < root && moved >= BrickGrid::extent(level_)) ++level_;
    return true;
  }

 private:
  static constexpr double kInf = std::numeric_limits<double>::infinity();

  GridVec o_, d_;
  GridVec inverse_, never_;  // 1 / d and 0, or 0 and infinity where d is 0
  Index3 forward_{};         // all bits set where d > 0
  Index3 cell_{}, first_{}, last_{};
  std::size_t exit_axis_ = 0;
  int level_ = 0;
  std::uint32_t stack_[BrickGrid::kMaxLevel + 1];  // ancestors of cell_ from the root down to level_
};

}  // namespace tyndall
