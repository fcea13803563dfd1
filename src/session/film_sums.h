/// Sums that do not depend on how their terms were grouped: what several jobs have rendered adds up to what one would have.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace tyndall {

/// A double and the float that rounding left over, 77 bits together: TwoSum [Knuth 1969, 4.2.2] gives the error of every
/// addition. Terms are floats, so a sum of n is exact while they lie within a factor of 2^53 / n of each other, and below that
/// right to 2^-77 n of itself; value() is the double nearest to it, whatever the order.
struct ExactSum {
  double high = 0;
  float low = 0;

  double value() const { return high + static_cast<double>(low); }
  void add(const ExactSum& other) {
    const double sum = high + other.high, part = sum - high;
    const double error = (high - (sum - part)) + (other.high - part);
    high = sum;
    low += static_cast<float>(error) + other.low;
  }
};

/// The same as three floats that add up to it: at most 29 bits of a double's 53 are left by the first.
inline std::array<float, 3> split(const ExactSum& sum) {
  const auto first = static_cast<float>(sum.high);
  const double rest = sum.high - static_cast<double>(first);
  const auto second = static_cast<float>(rest);
  return {first, second, static_cast<float>(rest - static_cast<double>(second) + sum.low)};
}

/// Exact sums, each as an ExactSum.
class FilmSums {
 public:
  explicit FilmSums(std::size_t size = 0) : high_(size), low_(size) {}

  std::size_t size() const { return high_.size(); }
  std::size_t memory_bytes() const { return size() * (sizeof(double) + sizeof(float)); }

  void add(std::size_t i, float term) { add(i, static_cast<double>(term), 0.0f); }
  /// What another sum of the same thing holds.
  void add(std::size_t i, double high, float low) {
    ExactSum sum = at(i);
    sum.add({high, low});
    high_[i] = sum.high;
    low_[i] = sum.low;
  }
  ExactSum at(std::size_t i) const { return {high_[i], low_[i]}; }
  double value(std::size_t i) const { return at(i).value(); }

  std::span<double> high() { return high_; }
  std::span<const double> high() const { return high_; }
  std::span<float> low() { return low_; }
  std::span<const float> low() const { return low_; }

  /// `count` sums of `from`, from number `first` on, in place of those here from `to` on.
  void copy(const FilmSums& from, std::size_t first, std::size_t count, std::size_t to);
  void clear(std::size_t first, std::size_t count);

 private:
  std::vector<double> high_;
  std::vector<float> low_;
};

}  // namespace tyndall
