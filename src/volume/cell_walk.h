/// A ray among equal cells.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "volume/affine.h"

namespace tyndall {

/// A line o + t d that is not normalised.
struct LocalLine {
  GridVec o, d;
};

using Cell = std::array<int, 3>;

/// The part of [t0, t1] of the line in [0, n.x] x [0, n.y] x [0, n.z]: begin < end, or nothing of it.
inline std::pair<double, double> clip_to_cells(const LocalLine& line, const Cell& n, double t0, double t1) {
  for (int i = 0; i < 3; ++i) {
    const double size = n[static_cast<std::size_t>(i)];
    if (line.d[i] == 0) {
      if (line.o[i] < 0 || line.o[i] > size) return {0, 0};
      continue;
    }
    const double a = -line.o[i] / line.d[i], b = (size - line.o[i]) / line.d[i];
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return {t0, t1};
}

/// visit(cell, t_begin, t_end) for each unit cell of [0, n) that [t0, t1] passes, in order [Amanatides and Woo 1987].
/// The pieces tile [t0, t1], which must lie in the box: cells are kept as integers, so that rounding of t loses none.
template <typename Visit>
void walk_cells(const LocalLine& line, const Cell& n, double t0, double t1, const Visit& visit) {
  Cell cell;
  for (std::size_t i = 0; i < 3; ++i)
    cell[i] = std::clamp(static_cast<int>(std::floor(line.o.v[i] + t0 * line.d.v[i])), 0, n[i] - 1);
  for (double t = t0; t < t1;) {
    double exit = t1;
    std::size_t axis = 3;
    for (std::size_t i = 0; i < 3; ++i) {
      const double d = line.d.v[i];
      if (d == 0) continue;
      const double at = (cell[i] + (d > 0 ? 1 : 0) - line.o.v[i]) / d;
      if (at < exit) {
        exit = at;
        axis = i;
      }
    }
    exit = std::max(exit, t);
    if (exit > t) visit(cell, t, exit);
    if (axis == 3) return;
    t = exit;
    cell[axis] += line.d.v[axis] > 0 ? 1 : -1;
    if (cell[axis] < 0 || cell[axis] >= n[axis]) return;
  }
}

}  // namespace tyndall
