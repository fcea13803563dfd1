#include "support/covering.h"

#include <array>
#include <set>

namespace tyndall::test {
namespace {

using Pair = std::array<std::size_t, 4>;  ///< factor, value, factor, value

std::vector<Pair> pairs_of(const Combination& c) {
  std::vector<Pair> pairs;
  for (std::size_t j = 1; j < c.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) pairs.push_back({i, c[i], j, c[j]});
  }
  return pairs;
}

std::size_t count_in(const std::set<Pair>& missing, const Combination& c) {
  std::size_t count = 0;
  for (const Pair& pair : pairs_of(c)) count += missing.count(pair);
  return count;
}

}  // namespace

std::vector<Combination> all_combinations(const std::vector<std::size_t>& sizes, const Allowed& allowed) {
  std::vector<Combination> all;
  Combination c(sizes.size(), 0);
  while (true) {
    if (allowed(c)) all.push_back(c);
    std::size_t i = 0;
    while (i < sizes.size() && ++c[i] == sizes[i]) c[i++] = 0;
    if (i == sizes.size()) return all;
  }
}

std::vector<Combination> covering_combinations(const std::vector<std::size_t>& sizes, const Allowed& allowed) {
  const std::vector<Combination> all = all_combinations(sizes, allowed);
  std::set<Pair> missing;
  for (const Combination& c : all) {
    for (const Pair& pair : pairs_of(c)) missing.insert(pair);
  }
  std::vector<Combination> chosen;
  while (!missing.empty()) {
    const Combination* best = nullptr;
    std::size_t most = 0;
    for (const Combination& c : all) {
      const std::size_t count = count_in(missing, c);
      if (count > most) {
        most = count;
        best = &c;
      }
    }
    for (const Pair& pair : pairs_of(*best)) missing.erase(pair);
    chosen.push_back(*best);
  }
  return chosen;
}

}  // namespace tyndall::test
