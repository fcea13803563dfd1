/// One medium along one ray: pieces of constant majorant, and coefficients at points of them.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "volume/medium_data.h"
#include "volume/phase_mix.h"

namespace tyndall {

/// What the pieces must bound. `majorant`: rate >= sigma_t. `residual`: rate >= |sigma_t - control|.
enum class WalkMode { majorant, residual };

/// A node of the grid's tree is split further only while rate * length exceeds this: below it, walking the children
/// costs more than the look-ups it would save.
inline constexpr float kRefineDepth = 1.0f;

/// Sigma and emission at a point, in 1/world unit and radiance/world unit.
struct LocalOptics {
  Rgb sigma_a, sigma_s;
  Rgb emission;  ///< sigma_a * Le; filled only on request
};

/// Tiles [t0, t1] of a ray with pieces, in order: next() moves to the first or next one, then t(), t_end(), rate()
/// and control() describe it and optics_at() reads inside it. Positions are in double precision: t is preserved by the
/// map to index space, and a far origin or a huge grid costs no accuracy. Never allocates.
///
/// The position is kept as integer cell coordinates which advance across exactly one face a step, so that rays in
/// faces, along axes, from corners and to infinity end after at most one step for each face passed, whatever the
/// rounding of t. Look-ups inside a brick are clamped to it, so that no rounding leaves the range of its majorant.
template <WalkMode mode>
class MediumWalk {
 public:
  MediumWalk(const MediumData& medium, const Ray& ray, double t0, double t1) : medium_(&medium), ray_(&ray), t_(t0), t_end_(t0), limit_(t1) {
    if (medium.kind == MediumData::Kind::homogeneous) {
      inside_end_ = t1;
      return;
    }
    const Vec3d o = medium.density.to_local.point(ray.o), d = medium.density.to_local.vector(ray.d);
    for (int i = 0; i < 3; ++i) {
      o_[i] = o[i];
      d_[i] = d[i];
      inverse_[i] = 1 / d[i];
    }
    clip_to(medium.clip);
    if (medium.kind == MediumData::Kind::grid && inside_begin_ < inside_end_) enter();
  }

  /// Move to the next piece; false at the end.
  bool next() {
    t_ = t_end_;
    if (t_ >= limit_) return false;
    ++steps_;
    if (t_ < inside_begin_) return pass(std::min(inside_begin_, limit_));
    if (t_ >= inside_end_) return pass(limit_);
    if (steps_ > max_steps_) return pass(limit_);
    switch (medium_->kind) {
      case MediumData::Kind::homogeneous: return uniform(medium_->optics.sigma_a + medium_->optics.sigma_s, limit_, Rgb{1.0f}, 0);
      case MediumData::Kind::cloud: return next_cloud();
      case MediumData::Kind::grid: break;
    }
    return next_node();
  }

  double t() const { return t_; }
  double t_end() const { return t_end_; }
  float rate() const { return rate_; }
  Rgb control() const { return control_; }  ///< sigma_t that is subtracted; residual mode only
  std::uint64_t steps() const { return steps_; }
  bool capped() const { return steps_ > max_steps_; }  ///< the safety limit of steps ended the walk: a defect

  /// Inside the current piece, of non-zero rate or control.
  LocalOptics optics_at(double t, bool with_emission) {
    LocalOptics result;
    switch (medium_->kind) {
      case MediumData::Kind::homogeneous:
        result.sigma_a = medium_->optics.sigma_a;
        result.sigma_s = medium_->optics.sigma_s;
        break;
      case MediumData::Kind::cloud: {
        const Vec3 p{static_cast<float>(o_[0] + t * d_[0]), static_cast<float>(o_[1] + t * d_[1]), static_cast<float>(o_[2] + t * d_[2])};
        const float density = cloud_density(medium_->cloud, p);
        result.sigma_a = medium_->optics.sigma_a * density;
        result.sigma_s = medium_->optics.sigma_s * density;
        break;
      }
      case MediumData::Kind::grid: read_grid(t, result); break;
    }
    if (with_emission && medium_->emission.kind != EmissionField::Kind::none && !is_black(result.sigma_a))
      result.emission = result.sigma_a * medium_->emission.at(ray_->o + ray_->d * static_cast<float>(t));
    last_sigma_s_ = result.sigma_s;
    return result;
  }
  /// sigma_t minus control; residual mode.
  Rgb excess_at(double t) {
    const LocalOptics optics = optics_at(t, false);
    return optics.sigma_a + optics.sigma_s - control_;
  }
  /// The lobe of the last optics_at().
  void add_phase(PhaseMix& phase) const { phase.add(last_sigma_s_, medium_->optics.g); }

