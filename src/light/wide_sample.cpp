// Descent of the wide light tree and the probabilities of its outcomes.
#include "light/choice_by_number.h"
#include "light/wide_light_tree.h"

namespace tyndall {
namespace {

double total(const ChildImportance& children) {
  double sum = 0;
  for (const float x : children.of) sum += x;
  return sum;
}

}  // namespace

/// Ends of the children's parts of [0, sum], the first at [1].
struct WideLightTree::Ends {
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

double WideLightTree::to_unit(Vec3 p) const {
  if (to_unit_ > 0) return to_unit_;
  const float largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest > 0 ? std::ldexp(1.0, -std::ilogb(largest)) : 1;
}

WideQuery WideLightTree::localize(const PointQuery& query, Vec3d at) const {
  double unit = to_unit(query.p);
  Vec3d p = at * unit;
  const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (largest > WideQuery::kFar) {
    p = p * (WideQuery::kFar / largest);
    unit *= WideQuery::kFar / largest;
  }
  WideQuery local{to_vec3(p), query.n, dot(query.n, query.n) > 0, query.transmissive};
  local.to_world = unit * unit;
  if (!local.surface) {
    local.g = query.g;
    local.forward = query.forward;
    return local;
  }
  local.diffuse = query.diffuse;
  local.lobe_count = query.lobe_count;
  std::copy_n(query.lobes.begin(), query.lobe_count, local.lobes.begin());
  return local;
}

WideSegment WideLightTree::localize(const Segment& query) const {
  const Vec3d middle = nodes_.empty() ? Vec3d() : Vec3d(all_.box.min) * 0.5 + Vec3d(all_.box.max) * 0.5;
  const double largest = std::max({std::abs(query.o.x), std::abs(query.o.y), std::abs(query.o.z), query.length});
  return WideSegment::from_segment(query, to_unit(to_vec3({largest, 0, 0})), middle);
}

/// One decision among the children of node `index`. False: nothing here has importance.
bool WideLightTree::step(Descent& d, std::uint32_t index, const Ends& ends) const {
  const double place = d.u * ends.sum();
  if (!(ends.sum() > 0)) return false;
  std::size_t child = 0;  // counted without branches: which it is cannot be guessed
  for (std::size_t i = 1; i < WideNode::kWidth; ++i) child += ends.at[i] <= place;
  d.u = std::min((place - ends.at[child]) / ends.width(child), kBelowOne52);
  d.chance *= ends.width(child) / ends.sum();
  d.ref = 8 * index + static_cast<NodeRef>(child);
  if (!is_leaf(d.ref)) nodes_[node_of(d.ref)].prefetch();
  return true;
}

template <typename Query>
std::optional<WideLightTree::Choice> WideLightTree::select_below(NodeRef top, const Query& query, double u) const {
  if (nodes_.empty()) return std::nullopt;
  if (is_leaf(top)) return Choice{nodes_[top / 8].child[top % 8], 1};
  if (u < kByNumber) return select_by_number(top, query, u / kByNumber);
  Descent d{top, top, rest(u), 1, 0};
  if (!run(d, query)) return std::nullopt;
  return choice(d);
}

template <typename Query>
bool WideLightTree::run(Descent& d, const Query& query) const {
  do {
    const std::uint32_t index = node_of(d.ref);
    if (!step(d, index, Ends(child_importance(nodes_[index], query)))) return false;
  } while (!is_leaf(d.ref));
  return true;
}

template <typename Query>
std::optional<WideLightTree::Reached> WideLightTree::decide(NodeRef top, const Query& query, double u) const {
  Descent d{top, top, u, 1, 0};
  if (!is_leaf(top) && !run(d, query)) return std::nullopt;
  return Reached{d.ref, d.u, d.chance};
}

// In turns: while one waits for its next node, the others go on. Neighbours are often at the same one, which is then looked
// at once.
template <typename Query>
void WideLightTree::select_below(std::span<const Draw> draws, const Query& query,
                                 std::span<std::optional<Choice>> choices) const {
  SmallVector<Descent, 16> under_way;
  for (std::uint32_t i = 0; i < draws.size(); ++i) {
    const auto [top, u] = draws[i];
    if (nodes_.empty() || is_leaf(top) || u < kByNumber) {
      choices[i] = select_below(top, query, u);
    } else {
      under_way.push_back({top, top, rest(u), 1, i});
    }
  }
  std::uint32_t seen = kAll;  // no node
  std::optional<Ends> ends;
  while (!under_way.empty()) {
    for (std::size_t i = under_way.size(); i-- > 0;) {
      Descent& d = under_way[i];
      const std::uint32_t index = node_of(d.ref);
      if (index != seen) ends.emplace(child_importance(nodes_[index], query));
      seen = index;
      const bool alive = step(d, index, *ends);
      if (alive && !is_leaf(d.ref)) continue;
      choices[d.draw] = alive ? std::optional(choice(d)) : std::nullopt;
      d = under_way.back();
      under_way.truncate(under_way.size() - 1);
    }
  }
}

WideLightTree::Choice WideLightTree::choice(const Descent& d) const {
  return {nodes_[d.ref / 8].child[d.ref % 8], mixed(d.chance, count_of(d.top))};
}

template <typename Query>
std::optional<WideLightTree::Choice> WideLightTree::select_by_number(NodeRef top, const Query& query, double u) const {
  auto number = static_cast<std::uint32_t>(u * count_of(top));
  const NodeRef ref = numbered(top, number);
  const double pmf = pmf_below(top, ref, query);
  if (!(pmf > 0)) return std::nullopt;
  return Choice{nodes_[ref / 8].child[ref % 8], pmf};
}

WideLightTree::NodeRef WideLightTree::numbered(NodeRef top, std::uint32_t& number) const {
  NodeRef ref = top;
  while (!is_leaf(ref)) {
    const std::uint32_t index = node_of(ref);
    std::uint32_t child = 0;
    for (; number >= nodes_[index].count[child]; ++child) number -= nodes_[index].count[child];
    ref = 8 * index + child;
  }
  return ref;
}

template <typename Query>
double WideLightTree::pmf_below(NodeRef top, NodeRef leaf, const Query& query) const {
  if (leaf == top) return 1;
  const auto chance = decided(top, leaf, query);
  return chance ? mixed(*chance, count_of(top)) : 0;
}

template <typename Query>
std::optional<double> WideLightTree::decided(NodeRef top, NodeRef leaf, const Query& query) const {
  double chance = 1;
  for (NodeRef ref = leaf; ref != top; ref = nodes_[ref / 8].parent) {
    const ChildImportance children = child_importance(nodes_[ref / 8], query);
    if (!(children.of[ref % 8] > 0)) return std::nullopt;
    const Ends ends(children);
    chance *= ends.width(ref % 8) / ends.sum();
  }
  return chance;
}

double WideLightTree::importance(const PointQuery& query) const {
  if (nodes_.empty()) return 0;
  const WideQuery local = localize(query);
  return total(children(kAll, local)) * nodes_[0].scale * intensity_ * local.to_world;
}

double WideLightTree::importance(const Segment& query) const {
  if (nodes_.empty()) return 0;
  const WideSegment local = localize(query);
  return total(children(kAll, local)) * nodes_[0].scale * intensity_ * local.to_world;
}

template std::optional<WideLightTree::Choice> WideLightTree::select_below(NodeRef, const WideQuery&, double) const;
template void WideLightTree::select_below(std::span<const Draw>, const WideQuery&, std::span<std::optional<Choice>>) const;
template double WideLightTree::pmf_below(NodeRef, NodeRef, const WideQuery&) const;
template std::optional<WideLightTree::Reached> WideLightTree::decide(NodeRef, const WideQuery&, double) const;
template std::optional<double> WideLightTree::decided(NodeRef, NodeRef, const WideQuery&) const;
template std::optional<WideLightTree::Choice> WideLightTree::select_below(NodeRef, const WideSegment&, double) const;
template void WideLightTree::select_below(std::span<const Draw>, const WideSegment&, std::span<std::optional<Choice>>) const;
template double WideLightTree::pmf_below(NodeRef, NodeRef, const WideSegment&) const;
template std::optional<WideLightTree::Reached> WideLightTree::decide(NodeRef, const WideSegment&, double) const;
template std::optional<double> WideLightTree::decided(NodeRef, NodeRef, const WideSegment&) const;

}  // namespace tyndall
