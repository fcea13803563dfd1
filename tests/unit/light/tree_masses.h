/// What a light tree should do, by the whole of it: the probability of every outcome, to hold pmf() and draws against.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "light/light_tree.h"
#include "light/wide_light_tree.h"
#include "support/chi_squared.h"

namespace tyndall::test {

struct Masses {
  std::vector<double> pmf;  ///< by light
  double dead = 0;          ///< where nothing contributes
};

/// What a LightTree is asked with.
inline const PointQuery& asked_with(const PointQuery& query) { return query; }
inline Segment asked_with(const Segment& query) { return query; }

/// The probabilities of all outcomes by walking the whole tree from the root. `query`: of a point or of a segment.
template <typename Query>
Masses walk(const LightTree& tree, const Query& query, std::size_t lights) {
  Masses m{std::vector<double>(lights)};
  const auto q = asked_with(query);
  if (!(tree.importance(q) > 0)) return {std::move(m.pmf), 1};
  std::vector<std::pair<std::uint32_t, double>> stack{{0, 1.0}};
  while (!stack.empty()) {
    const auto [index, mass] = stack.back();
    stack.pop_back();
    const LightTree::Node& node = tree.nodes()[index];
    if (node.leaf) {
      m.pmf[node.second_or_light] += mass;
    } else if (const auto p = tree.child_probability(index, q)) {
      if (*p > 0) stack.push_back({index + 1, mass * *p});
      if (*p < 1) stack.push_back({node.second_or_light, mass * (1 - *p)});
    } else {
      m.dead += mass;
    }
  }
  return m;
}

template <typename Query>
Masses walk(const WideLightTree& tree, const Query& query, std::size_t lights) {
  Masses m{std::vector<double>(lights)};
  const auto q = tree.localize(query);
  constexpr double by_number = 0x1p-20;
  std::vector<std::pair<WideLightTree::NodeRef, double>> stack{{tree.root(), 1.0}};
  std::size_t alive = 0;
  while (!stack.empty()) {
    const auto [ref, mass] = stack.back();
    stack.pop_back();
    if (tree.is_leaf(ref)) {
      m.pmf[tree.nodes()[ref / 8].child[ref % 8]] = (1 - by_number) * mass + by_number / double(lights);
      ++alive;
      continue;
    }
    const ChildImportance children = tree.children(ref, q);
    double sum = 0;
    for (const float c : children.of) sum += c;
    if (!(sum > 0)) m.dead += (1 - by_number) * mass;
    for (WideLightTree::NodeRef i = 0; i < 8; ++i)
      if (children.of[i] > 0) stack.push_back({8 * tree.node_of(ref) + i, mass * children.of[i] / sum});
  }
  m.dead += by_number * (1 - double(alive) / double(lights));
  return m;
}

/// pmf() is what the walk finds, and sums to 1 less the dead mass. `leaves`: of every light.
template <typename Tree, typename Query>
void check_pmf(const Tree& tree, const Query& q, const std::vector<std::uint32_t>& leaves) {
  const Masses walked = walk(tree, q, leaves.size());
  double sum = 0, worst = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const double pmf = tree.pmf(q, leaves[i]);
    REQUIRE((pmf >= 0 && pmf <= 1));
    worst = std::max(worst, std::abs(pmf - walked.pmf[i]) / std::max(walked.pmf[i], 1e-30));
    sum += pmf;
  }
  REQUIRE(std::abs(sum - (1 - walked.dead)) < 1e-5);
  REQUIRE(worst < 1e-6);
}

/// How well counts of `draws` choices, by light and at the end of none, follow the masses: a p-value.
inline double p_value_of(const std::vector<double>& counts, Masses m, int draws) {
  m.pmf.push_back(m.dead);
  for (std::size_t i = 0; i < counts.size(); ++i) REQUIRE((m.pmf[i] > 0 || counts[i] == 0));
  return count_p_value(counts, m.pmf, draws);
}

}  // namespace tyndall::test
