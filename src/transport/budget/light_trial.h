/// What asking lights costs a path, and what it leaves to chance: noted where lights are asked, while a pilot looks
/// (session/pilot.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace tyndall {

/// Numbers that a LightBudget is about: of candidates and shadow rays, at a path's first vertex and along its first segment.
enum class Spent : std::size_t { vertex_candidates, vertex_rays, span_candidates, span_rays };
inline constexpr std::size_t kSpents = 4;

template <typename T>
class PerSpent : public std::array<T, kSpents> {
 public:
  using std::array<T, kSpents>::operator[];
  T& operator[](Spent s) { return (*this)[static_cast<std::size_t>(s)]; }
  const T& operator[](Spent s) const { return (*this)[static_cast<std::size_t>(s)]; }
};

/// Sums over a path's samples.
struct LightTrial {
  PerSpent<double> variance{};  ///< that choices add to a sample's radiance (mean of the channels), given all else
  PerSpent<double> cost{};      ///< ns (prices.h)
  // What was done a second time for the trial alone.
  double difference = 0;  ///< by how much more it found, in radiance
  double repeated = 0;    ///< ns
};

/// Terms that were drawn with a probability of 1 / scale each, times their scale.
class SumOfTerms {
 public:
  void add(double term, double scale) {
    sum_ += term;
    squares_ += term * term;
    alone_ = term * term * (1 - 1 / scale);
    ++count_;
  }
  /// Of their sum: n / (n - 1) times their squared deviations from the mean. One alone is there, or not.
  double variance() const {
    if (count_ < 2) return alone_;
    const auto n = static_cast<double>(count_);
    return std::max(squares_ - sum_ * sum_ / n, 0.0) * n / (n - 1);
  }

 private:
  double sum_ = 0, squares_ = 0, alone_ = 0;
  int count_ = 0;
};

}  // namespace tyndall
