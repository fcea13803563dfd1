#include "light/near_cut.h"

#include <algorithm>

#include "light/near_light.h"

namespace tyndall {
namespace {

using NodeRef = WideLightTree::NodeRef;

/// Among lights whose boxes overlap, all may be near.
constexpr std::size_t kMostClusters = 256;
/// Sums of these are finite.
constexpr float kMostImportance = 1e35f;

/// Splits depth first, so that neighbours in the cut are neighbours in space, and strata of the number that draws from it are
/// regions.
template <typename Tree, typename Local>
class NearCut {
 public:
  NearCut(const Tree& tree, const Local& local, float candidates) : tree_(tree), local_(local), candidates_(candidates) {}

  LightCut build() {
    split(tree_.root(), 0);
    float total = 0;  // what is left after large parts were taken off `total_` may be rounding alone
    for (const LightCluster& c : cut_) total += c.candidates;
    for (LightCluster& c : cut_) c.candidates = candidates_ * (c.candidates / total);
    return std::move(cut_);
  }

 private:
  /// Replaces a cluster that `total_` has the importance of by its children, and those by theirs.
  void split(NodeRef ref, float importance) {
    tree_.open(ref, local_, [&](NodeRef first, const WideNode& node, const auto& local, float factor) {
      const ChildImportance children = child_importance(node, local);
      const NearestLight nearest = nearest_light(node, local);
      const float scale = node.scale * factor;
      float parts[WideNode::kWidth], sum = 0;
      for (std::size_t i = 0; i < WideNode::kWidth; ++i) sum += parts[i] = std::min(children.of[i] * scale, kMostImportance);
      total_ = std::max(total_ - importance, 0.0f) + sum;
      for (std::uint32_t i = 0; i < WideNode::kWidth; ++i) {
        if (!(parts[i] > 0)) continue;
        if (nearest.of[i] * scale * candidates_ > total_ && cut_.size() < kMostClusters) {
          split(first + i, parts[i]);
        } else {
          cut_.push_back({first + i, parts[i]});
        }
      }
      return true;
    });
  }

  const Tree& tree_;
  const Local& local_;
  float candidates_;
  float total_ = 0;  ///< importance of what is in the cut or still to be split, roughly
  LightCut cut_;     ///< `candidates` is the importance until all are known
};

}  // namespace

template <typename Tree>
LightCut near_cut(const Tree& tree, const PointQuery& query, float candidates) {
  if (tree.empty()) return {};
  const auto local = tree.localize(query);
  return NearCut(tree, local, candidates).build();
}

template LightCut near_cut(const WideLightTree&, const PointQuery&, float);
template LightCut near_cut(const InstancedLightTree&, const PointQuery&, float);

}  // namespace tyndall
