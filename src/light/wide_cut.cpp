#include "light/wide_cut.h"

#include <algorithm>
#include <limits>

#include "light/split_measure.h"
#include "light/wide_spread.h"

namespace tyndall {
namespace {

using NodeRef = WideLightTree::NodeRef;

/// The children of two nodes: more clusters cost more than they gained (docs/measurements.md).
constexpr int kClusters = 15;

/// A cluster of the growing cut.
struct Open {
  NodeRef ref;
  float importance;  ///< relative to the other clusters
  float cv2;         ///< squared coefficient of variation of what it may contribute; leaves: 0
  float deviation2;  ///< predicted variance of its estimate by one candidate
};

using Clusters = SmallVector<Open, 16>;

/// How much the lights of each child differ in what they contribute to a segment.
ChildSpread child_spread(const WideNode& node, const WideSegment& segment) {
  ChildSpread spread;
  for (int i = 0; i < WideNode::kWidth; ++i) {
    const bool plain = node.count[i] <= 1;
    spread.cv2[static_cast<std::size_t>(i)] =
        plain ? 0.0f : static_cast<float>(std::min(split_measure(node.cluster(i), segment).cv2, 1e30));
  }
  return spread;
}

/// Splits by what a question, a WideQuery or a WideSegment, says of children.
template <typename Tree, typename Local>
class CutBuilder {
 public:
  CutBuilder(const Tree& tree, const Local& local, const CutSettings& settings)
      : tree_(tree),
        local_(local),
        candidates_(settings.candidates),
        most_(candidates_ > 0 ? static_cast<std::size_t>(std::max(candidates_, kClusters))
                              : std::numeric_limits<std::size_t>::max()),
        split_above_(settings.splitting > 0 ? 1 / settings.splitting - 1 : kInfinity) {}

  LightCut build() {
    cut_.push_back({tree_.root(), 1, kInfinity, kInfinity});
    while (split_worst()) {
    }
    return shared_out();
  }

 private:
  /// False: nothing is left to split, or no room.
  bool split_worst() {
    std::size_t worst = cut_.size();
    for (std::size_t i = 0; i < cut_.size(); ++i) {
      if (!(cut_[i].cv2 > split_above_)) continue;
      if (worst == cut_.size() || cut_[i].deviation2 > cut_[worst].deviation2) worst = i;
    }
    return worst < cut_.size() && split(worst);
  }

  bool split(std::size_t index) {
    return tree_.open(cut_[index].ref, local_, [&](NodeRef first, const WideNode& node, const auto& local, float factor) {
      if (cut_.size() - 1 + node.size() > most_) return false;
      replace(index, first, node, local, factor);
      return true;
    });
  }

  /// In the parent's place: neighbours in the cut are neighbours in space, so that strata of the number that draws from it
  /// are regions.
  template <typename Query>
  void replace(std::size_t index, NodeRef first, const WideNode& node, const Query& local, float factor) {
    const ChildImportance children = child_importance(node, local);
    const ChildSpread spread = child_spread(node, local);
    const Clusters rest = after(index);
    cut_.truncate(index);
    for (std::uint32_t i = 0; i < WideNode::kWidth; ++i) {
      if (!(children.of[i] > 0)) continue;
      const float importance = std::min(children.of[i] * node.scale * factor, kMostImportance), cv2 = spread.cv2[i];
      cut_.push_back({first + i, importance, cv2, importance * importance * std::min(cv2, 1e12f)});
    }
    for (const Open& c : rest) cut_.push_back(c);
  }

  Clusters after(std::size_t index) const {
    Clusters rest;
    for (std::size_t i = index + 1; i < cut_.size(); ++i) rest.push_back(cut_[i]);
    return rest;
  }

  /// By importance: a candidate for each cluster, were there enough, would take most of them from the few that matter.
  LightCut shared_out() const {
    LightCut result;
    for (const Open& c : cut_) result.push_back({c.ref, candidates_ > 0 ? c.importance : 1.0f});
    if (candidates_ > 0) share_out(result, static_cast<float>(candidates_));
    return result;
  }

  const Tree& tree_;
  const Local& local_;
  int candidates_;     ///< 0: as many as clusters
  std::size_t most_;   ///< clusters
  float split_above_;  ///< this cv2: the score 1 / (1 + cv2) is then below what was asked for
  Clusters cut_;
};

}  // namespace

template <typename Tree, typename Query>
LightCut wide_cut(const Tree& tree, const Query& query, const CutSettings& settings) {
  if (tree.empty()) return {};
  const auto local = tree.localize(query);
  return CutBuilder(tree, local, settings).build();
}

template LightCut wide_cut(const WideLightTree&, const PointQuery&, const CutSettings&);
template LightCut wide_cut(const WideLightTree&, const Segment&, const CutSettings&);
template LightCut wide_cut(const InstancedLightTree&, const PointQuery&, const CutSettings&);
template LightCut wide_cut(const InstancedLightTree&, const Segment&, const CutSettings&);

}  // namespace tyndall
