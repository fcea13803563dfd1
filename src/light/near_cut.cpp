#include "light/near_cut.h"

#include <algorithm>
#include <array>

#include "light/near_light.h"

namespace tyndall {
namespace {

using NodeRef = WideLightTree::NodeRef;

/// Among lights whose boxes overlap, all may be near.
constexpr std::size_t kMostClusters = 256;

/// Splits depth first, so that neighbours in the cut are neighbours in space, and strata of the number that draws from it are
/// regions.
template <typename Tree, typename Local>
class NearCut {
 public:
  NearCut(const Tree& tree, const Local& local, float candidates) : tree_(tree), local_(local), candidates_(candidates) {}

  LightCut build() {
    split(tree_.root(), 0);
    share_out(cut_, candidates_);  // not by `total_`: after large parts were taken off, its rest may be rounding alone
    return std::move(cut_);
  }

 private:
  /// Replaces a cluster that `total_` has the importance of by its children, and those by theirs.
  void split(NodeRef ref, float importance) {
    tree_.open(ref, local_, [&](NodeRef first, const WideNode& node, const auto& local, float factor) {
      const ChildImportance children = child_importance(node, local);
      const NearestLight nearest = nearest_light(node, local);
      const float scale = node.scale * factor;
      std::array<float, WideNode::kWidth> parts;
      float sum = 0;
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
    });
  }

  const Tree& tree_;
  const Local& local_;
  float candidates_;
  float total_ = 0;  ///< importance of what is in the cut or still to be split, roughly
  LightCut cut_;     ///< with importances, to be shared out
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