 private:
  static constexpr double kInf = std::numeric_limits<double>::infinity();

  bool pass(double until) {
    t_end_ = until;
    rate_ = 0;
    control_ = {};
    node_ = BrickGrid::kNone;
    return true;
  }

  bool uniform(Rgb sigma_t, double until, Rgb control, float spread) {
    t_end_ = until;
    if constexpr (mode == WalkMode::majorant) {
      rate_ = max_component(sigma_t);
    } else {
      rate_ = spread * max_component(sigma_t);
      control_ = sigma_t * control;
    }
    return true;
  }

  bool next_cloud() {
    const float mean = medium_->cloud_mean;
    return uniform(medium_->optics.sigma_a + medium_->optics.sigma_s, std::min(inside_end_, limit_), Rgb{mean}, std::max(mean, 1 - mean));
  }

  /// The part of the ray in the box; none when begin >= end.
  void clip_to(const Box3d& box) {
    inside_begin_ = t_;
    inside_end_ = box.empty() ? -kInf : limit_;
    for (int i = 0; i < 3; ++i) {
      if (d_[i] == 0) {
        if (!(o_[i] >= box.lo[i] && o_[i] <= box.hi[i])) inside_end_ = -kInf;
        continue;
      }
      const double a = (box.lo[i] - o_[i]) * inverse_[i], b = (box.hi[i] - o_[i]) * inverse_[i];
      inside_begin_ = std::max(inside_begin_, std::min(a, b));
      inside_end_ = std::min(inside_end_, std::max(a, b));
    }
    if (!(inside_begin_ < inside_end_)) inside_end_ = inside_begin_ = -kInf;
  }

  void enter() {
    const Box3d& box = medium_->clip;
    for (int i = 0; i < 3; ++i) {
      first_[i] = static_cast<std::int64_t>(std::floor(box.lo[i]));
      last_[i] = std::max(first_[i], static_cast<std::int64_t>(std::ceil(box.hi[i])) - 1);
      cell_[i] = std::clamp(static_cast<std::int64_t>(std::floor(o_[i] + inside_begin_ * d_[i])), first_[i], last_[i]);
    }
    level_ = medium_->density.grid.root_level();
    stack_[level_] = medium_->density.grid.root();
    // Twice the faces of bricks that a line can pass.
    for (int i = 0; i < 3; ++i) max_steps_ += static_cast<std::uint64_t>((last_[i] - first_[i]) / 4 + 2);
  }

  /// The node that holds cell_, found from the deepest ancestor it shares with the last one; splits while that pays.
  bool next_node() {
    const BrickGrid& grid = medium_->density.grid;
    std::uint32_t node = stack_[level_];
    for (;;) {
      const double exit = exit_of(level_);
      if (node == BrickGrid::kNone) {
        pass(exit);
        break;
      }
      set_rate(grid.ranges(node));
      if (level_ == 0 || grid.node(node).mask == 0 || rate_ * (std::min(exit, inside_end_) - t_) <= kRefineDepth) {
        t_end_ = exit;
        node_ = node;
        break;
      }
      const Index3 cell{cell_[0], cell_[1], cell_[2]};
      node = grid.child(node, level_--, cell);
      stack_[level_] = node;
    }
    node_level_ = level_;
    for (int i = 0; i < 3; ++i) node_lo_[i] = cell_[i] & ~(BrickGrid::extent(level_) - 1);
    if (t_end_ < inside_end_)
      leave();
    else
      t_end_ = inside_end_;
    return true;
  }

  /// Where the ray leaves the node of `level` around cell_; remembers through which axis.
  double exit_of(int level) {
    const std::int64_t size = BrickGrid::extent(level);
    double exit = kInf;
    for (int i = 0; i < 3; ++i) {
      if (d_[i] == 0) continue;
      const std::int64_t lo = cell_[i] & ~(size - 1);
      const double t = (static_cast<double>(d_[i] > 0 ? lo + size : lo) - o_[i]) * inverse_[i];
      if (t < exit) {
        exit = t;
        exit_axis_ = i;
      }
    }
    return std::max(exit, t_);
  }

