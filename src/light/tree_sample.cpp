#include "light/light_tree.h"
#include "math/below_one.h"

namespace tyndall {
namespace {

/// A child with any importance keeps at least this chance, so that no light becomes unreachable by rounding.
constexpr double kLeastChance = 1e-9;

}  // namespace

template <typename Query>
std::optional<double> LightTree::child_probability(std::uint32_t node, const Query& query) const {
  const double first = node_importance(node + 1, query);
  const double second = node_importance(nodes_[node].second_or_light, query);
  if (!(first + second > 0)) return std::nullopt;
  if (first == 0 || second == 0) return first > 0 ? 1.0 : 0.0;
  const double share = first / (first + second);
  return std::clamp(rule_ == ChildRule::averaged ? averaged(share, node, query) : share, kLeastChance, 1 - kLeastChance);
}

template <typename Query>
double LightTree::averaged(double share, std::uint32_t node, const Query& query) const {
  const auto least = [&](std::uint32_t child) {
    return least_importance(nodes_[child].bounds, nodes_[child].two_sided, query);
  };
  const double first = least(node + 1), second = least(nodes_[node].second_or_light);
  return 0.5 * (share + (first + second > 0 ? first / (first + second) : 0.5));
}

template <typename Query>
std::optional<LightTree::Choice> LightTree::select_below(std::uint32_t node, const Query& query, double u) const {
  if (nodes_.empty() || !(node_importance(node, query) > 0)) return std::nullopt;
  double pmf = 1;
  while (!nodes_[node].leaf) {
    const auto p = child_probability(node, query);
    if (!p) return std::nullopt;
    if (u < *p) {
      u = std::min(u / *p, kBelowOne);
      pmf *= *p;
      node = node + 1;
    } else {
      u = std::min((u - *p) / (1 - *p), kBelowOne);
      pmf *= 1 - *p;
      node = nodes_[node].second_or_light;
    }
  }
  return Choice{nodes_[node].second_or_light, pmf};
}

template <typename Query>
double LightTree::pmf_below(std::uint32_t top, const Query& query, std::uint32_t leaf) const {
  // In preorder what a node holds comes after it.
  if (leaf < top || !(node_importance(top, query) > 0)) return 0;
  double pmf = 1;
  for (std::uint32_t node = leaf; node != top && pmf > 0; node = nodes_[node].parent) {
    const std::uint32_t parent = nodes_[node].parent;
    if (parent == kNoParent || parent < top) return 0;
    const auto p = child_probability(parent, query);
    if (!p) return 0;
    pmf *= node == parent + 1 ? *p : 1 - *p;
  }
  return pmf;
}

template std::optional<double> LightTree::child_probability(std::uint32_t, const PointQuery&) const;
template std::optional<LightTree::Choice> LightTree::select_below(std::uint32_t, const PointQuery&, double) const;
template double LightTree::pmf_below(std::uint32_t, const PointQuery&, std::uint32_t) const;
template std::optional<double> LightTree::child_probability(std::uint32_t, const Segment&) const;
template std::optional<LightTree::Choice> LightTree::select_below(std::uint32_t, const Segment&, double) const;
template double LightTree::pmf_below(std::uint32_t, const Segment&, std::uint32_t) const;

}  // namespace tyndall
