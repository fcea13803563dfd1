/// "Agrees at d": the standard error of the difference is at most d/5.65, nightly d/6.5 (with sanitizers kCoarser times that),
/// and the difference is below 4 standard errors. A bias of d is then found with power 0.95, nightly 0.99, and a correct value
/// is refused 6 times in 100,000.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "support/pooled_renders.h"

namespace tyndall::test {

/// 1 % per commit, 0.3 % nightly.
double required_precision();

struct Agreement {
  std::optional<double> d = std::nullopt;  ///< required_precision() when absent
  double rounding = 0;                     ///< of the expected value as printed: half its last digit
  double seconds = 120;                    ///< for a scene, on idle cores; too long is a failure (40 times that nightly)
  Variant variant = {};
};

/// What each of `contenders` must agree with the mean of the others at, for every two of them to agree at required_precision():
/// x_i - x_j = (1 - 1/n) times the difference of how far each is from the mean of the others.
double pairwise_precision(std::size_t contenders);

/// Expected image means of R, G and B; what is absent is not looked at.
using Expected = std::array<std::optional<double>, 3>;
inline Expected grey(double value) { return {value, std::nullopt, std::nullopt}; }

/// The image mean of `scene` agrees with `expected` at d. CHECKs, and prints what was measured in a line a channel.
/// Returns what was measured: nothing when TYNDALL_ONLY is set and no part of `name`.
Measured check_agrees(const std::string& name, const std::string& scene, const Expected& expected, const Agreement& how = {});

/// The image mean of `scene`, expected to be 0, is at most `bound` plus 4 standard errors, themselves at most bound / 4.
void check_vanishes(const std::string& name, const std::string& scene, double bound, const Agreement& how = {});

/// All contenders render the same picture: image means pairwise at d, channel by channel, and their 8x8 blocks by
/// Welch's test at family level 1e-3.
void check_same(const std::string& name, const std::vector<Contender>& contenders, const Agreement& how = {});

/// The same, with the same seeds for all contenders, each held against the mean of the others: noise that they share drops
/// out of the differences, whose errors are measured as such. Each is rendered until its own difference is known, so the work
/// grows with their number, not its square.
/// pairwise_precision() says what that makes of every two.
void check_all_agree(const std::string& name, const std::vector<Contender>& contenders, const Agreement& how = {});
void check_all_agree(const std::string& name, const std::string& scene,
                     const std::vector<std::pair<std::string, Variant>>& variants, const Agreement& how = {});

}  // namespace tyndall::test
