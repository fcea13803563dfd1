/// Few combinations of many choices, in which every pair of values of two factors occurs [all-pairs testing].
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace tyndall::test {

/// One value's index for each factor.
using Combination = std::vector<std::size_t>;
/// Whether a combination makes sense at all.
using Allowed = std::function<bool(const Combination&)>;

/// Every allowed combination of `sizes` values.
std::vector<Combination> all_combinations(const std::vector<std::size_t>& sizes, const Allowed& allowed);

/// Greedy: the next combination is the first of those that cover most of the pairs that are still missing. Each pair that
/// some allowed combination has is covered.
std::vector<Combination> covering_combinations(const std::vector<std::size_t>& sizes, const Allowed& allowed);

}  // namespace tyndall::test
