/// What the errors of several independent renders say: how fast the error falls, and which method is ahead by how much.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace tyndall {

/// A number with its 95 % interval.
struct ConfidenceInterval {
  double value = 0, low = 0, high = 0;
};

/// Student's t with P(|T| > t) = 5 %.
double student_t_95(double dof);

/// Mean of independent values; nothing below two of them.
std::optional<ConfidenceInterval> mean_interval(std::span<const double> values);

/// One measured point of a render: x is seconds or samples, y the error there.
struct ErrorPoint {
  double x = 0, y = 0;
};

/// Slope of log y against log x by least squares; nothing with fewer than three points above 0.
std::optional<double> log_slope(std::span<const ErrorPoint> points);

/// (mean of `base`) / (mean of `other`), both of cost = error x time by seed: how many times as efficient `other` is. The
/// i-th runs of both have the same seed and ran side by side, so what they share takes no part: the interval is Student's
/// for the logarithm of the ratio, by the delta method on the pairs. Nothing for fewer than two pairs, and when a mean is
/// not above 0.
std::optional<ConfidenceInterval> relative_efficiency(std::span<const double> base, std::span<const double> other);

}  // namespace tyndall
