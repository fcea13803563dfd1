#include "light/wide_cut.h"

#include <algorithm>
#include <cmath>

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

/// How much the lobe varies over a cluster: nothing where it does not reach, and else as the angle that the cluster is
/// seen under, in widths of the lobe.
double lobe_cv2(const QueryLobe& lobe, const Cluster& cluster, const SplitMeasure& m, const WideQuery& query) {
  if (!(lobe.width > 0) || !(m.nearest > 0)) return 0;
  const Vec3d center = (Vec3d(cluster.box.min) + Vec3d(cluster.box.max)) * 0.5 - Vec3d(query.p);
  const double distance = 0.5 * (m.nearest + m.farthest), radius = 0.5 * (m.farthest - m.nearest);
  const double seen = std::asin(std::min(radius / distance, 1.0));
  const double off = std::acos(std::clamp(dot(center, Vec3d(lobe.axis)) / length(center), -1.0, 1.0));
  constexpr double kReach = 2;  // widths: GGX has fallen to a hundredth
  if (off - seen > kReach * lobe.width) return 0;
  const double widths = seen / lobe.width;
  return widths * widths;
}

class CutBuilder {
 public:
  CutBuilder(const WideLightTree& tree, const PointQuery& query, const CutSettings& settings)
      : tree_(tree), query_(query), local_(tree.localize(query)), settings_(settings) {}

  LightCut build() {
    cut_.push_back({tree_.root(), tree_.is_leaf(tree_.root()), 1, cv2_of(tree_.root()), 1});
    while (split_worst()) {
    }
    share_out();
    LightCut result;
    for (const Open& c : cut_) result.push_back({c.ref, c.candidates});
    return result;
  }

 private:
  double cv2_of(NodeRef ref) const {
    const Cluster cluster = tree_.cluster(ref);
    const SplitMeasure m = split_measure(cluster, local_);
    double factor = 1 + m.cv2;
    for (const QueryLobe& lobe : query_.lobes) factor *= 1 + lobe_cv2(lobe, cluster, m, local_);
    return factor - 1;
  }

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
    const auto used = static_cast<std::size_t>(std::count_if(children.of.begin(), children.of.end(), [](float i) { return i > 0; }));
    if (settings_.candidates > 0 && cut_.size() - 1 + used > static_cast<std::size_t>(settings_.candidates)) return false;
    cut_[index] = cut_.back();
    cut_.truncate(cut_.size() - 1);
    for (std::uint32_t i = 0; i < WideNode::kWidth; ++i) {
      if (!(children.of[i] > 0)) continue;
      const NodeRef ref = 8 * node + i;
      const bool leaf = tree_.is_leaf(ref);
      cut_.push_back({ref, leaf, double(children.of[i]) * tree_.nodes()[node].scale, leaf ? 0 : cv2_of(ref), 1});
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
  const PointQuery& query_;
  WideQuery local_;
  const CutSettings& settings_;
  Cut cut_;
};

}  // namespace

LightCut wide_cut(const WideLightTree& tree, const PointQuery& query, const CutSettings& settings) {
  if (tree.empty()) return {};
  return CutBuilder(tree, query, settings).build();
}

}  // namespace tyndall
