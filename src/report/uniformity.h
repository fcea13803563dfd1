/// Is a set of numbers uniformly distributed on [0, 1]?
#pragma once

#include <cstddef>
#include <vector>

namespace tyndall {

/// P(D+ >= d) for n independent uniform numbers, exactly [Birnbaum & Tingey 1951]; D+ is the largest excess of their
/// empirical distribution over the uniform one [Smirnov 1939].
double smirnov_tail(std::size_t n, double d);

/// D+ of `values`, in [0, 1]; 0 for none.
double excess_of_small(std::vector<double> values);

}  // namespace tyndall
