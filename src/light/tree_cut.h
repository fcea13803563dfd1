/// Cuts through a binary light tree: sets of disjoint nodes that hold every light which may contribute, refined from the root
/// where a bound is largest [Walter et al. 2005, sec. 3].
#pragma once

#include <algorithm>
#include <vector>

#include "light/light_tree.h"

namespace tyndall {

/// How far a cut is refined.
struct CutGoal {
  double error = 0.02;  ///< of no node is the bound more than this share of the estimated total, while nodes allow
  std::size_t nodes = 1000;
  double beside = 0;  ///< what the total holds that is not of the tree
};

/// What the lights of a node contribute: at most, and about.
struct CutMeasure {
  double bound, estimate;
};

struct CutNode : CutMeasure {
  std::uint32_t node;

  /// Equal bounds are refined in the order of the tree, so that a cut depends on nothing else.
  friend bool operator<(const CutNode& a, const CutNode& b) { return a.bound != b.bound ? a.bound < b.bound : a.node > b.node; }
};

/// The nodes of a cut in the tree's order. `measure` gives the CutMeasure of a node. Nodes with bound 0 are left out, leaves
/// have no error.
template <typename Measure>
std::vector<CutNode> refined_cut(const LightTree& tree, const CutGoal& goal, const Measure& measure) {
  std::vector<CutNode> cut, open;  // the second is a heap
  double total = goal.beside;
  const auto add = [&](std::uint32_t node) {
    const CutNode part{measure(node), node};
    if (!(part.bound > 0)) return;
    total += part.estimate;
    (tree.nodes()[node].leaf ? cut : open).push_back(part);
    if (!tree.nodes()[node].leaf) std::push_heap(open.begin(), open.end());
  };
  if (!tree.empty()) add(0);
  while (!open.empty() && cut.size() + open.size() < goal.nodes && open.front().bound > goal.error * total) {
    std::pop_heap(open.begin(), open.end());
    const CutNode parent = open.back();
    open.pop_back();
    total -= parent.estimate;
    add(parent.node + 1);
    add(tree.nodes()[parent.node].second_or_light);
  }
  cut.insert(cut.end(), open.begin(), open.end());
  std::sort(cut.begin(), cut.end(), [](const CutNode& a, const CutNode& b) { return a.node < b.node; });
  return cut;
}

/// Of a cut in the tree's order, the only node that can hold the leaf; nothing where all nodes come after it.
template <typename Iterator, typename Node>
Iterator holder_of(Iterator begin, Iterator end, std::uint32_t leaf, const Node& node) {
  const auto after = std::upper_bound(begin, end, leaf, [&](std::uint32_t l, const auto& part) { return l < node(part); });
  return after == begin ? end : after - 1;
}

}  // namespace tyndall
