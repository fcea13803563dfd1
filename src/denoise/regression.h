/// First-order regression in a window around a pixel, each neighbour weighted by its likeness [Bitterli et al. 2016].
#pragma once

#include <array>
#include <span>
#include <vector>

#include "denoise/nl_means.h"

namespace tyndall {

/// Floats in columns of `padded()`, row by row of the window, 0 beyond the last.
class WindowColumns {
 public:
  WindowColumns(Neighbourhood neighbourhood, std::size_t columns)
      : neighbourhood_(neighbourhood), columns_(columns), values_(columns * static_cast<std::size_t>(neighbourhood.padded())) {}

  std::size_t count() const { return columns_; }
  int rows() const { return neighbourhood_.padded(); }
  float* operator[](std::size_t column) { return values_.data() + column * static_cast<std::size_t>(rows()); }
  const float* operator[](std::size_t column) const { return values_.data() + column * static_cast<std::size_t>(rows()); }

  /// The plane's values around (x, y).
  void load(std::size_t column, const PaddedPlane& plane, int x, int y);

 private:
  Neighbourhood neighbourhood_;
  std::size_t columns_;
  std::vector<float> values_;
};

/// What explains a pixel's value: 1, its offset from the centre, and features less those of the centre, all within [-1, 1].
class Explanation {
 public:
  Explanation(Neighbourhood neighbourhood, std::span<const PaddedPlane* const> features);

  void move_to(int x, int y);
  const WindowColumns& columns() const { return columns_; }

 private:
  void scale(std::size_t column);

  Neighbourhood neighbourhood_;
  std::span<const PaddedPlane* const> features_;
  WindowColumns columns_;
};

/// Least squares of three channels; holds the room that it takes.
class Regression {
 public:
  explicit Regression(Neighbourhood neighbourhood, std::size_t columns);

  /// Fits `target` (three columns) by `explanation` with `weights`, and puts what it predicts for every row into `fitted`,
  /// within the range of what has weight: a slope toward a peak would lead below 0 beside it.
  /// Gives how much of a row's own value is in its prediction, at weight 1: the mean leverage [Hoaglin and Welsch 1978].
  float fit(const WindowColumns& explanation, const WindowColumns& target, std::span<const float> weights,
            WindowColumns& fitted);

 private:
  static constexpr std::size_t kMost = 24;  ///< columns
  using Matrix = std::array<std::array<double, kMost>, kMost>;

  void gather(const WindowColumns& explanation, const WindowColumns& target, std::span<const float> weights);
  void solve();
  void predict(const WindowColumns& explanation, WindowColumns& fitted) const;

  std::size_t columns_;
  WindowColumns weighted_;
  Matrix normal_{};
  std::array<std::array<double, kMost>, 3> slopes_{};  ///< right-hand sides at first
};

}  // namespace tyndall
