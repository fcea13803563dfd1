/// Sums that do not depend on how their terms were grouped: what several jobs have rendered adds up to what one would have.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tyndall {

/// Each sum is a double and the float that rounding left over, 77 bits together: TwoSum [Knuth 1969, 4.2.2] gives the error of
/// every addition. Terms are floats, so a sum of n is exact while they lie within a factor of 2^53 / n of each other, and below
/// that right to 2^-77 n of itself; value() is the double nearest to it, whatever the order.
class FilmSums {
 public:
  explicit FilmSums(std::size_t size = 0) : high_(size), low_(size) {}

  std::size_t size() const { return high_.size(); }
  std::size_t memory_bytes() const { return size() * (sizeof(double) + sizeof(float)); }

  void add(std::size_t i, float term) { add(i, static_cast<double>(term), 0.0f); }
  /// What another sum of the same thing holds.
  void add(std::size_t i, double high, float low) {
    const double sum = high_[i] + high, part = sum - high_[i];
    const double error = (high_[i] - (sum - part)) + (high - part);
    high_[i] = sum;
    low_[i] += static_cast<float>(error) + low;
  }
  double value(std::size_t i) const { return high_[i] + static_cast<double>(low_[i]); }

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
