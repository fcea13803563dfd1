/// One medium along one ray: pieces of constant majorant, and coefficients at points of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "volume/brick_reader.h"
#include "volume/medium_data.h"
#include "volume/phase/phase_mix.h"
#include "volume/walk_mode.h"

namespace tyndall {

/// Tiles [t0, t1] of a ray with pieces, in order: next() moves to the first or next one, then t(), t_end(), rate()
/// and control() describe it and optics_at() reads inside it. Never allocates. Look-ups inside a brick are clamped
/// to it, so that no rounding leaves the range of its majorant.
template <WalkMode Mode>
class MediumWalk {
 public:
  MediumWalk(const MediumData& medium, const Ray& ray, double t0, double t1)
      : medium_(&medium), ray_(&ray), t_(t0), t_end_(t0), limit_(t1) {
    if (medium.kind == MediumData::Kind::homogeneous) {
      inside_end_ = t1;
      return;
    }
    top_sigma_ = max_component(medium.optics.sigma_a + medium.optics.sigma_s);
    local_ = GridRay(medium.density.to_local, ray);
    const auto [begin, end] = local_.clip(medium.clip, t0, kSameForAllEnds ? kInf : t1);
    if (!(begin < std::min(end, t1))) return;
    inside_begin_ = begin;
    inside_end_ = std::min(end, t1);
    split_end_ = end;
    if (medium.kind != MediumData::Kind::grid) return;
    local_.enter(medium.density.grid, medium.clip, begin);
    max_steps_ += local_.most_steps();
  }

  /// Move to the next piece; false at the end.
  bool next() {
    t_ = t_end_;
    if (t_ >= limit_) return false;
    if (part_ < part_count_) return next_part();
    ++steps_;
    reading_ = false;
    if (t_ >= inside_end_ || steps_ > max_steps_) return pass(limit_);
    if (t_ < inside_begin_) return pass(inside_begin_);
    switch (medium_->kind) {
      case MediumData::Kind::homogeneous:
        return next_uniform(1, 0);
      case MediumData::Kind::cloud:
        return next_uniform(medium_->cloud_mean, std::max(medium_->cloud_mean, 1 - medium_->cloud_mean));
      case MediumData::Kind::grid:
        break;
    }
    return next_node();
  }

  double t() const { return t_; }
  double t_end() const { return t_end_; }
  float rate() const { return rate_; }
  Rgb control() const { return control_; }  ///< sigma_t that is subtracted; 0 in majorant mode
  std::uint64_t steps() const { return steps_ + parts_walked_; }
  std::uint64_t noise_lookups() const { return noise_lookups_; }
  bool capped() const { return steps_ > max_steps_; }  ///< the safety limit of steps ended the walk: a defect

  /// Inside the current piece, of non-zero rate.
  LocalOptics optics_at(double t, bool with_emission) {
    LocalOptics result;
    switch (medium_->kind) {
      case MediumData::Kind::homogeneous:
        scale_by(1, result);
        break;
      case MediumData::Kind::cloud:
        scale_by(cloud_density(medium_->cloud, medium_point(t)), result);
        ++noise_lookups_;
        break;
      case MediumData::Kind::grid:
        read_grid(t, result);
        break;
    }
    if (with_emission && medium_->emission.kind != EmissionField::Kind::none && !is_black(result.sigma_a))
      result.emission = result.sigma_a * medium_->emission.at(ray_->at(static_cast<float>(t)));
    last_sigma_s_ = result.sigma_s;
    return result;
  }
  /// sigma_t minus control.
  Rgb excess_at(double t) {
    const LocalOptics optics = optics_at(t, false);
    return optics.sigma_a + optics.sigma_s - control_;
  }
  /// The same at several points of the piece.
  ExcessSum excess_at(const Teeth& teeth) {
    if (!reads_one_brick() || medium_->density.grid.channels() != 1) return sum_of_each(*this, teeth);
    const ValueSum values = reader_.sum(teeth.t, teeth.apart, teeth.count);
    const Rgb sigma_t = medium_->optics.sigma_a + medium_->optics.sigma_s;
    const Rgb low = sigma_t * values.min - control_, high = sigma_t * values.max - control_;
    return {sigma_t * values.sum - control_ * static_cast<float>(teeth.count),
            std::max(kernel::max_abs(low), kernel::max_abs(high))};
  }
  /// Of the current piece, of non-zero rate: whether its coefficients are cubic polynomials of t between next_face()s.
  bool is_cubic() { return medium_->kind == MediumData::Kind::homogeneous || reads_one_brick(); }
  /// The first face between cells beyond t. Where is_cubic().
  double next_face(double t) const { return reading_ ? reader_.next_face(t) : kInf; }
  bool scatters() const { return !is_black(medium_->optics.sigma_s); }
  /// The lobe of the last optics_at().
  void add_phase(PhaseMix& phase) const { phase.add(last_sigma_s_, medium_->optics.phase); }

