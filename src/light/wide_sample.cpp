// Descent of the wide light tree and the probabilities of its outcomes.
#include "light/wide_light_tree.h"

namespace tyndall {
namespace {

/// Small enough that no product with a sum of weights rounds up to that sum.
constexpr double kBelowOne = 1 - 0x1p-52;

/// Weight of the choice by number.
constexpr double kByNumber = 0x1p-20;

double mixed(double by_importance, std::uint32_t lights) { return (1 - kByNumber) * by_importance + kByNumber / lights; }

/// Ends of the children's parts of [0, sum], the first at [1].
struct Ends {
  std::array<double, WideNode::kWidth + 1> at{};

  explicit Ends(const ChildImportance& children) {
    // Two short chains of sums in place of a long one.
    const auto& x = children.of;
    double first = 0, second = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      at[i + 1] = first += x[i];
      at[i + 5] = second += x[i + 4];
    }
    for (std::size_t i = 5; i <= WideNode::kWidth; ++i) at[i] += first;
  }
  double sum() const { return at.back(); }
  double width(std::size_t child) const { return at[child + 1] - at[child]; }
};

double total(const ChildImportance& children) { return Ends(children).sum(); }

}  // namespace

double WideLightTree::to_unit(Vec3 p) const {
  if (to_unit_ > 0) return to_unit_;
  const float largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest > 0 ? std::ldexp(1.0, -std::ilogb(largest)) : 1;
}

WideQuery WideLightTree::localize(const PointQuery& query) const {
  Vec3d p = Vec3d(query.p) * to_unit(query.p);
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (largest > WideQuery::kFar) p = p * (WideQuery::kFar / largest);
  return {to_vec3(p), query.n, dot(query.n, query.n) > 0, query.transmissive};
}

WideSegment WideLightTree::localize(const Segment& query) const {
  const Vec3d middle = nodes_.empty() ? Vec3d() : Vec3d(all_.box.min) * 0.5 + Vec3d(all_.box.max) * 0.5;
  const double largest = std::max({std::abs(query.o.x), std::abs(query.o.y), std::abs(query.o.z), query.length});
  return WideSegment::from_segment(query, to_unit(to_vec3({largest, 0, 0})), middle);
}

template <typename Query>
std::optional<WideLightTree::Choice> WideLightTree::descend(NodeRef top, const Query& query, double u) const {
  if (nodes_.empty()) return std::nullopt;
  if (is_leaf(top)) return Choice{nodes_[top / 8].child[top % 8], 1};
  if (u < kByNumber) return select_by_number(top, query, u / kByNumber);
  u = std::min((u - kByNumber) / (1 - kByNumber), kBelowOne);
  double chance = 1;
  NodeRef ref = top;
  do {
    const std::uint32_t index = node_of(ref);
    const Ends ends(child_importance(nodes_[index], query));
    const double place = u * ends.sum();
    if (!(ends.sum() > 0)) return std::nullopt;
    std::size_t child = 0;  // counted without branches: which it is cannot be guessed
    for (std::size_t i = 1; i < WideNode::kWidth; ++i) child += ends.at[i] <= place;
    u = std::min((place - ends.at[child]) / ends.width(child), kBelowOne);
    chance *= ends.width(child) / ends.sum();
    ref = 8 * index + static_cast<NodeRef>(child);
    if (!is_leaf(ref)) nodes_[node_of(ref)].prefetch();
  } while (!is_leaf(ref));
  return Choice{nodes_[ref / 8].child[ref % 8], mixed(chance, count_of(top))};
}

template <typename Query>
std::optional<WideLightTree::Choice> WideLightTree::select_by_number(NodeRef top, const Query& query, double u) const {
  auto number = static_cast<std::uint32_t>(u * count_of(top));
  NodeRef ref = top;
  while (!is_leaf(ref)) {
    const std::uint32_t index = node_of(ref);
    std::uint32_t child = 0;
    for (; number >= nodes_[index].count[child]; ++child) number -= nodes_[index].count[child];
    ref = 8 * index + child;
  }
  const double pmf = ascend(top, ref, query);
  if (!(pmf > 0)) return std::nullopt;
  return Choice{nodes_[ref / 8].child[ref % 8], pmf};
}

template <typename Query>
double WideLightTree::ascend(NodeRef top, NodeRef leaf, const Query& query) const {
  if (leaf == top) return 1;
  double chance = 1;
  for (NodeRef ref = leaf; ref != top; ref = nodes_[ref / 8].parent) {
    const ChildImportance children = child_importance(nodes_[ref / 8], query);
    if (!(children.of[ref % 8] > 0)) return 0;
    const Ends ends(children);
    chance *= ends.width(ref % 8) / ends.sum();
  }
  return mixed(chance, count_of(top));
}

std::optional<WideLightTree::Choice> WideLightTree::select_below(NodeRef top, const WideQuery& query, double u) const {
  return descend(top, query, u);
}
std::optional<WideLightTree::Choice> WideLightTree::select_below(NodeRef top, const WideSegment& query, double u) const {
  return descend(top, query, u);
}
double WideLightTree::pmf_below(NodeRef top, NodeRef leaf, const WideQuery& query) const { return ascend(top, leaf, query); }
double WideLightTree::pmf_below(NodeRef top, NodeRef leaf, const WideSegment& query) const { return ascend(top, leaf, query); }

double WideLightTree::importance(const PointQuery& query) const {
  if (nodes_.empty()) return 0;
  const double per_length = to_unit(query.p);
  return total(children(kAll, localize(query))) * nodes_[0].scale * intensity_ * per_length * per_length;
}

double WideLightTree::importance(const Segment& query) const {
  if (nodes_.empty()) return 0;
  const WideSegment local = localize(query);
  return total(children(kAll, local)) * nodes_[0].scale * intensity_ * local.to_world;
}

}  // namespace tyndall
