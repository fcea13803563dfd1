#include "denoise/regression.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/simd.h"

namespace tyndall {
namespace {

/// Of the weights' sum, added to the square of each slope: features that say nothing get none, and those that are alike share.
constexpr double kRidge = 1e-3;

double sum8(Float8 v) { return static_cast<double>(reduce(v)); }

double dot(const float* a, const float* b, int rows) {
  Float8 sum = 0.0f;
  for (int i = 0; i < rows; i += 8) sum += load8(a + i) * load8(b + i);
  return sum8(sum);
}

/// Least and greatest of `values` where they have weight.
std::pair<float, float> range_of(const float* values, std::span<const float> weights) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Float8 least = kInfinity, most = -kInfinity;
  for (std::size_t i = 0; i < weights.size(); i += 8) {
    const Float8 value = load8(values + i), weight = load8(weights.data() + i);
    least = min(least, choose(weight > 0.0f, value, Float8(kInfinity)));
    most = max(most, choose(weight > 0.0f, value, Float8(-kInfinity)));
  }
  return {hmin(least), hmax(most)};
}

}  // namespace

void WindowColumns::load(std::size_t column, const PaddedPlane& plane, int x, int y) {
  float* to = (*this)[column];
  const int radius = neighbourhood_.radius, side = neighbourhood_.side();
  for (int dy = -radius; dy <= radius; ++dy, to += side) std::copy_n(plane.row(y + dy) + x - radius, side, to);
}

Explanation::Explanation(Neighbourhood neighbourhood, std::span<const PaddedPlane* const> features)
    : neighbourhood_(neighbourhood), features_(features), columns_(neighbourhood, 3 + features.size()) {
  const int radius = neighbourhood.radius;
  int row = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx, ++row) {
      columns_[0][row] = 1;
      columns_[1][row] = static_cast<float>(dx) / static_cast<float>(radius);
      columns_[2][row] = static_cast<float>(dy) / static_cast<float>(radius);
    }
  }
}

void Explanation::move_to(int x, int y) {
  for (std::size_t f = 0; f < features_.size(); ++f) {
    columns_.load(3 + f, *features_[f], x, y);
    scale(3 + f);
  }
}

void Explanation::scale(std::size_t column) {
  float* values = columns_[column];
  const Float8 centre = values[neighbourhood_.count() / 2];
  const int count = neighbourhood_.count();
  std::fill(values + count, values + columns_.rows(), values[count / 2]);
  Float8 most = 0.0f;
  for (int i = 0; i < columns_.rows(); i += 8) {
    const Float8 difference = load8(values + i) - centre;
    store8(values + i, difference);
    most = max(most, abs(difference));
  }
  const float range = hmax(most);
  const Float8 factor = range > 1e-6f * std::abs(centre[0]) + 1e-30f ? 1 / range : 0.0f;
  for (int i = 0; i < columns_.rows(); i += 8) store8(values + i, load8(values + i) * factor);
}

Regression::Regression(Neighbourhood neighbourhood, std::size_t columns)
    : columns_(columns), weighted_(neighbourhood, columns) {}

float Regression::fit(const WindowColumns& explanation, const WindowColumns& target, std::span<const float> weights,
                      WindowColumns& fitted) {
  gather(explanation, target, weights);
  const double sum = normal_[0][0];
  solve();
  predict(explanation, fitted);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto [least, most] = range_of(target[c], weights);
    for (int r = 0; r < fitted.rows(); r += 8)
      store8(fitted[c] + r, min(max(load8(fitted[c] + r), Float8(least)), Float8(most)));
  }
  return std::min(1.0f, static_cast<float>(static_cast<double>(columns_) / sum));
}

void Regression::gather(const WindowColumns& explanation, const WindowColumns& target, std::span<const float> weights) {
  const int rows = explanation.rows();
  for (std::size_t i = 0; i < columns_; ++i) {
    float* weighted = weighted_[i];
    for (int r = 0; r < rows; r += 8) store8(weighted + r, load8(weights.data() + r) * load8(explanation[i] + r));
    for (std::size_t j = 0; j <= i; ++j) normal_[i][j] = dot(weighted, explanation[j], rows);
    for (std::size_t c = 0; c < 3; ++c) slopes_[c][i] = dot(weighted, target[c], rows);
  }
}

/// By Cholesky's decomposition, in place.
void Regression::solve() {
  const double ridge = kRidge * normal_[0][0];
  for (std::size_t i = 1; i < columns_; ++i) normal_[i][i] += ridge;
  for (std::size_t i = 0; i < columns_; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = normal_[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= normal_[i][k] * normal_[j][k];
      normal_[i][j] = i == j ? std::sqrt(std::max(sum, 1e-12)) : sum / normal_[j][j];
    }
  }
  for (auto& slopes : slopes_) {
    for (std::size_t i = 0; i < columns_; ++i) {
      for (std::size_t k = 0; k < i; ++k) slopes[i] -= normal_[i][k] * slopes[k];
      slopes[i] /= normal_[i][i];
    }
    for (std::size_t i = columns_; i-- > 0;) {
      for (std::size_t k = i + 1; k < columns_; ++k) slopes[i] -= normal_[k][i] * slopes[k];
      slopes[i] /= normal_[i][i];
    }
  }
}

void Regression::predict(const WindowColumns& explanation, WindowColumns& fitted) const {
  for (std::size_t c = 0; c < 3; ++c) {
    for (int r = 0; r < explanation.rows(); r += 8) {
      Float8 sum = 0.0f;
      for (std::size_t i = 0; i < columns_; ++i) sum += static_cast<float>(slopes_[c][i]) * load8(explanation[i] + r);
      store8(fitted[c] + r, sum);
    }
  }
}

}  // namespace tyndall