 private:
  static constexpr double kInf = std::numeric_limits<double>::infinity();
  /// Flights by the same numbers collide alike wherever they must end: nodes are split as if they went on.
  static constexpr bool kSameForAllEnds = Mode == WalkMode::majorant;
  static constexpr bool kSubtracts = subtracts_control(Mode);
  static constexpr float kScale = Mode == WalkMode::residual ? kOversampling : 1;

  bool pass(double until) {
    t_end_ = until;
    rate_ = 0;
    control_ = {};
    node_ = BrickGrid::kNone;
    return true;
  }

  /// One piece up to the end of the medium: density in [0, 1] if `spread`, else 1.
  bool next_uniform(float control, float spread) {
    const Rgb sigma_t = medium_->optics.sigma_a + medium_->optics.sigma_s;
    t_end_ = inside_end_;
    rate_ = max_component(sigma_t) * (kSubtracts ? spread * kScale : 1);
    if constexpr (kSubtracts) control_ = sigma_t * control;
    return true;
  }

  /// The node at the ray's cell, split while that pays.
  bool next_node() {
    const BrickGrid& grid = medium_->density.grid;
    double exit = local_.exit(t_);
    while (local_.node() != BrickGrid::kNone && !grid.node(local_.node()).is_leaf() &&
           variation(grid.ranges(local_.node())) * (std::min(exit, split_end_) - t_) > kRefineDepth<Mode>) {
      local_.descend(grid);
      exit = local_.exit(t_);
    }
    if (local_.node() == BrickGrid::kNone)
      pass(exit);
    else
      set_rate(grid.ranges(local_.node()), std::min(exit, inside_end_) - t_);

    t_end_ = std::min(exit, inside_end_);
    node_ = local_.node();
    node_level_ = local_.level();
    node_corner_ = local_.corner();
    if (t_end_ < inside_end_ && !local_.leave(grid, t_end_)) inside_end_ = t_end_;
    if constexpr (Mode == WalkMode::residual)
      if (node_level_ == 0 && rate_ * (t_end_ - t_) > kSplitDepth) split_brick();
    return true;
  }

  /// Turn the current piece, a brick, into those of the octants that the ray passes, up to 4.
  void split_brick() {
    reader_.enter(medium_->density.grid, local_, node_, node_corner_);
    reading_ = true;
    part_count_ = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double middle = reader_.crossing(axis, BrickOctants::kCells);
      if (!(middle > t_ && middle < t_end_)) continue;
      int at = part_count_++;
      for (; at > 0 && part_ends_[at - 1] > middle; --at) part_ends_[at] = part_ends_[at - 1];
      part_ends_[at] = middle;
    }
    part_ends_[part_count_++] = t_end_;
    part_ = 0;
    next_part();
  }
  bool next_part() {
    t_end_ = part_ends_[part_++];
    ++parts_walked_;
    const BrickGrid& grid = medium_->density.grid;
    const unsigned octant = reader_.octant(t_ + (t_end_ - t_) * 0.5);
    set_rate(grid.octants().ranges(grid.bricks().slot(grid.node(node_).first), octant), t_end_ - t_);
    return true;
  }

  /// What splitting a node would make smaller: its majorant, or how far sigma_t varies in it.
  float variation(std::span<const ValueRange> ranges) const {
    const auto span_of = [](const ValueRange& r) { return kSubtracts ? r.max - r.min : r.max; };
    if (ranges.size() == 1) return span_of(ranges[0]) * top_sigma_;
    float values[kMaxChannels] = {};
    for (std::size_t c = 0; c < ranges.size(); ++c) values[c] = span_of(ranges[c]);
    return max_component(extinction(values));
  }

