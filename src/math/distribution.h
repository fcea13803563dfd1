/// Discrete and piecewise constant distributions over given weights.
///
/// Weights that are negative or not finite count as 0. Where all weights are 0 the distribution is uniform, and
/// total() says so. An outcome of weight 0 is otherwise never drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tyndall/math.h"

namespace tyndall {

/// Chooses an index in constant time: the alias method [Walker 1974; set up in linear time: Vose 1991].
class AliasTable {
 public:
  struct Sample {
    std::uint32_t index;
    double pmf;
  };

  AliasTable() = default;
  explicit AliasTable(std::span<const double> weights);

  Sample sample(double u) const;  ///< u in [0, 1); the table must not be empty
  double pmf(std::uint32_t index) const { return entries_[index].pmf; }

  std::size_t size() const { return entries_.size(); }
  bool empty() const { return entries_.empty(); }
  double total() const { return total_; }  ///< sum of the weights
  std::size_t memory_bytes() const { return entries_.capacity() * sizeof(Entry); }

 private:
  struct Entry {
    float keep = 1;           ///< probability of staying in this slot
    std::uint32_t alias = 0;  ///< where to go otherwise
    double pmf = 0;
  };
  std::vector<Entry> entries_;
  double total_ = 0;
};

/// Density on [0, 1) that is constant in each of n equal cells.
class PiecewiseConstant1D {
 public:
  struct Sample {
    float x;    ///< in [0, 1)
    float pdf;  ///< 1/length
    std::uint32_t cell;
  };

  PiecewiseConstant1D() = default;
  explicit PiecewiseConstant1D(std::span<const float> weights);

  Sample sample(float u) const;  ///< by inversion, monotone in u
  float pdf(float x) const;      ///< 1/length

  std::size_t size() const { return density_.size(); }
  double total() const { return total_; }  ///< sum of the weights
  std::size_t memory_bytes() const { return (density_.capacity() + cdf_.capacity() + guide_.capacity()) * sizeof(float); }

 private:
  static constexpr std::size_t kGuided = 4;  ///< cells for each guide
  std::size_t last_begun(float u) const;     ///< the last cell that begins at or before u

  std::vector<float> density_;
  std::vector<float> cdf_;            ///< size() + 1 values from 0 to 1
  std::vector<std::uint32_t> guide_;  ///< where last_begun() starts to look, for equal parts of [0, 1) [Chen and Asau 1974]
  double total_ = 0;
};

/// Density on [0, 1)^2 that is constant in each of width * height equal cells, given row by row.
class PiecewiseConstant2D {
 public:
  struct Sample {
    Vec2 p;     ///< in [0, 1)^2
    float pdf;  ///< 1/area
    std::uint32_t x, y;
  };

  PiecewiseConstant2D() = default;
  PiecewiseConstant2D(int width, int height, std::span<const float> weights);

  Sample sample(Vec2 u) const;  ///< the row by u.y, then the column by u.x
  float pdf(Vec2 p) const;      ///< 1/area

  double total() const { return rows_.total(); }  ///< sum of the weights
  std::size_t memory_bytes() const;

 private:
  PiecewiseConstant1D rows_;
  std::vector<PiecewiseConstant1D> columns_;  ///< within each row
};

}  // namespace tyndall