  /// Move cell_ across the exit face; the other two coordinates follow the ray but stay in the node's range.
  void leave() {
    const std::int64_t size = BrickGrid::extent(level_);
    const Index3 before{cell_[0], cell_[1], cell_[2]};
    bool outside = false;
    for (int i = 0; i < 3; ++i) {
      const std::int64_t lo = node_lo_[i];
      if (i == exit_axis_) {
        cell_[i] = d_[i] > 0 ? lo + size : lo - 1;
        outside = cell_[i] < first_[i] || cell_[i] > last_[i];
      } else {
        const auto at = static_cast<std::int64_t>(std::floor(o_[i] + t_end_ * d_[i]));
        cell_[i] = std::clamp(at, std::max(lo, first_[i]), std::min(lo + size - 1, last_[i]));
      }
    }
    if (outside) {
      inside_end_ = t_end_;
      return;
    }
    // Back up to the deepest node that holds both cells.
    const auto moved = static_cast<std::uint64_t>((before[0] ^ cell_[0]) | (before[1] ^ cell_[1]) | (before[2] ^ cell_[2]));
    const int root = medium_->density.grid.root_level();
    while (level_ < root && (moved >> (BrickGrid::kBrickLog2 + 2 * level_)) != 0) ++level_;
  }

  void set_rate(std::span<const ValueRange> ranges) {
    const MediumOptics& optics = medium_->optics;
    if (ranges.size() == 1) {
      const float top = max_component(optics.sigma_a + optics.sigma_s);
      if constexpr (mode == WalkMode::majorant) {
        rate_ = ranges[0].max * top;
      } else {
        rate_ = spread(ranges[0]) * top;
        control_ = (optics.sigma_a + optics.sigma_s) * ranges[0].mean;
      }
      return;
    }
    float values[BrickGrid::kMaxChannels];
    Rgb a, s;
    for (std::size_t c = 0; c < ranges.size(); ++c) values[c] = mode == WalkMode::majorant ? ranges[c].max : spread(ranges[c]);
    medium_->scale_by(values, a, s);
    rate_ = max_component(a + s);
    if constexpr (mode == WalkMode::residual) {
      for (std::size_t c = 0; c < ranges.size(); ++c) values[c] = ranges[c].mean;
      medium_->scale_by(values, a, s);
      control_ = a + s;
    }
  }
  /// Bound on |value - mean|, with room for the rounding of the subtraction at the other end.
  static float spread(const ValueRange& r) {
    if (r.min == r.max) return 0;
    return std::max(r.max - r.mean, r.mean - r.min) + 0x1p-22f * r.max;
  }

  void read_grid(double t, LocalOptics& result) {
    const BrickGrid& grid = medium_->density.grid;
    const double p[3] = {o_[0] + t * d_[0], o_[1] + t * d_[1], o_[2] + t * d_[2]};
    std::int64_t lo[3] = {node_lo_[0], node_lo_[1], node_lo_[2]};
    std::uint32_t leaf = node_;
    if (grid.node(node_).mask != 0) {
      const std::int64_t size = BrickGrid::extent(node_level_);
      Index3 cell;
      for (std::size_t i = 0; i < 3; ++i) {
        cell[i] = std::clamp(static_cast<std::int64_t>(std::floor(p[i])), lo[i], lo[i] + size - 1);
        lo[i] = cell[i] & ~std::int64_t{7};
      }
      leaf = grid.leaf(node_, node_level_, cell);
      if (leaf == BrickGrid::kNone) return;
    }
    const auto x = static_cast<float>(p[0] - static_cast<double>(lo[0])), y = static_cast<float>(p[1] - static_cast<double>(lo[1])),
               z = static_cast<float>(p[2] - static_cast<double>(lo[2]));
    if (grid.channels() == 1) {
      const float density = grid.scalar_in_leaf(leaf, x, y, z);
      result.sigma_a = medium_->optics.sigma_a * density;
      result.sigma_s = medium_->optics.sigma_s * density;
      return;
    }
    float values[BrickGrid::kMaxChannels];
    grid.lookup_in_leaf(leaf, x, y, z, values);
    medium_->scale_by(values, result.sigma_a, result.sigma_s);
  }

  const MediumData* medium_;
  const Ray* ray_;
  double o_[3], d_[3], inverse_[3];  // of the ray in local coordinates
  double t_, t_end_, limit_;
  double inside_begin_ = -kInf, inside_end_ = -kInf;  // where the medium can be anything but empty
  float rate_ = 0;
  Rgb control_, last_sigma_s_;

  std::int64_t cell_[3], first_[3], last_[3];  // the cell in which the next piece begins, and the range of cells
  std::int64_t node_lo_[3];                    // lower corner of the current piece's node
  std::uint32_t node_ = BrickGrid::kNone;
  int node_level_ = 0, level_ = 0, exit_axis_ = 0;
  std::uint64_t steps_ = 0, max_steps_ = 16;
  std::uint32_t stack_[BrickGrid::kMaxLevel + 1];  // ancestors of cell_ from the root down to level_
};

}  // namespace tyndall