  /// Rate and control of a node that the ray crosses in `length`.
  void set_rate(std::span<const ValueRange> ranges, double length) {
    rate_ = variation(ranges);
    if constexpr (kSubtracts) {
      const float mean_share = rate_ == 0 ? 1.0f : std::exp(-static_cast<float>(rate_ * length));
      if (ranges.size() == 1) {
        const float c = control_value(ranges[0], mean_share);
        rate_ = spread(ranges[0], c) * top_sigma_ * kScale;
        control_ = (medium_->optics.sigma_a + medium_->optics.sigma_s) * c;
        return;
      }
      float values[kMaxChannels] = {};
      for (std::size_t c = 0; c < ranges.size(); ++c) values[c] = control_value(ranges[c], mean_share);
      control_ = extinction(values);
      for (std::size_t c = 0; c < ranges.size(); ++c) values[c] = spread(ranges[c], values[c]);
      rate_ = max_component(extinction(values)) * kScale;
    }
  }
  Rgb extinction(const float* values) const {
    Rgb a, s;
    medium_->scale_by(values, a, s);
    return a + s;
  }

  /// The mean where values differ little along the ray, the minimum where they differ by optical depths: there some rays pass
  /// beside what is dense, and a control above their density makes weights of up to 2 a look-up. The blend by exp(-optical
  /// depth of the difference) has less variance than either on sparse smoke (docs/measurements.md).
  static float control_value(const ValueRange& r, float mean_share) {
    return r.min == r.max ? r.mean : r.min + (r.mean - r.min) * mean_share;
  }
  /// Bound on |value - control|, with room for the rounding of the subtraction at the other end.
  static float spread(const ValueRange& r, float control) {
    if (r.min == r.max) return 0;
    return std::max(r.max - control, control - r.min) + 0x1p-22f * r.max;
  }

  void scale_by(float density, LocalOptics& result) const {
    result.sigma_a = medium_->optics.sigma_a * density;
    result.sigma_s = medium_->optics.sigma_s * density;
  }
  Vec3 medium_point(double t) const {
    const GridVec p = local_.at(t);
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
  }

  /// Then the reader is there.
  bool reads_one_brick() {
    if (reading_) return true;
    return medium_->kind == MediumData::Kind::grid && medium_->density.grid.node(node_).is_leaf() && start_reading(t_);
  }

  void read_grid(double t, LocalOptics& result) {
    if (!reading_ && !start_reading(t)) return;
    if (medium_->density.grid.channels() == 1) return scale_by(reader_.value(t), result);
    float values[kMaxChannels];
    reader_.values(t, values);
    medium_->scale_by(values, result.sigma_a, result.sigma_s);
  }

  /// Bring the reader to the leaf at t; false where it is empty.
  bool start_reading(double t) {
    const BrickGrid& grid = medium_->density.grid;
    if (grid.node(node_).is_leaf()) {
      reader_.enter(grid, local_, node_, node_corner_);
      reading_ = true;
      return true;
    }
    const std::int64_t size = BrickGrid::extent(node_level_);
    const GridVec p = local_.at(t);
    Index3 cell, corner;
    for (std::size_t i = 0; i < 3; ++i) {
      cell[i] = std::clamp(static_cast<std::int64_t>(p.v[i]), node_corner_[i], node_corner_[i] + size - 1);
      corner[i] = cell[i] & ~std::int64_t{7};
    }
    const std::uint32_t leaf = grid.leaf(node_, node_level_, cell);
    if (leaf == BrickGrid::kNone) return false;
    reader_.enter(grid, local_, leaf, corner);
    return true;
  }

  const MediumData* medium_;
  const Ray* ray_;
  double t_, t_end_, limit_;
  double inside_begin_ = -kInf, inside_end_ = -kInf;  // where the medium can be anything but empty
  double split_end_ = -kInf;                          // the end by which nodes are split
  float rate_ = 0, top_sigma_ = 0;
  Rgb control_, last_sigma_s_;
  std::uint64_t steps_ = 0, max_steps_ = 16;

  GridRay local_;         // already at the piece after the current one
  Index3 node_corner_{};  // of the current piece's node
  std::uint32_t node_ = BrickGrid::kNone;
  int node_level_ = 0;
  double part_ends_[4];
  int part_ = 0, part_count_ = 0;
  std::uint64_t parts_walked_ = 0, noise_lookups_ = 0;
  bool reading_ = false;  // the piece is one brick, and the reader is there
  BrickReader reader_;
};

}  // namespace tyndall
