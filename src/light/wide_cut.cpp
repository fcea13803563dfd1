#include "light/wide_cut.h"

#include <algorithm>
#include <cmath>

#include "light/split_measure.h"

namespace tyndall {
namespace {

using NodeRef = WideLightTree::NodeRef;

/// A cluster of the growing cut.
struct Open {
  NodeRef ref;
  bool leaf;
  double importance;  ///< relative to the other clusters
  double cv2;         ///< squared coefficient of variation of what it may contribute
  std::uint32_t candidates;

  double score() const { return leaf ? 1 : 1 / (1 + cv2); }
  /// Predicted standard deviation of its estimate by one candidate; clusters that hold the point come before all others.
  double deviation() const { return importance * std::sqrt(std::min(cv2, 1e12)); }
};
using Cut = SmallVector<Open, 16>;

/// Splits by what a question of kind `Local` says of children, and by cv2(Cluster).
template <typename Local, typename Cv2>
class CutBuilder {
 public:
  CutBuilder(const WideLightTree& tree, const Local& local, const Cv2& cv2, const CutSettings& settings)
      : tree_(tree), local_(local), cv2_(cv2), settings_(settings) {}

  LightCut build() {
    cut_.push_back({tree_.root(), tree_.is_leaf(tree_.root()), 1, cv2_(tree_.cluster(tree_.root())), 1});
    while (split_worst()) {
    }
    share_out();
    LightCut result;
    for (const Open& c : cut_) result.push_back({c.ref, c.candidates});
    return result;
  }

 private:
  /// False: nothing is left to split, or no room.
  bool split_worst() {
    std::size_t worst = cut_.size();
    for (std::size_t i = 0; i < cut_.size(); ++i) {
      if (cut_[i].leaf || !(cut_[i].score() < settings_.splitting)) continue;
      if (worst == cut_.size() || cut_[i].deviation() > cut_[worst].deviation()) worst = i;
    }
    return worst < cut_.size() && split(worst);
  }

  bool split(std::size_t index) {
    const NodeRef parent = cut_[index].ref;
    const ChildImportance children = tree_.children(parent, local_);
    const std::uint32_t node = tree_.node_of(parent);
    const auto used =
        static_cast<std::size_t>(std::count_if(children.of.begin(), children.of.end(), [](float i) { return i > 0; }));
    if (settings_.candidates > 0 && cut_.size() - 1 + used > static_cast<std::size_t>(settings_.candidates)) return false;
    cut_[index] = cut_.back();
    cut_.truncate(cut_.size() - 1);
    for (std::uint32_t i = 0; i < WideNode::kWidth; ++i) {
      if (!(children.of[i] > 0)) continue;
      const NodeRef ref = 8 * node + i;
      const bool leaf = tree_.is_leaf(ref);
      cut_.push_back({ref, leaf, double(children.of[i]) * tree_.nodes()[node].scale, leaf ? 0 : cv2_(tree_.cluster(ref)), 1});
    }
    return true;
  }

  /// One by one to the cluster with the most importance a candidate [d'Hondt's rule].
  void share_out() {
    if (cut_.empty()) return;
    for (auto left = static_cast<std::size_t>(settings_.candidates); left > cut_.size(); --left) {
      std::max_element(cut_.begin(), cut_.end(), [](const Open& a, const Open& b) {
        return a.importance / (a.candidates + 1) < b.importance / (b.candidates + 1);
      })->candidates++;
    }
  }

  const WideLightTree& tree_;
  const Local& local_;
  const Cv2& cv2_;
  const CutSettings& settings_;
  Cut cut_;
};

}  // namespace

LightCut wide_cut(const WideLightTree& tree, const PointQuery& query, const CutSettings& settings) {
  if (tree.empty()) return {};
  const WideQuery local = tree.localize(query);
  const auto cv2 = [&](const Cluster& cluster) {
    double factor = 1 + split_measure(cluster, local).cv2;
    for (const QueryLobe& lobe : query.lobes) factor *= 1 + lobe_cv2(lobe, Vec3d(local.p), cluster);
    return factor - 1;
  };
  return CutBuilder(tree, local, cv2, settings).build();
}

LightCut wide_cut(const WideLightTree& tree, const Segment& query, const CutSettings& settings) {
  if (tree.empty()) return {};
  const WideSegment local = tree.localize(query);
  const auto cv2 = [&](const Cluster& cluster) { return split_measure(cluster, local).cv2; };
  return CutBuilder(tree, local, cv2, settings).build();
}

}  // namespace tyndall
