// Construction of the wide light tree in two passes. The first divides the lights, top-down, and notes only how many go
// to each child; the second knows from that where every node lies and fills them in bottom-up. At the top of the tree
// the nodes of a level are divided in parallel, then the subtrees below: the result does not depend on the threads.
#include <algorithm>
#include <cassert>

#include "light/wide_light_tree.h"
#include "light/wide_split.h"
#include "math/parallel.h"

namespace tyndall {
namespace {

struct Range {
  std::uint32_t begin, count;
};

/// Division of a range of lights into the children of a node.
struct Shape {
  std::uint32_t begin;
  Division count;
};

/// Children of more than one light are nodes, or subtrees where they have few.
constexpr std::size_t kSmallSubtree = 4096, kSubtrees = 256;

/// f(child, range of lights) for the children that are nodes, in order.
template <typename F>
void for_each_inner(const Shape& shape, const F& f) {
  std::uint32_t begin = shape.begin;
  for (std::size_t i = 0; i < shape.count.size(); ++i) {
    if (shape.count[i] > 1) f(i, Range{begin, shape.count[i]});
    begin += shape.count[i];
  }
}

Shape divide(std::span<BuildLight> lights, Range range) {
  return {range.begin, divide(lights.subspan(range.begin, range.count))};
}

/// The nodes over a range, in preorder.
std::vector<Shape> divide_all(std::span<BuildLight> lights, Range all) {
  std::vector<Shape> shapes;
  std::vector<Range> waiting{all};
  while (!waiting.empty()) {
    const Range range = waiting.back();
    waiting.pop_back();
    const Shape& shape = shapes.emplace_back(divide(lights, range));
    const auto first = static_cast<std::ptrdiff_t>(waiting.size());
    for_each_inner(shape, [&](std::size_t, Range child) { waiting.push_back(child); });
    std::reverse(waiting.begin() + first, waiting.end());
  }
  return shapes;
}

/// The top of the tree level by level, and what is left below it, in order.
struct Top {
  std::vector<Shape> shapes;
  std::vector<Range> subtrees;
};

Top divide_top(std::span<BuildLight> lights, std::uint32_t limit, ThreadPool& pool) {
  Top top;
  std::vector<Range> level;
  const auto add = [&](Range range) { (range.count > limit ? level : top.subtrees).push_back(range); };
  add({0, static_cast<std::uint32_t>(lights.size())});
  while (!level.empty()) {
    std::vector<Shape> shapes(level.size());
    pool.for_each(level.size(), 1, [&](std::size_t i) { shapes[i] = divide(lights, level[i]); });
    level.clear();
    for (const Shape& shape : shapes) for_each_inner(shape, [&](std::size_t, Range child) { add(child); });
    top.shapes.insert(top.shapes.end(), shapes.begin(), shapes.end());
  }
  return top;
}

/// A node that has been filled, as its parent sees it.
struct Finished {
  Cluster cluster;
  std::uint32_t node;
  int depth;
};

}  // namespace

class WideTreeBuilder {
 public:
  WideTreeBuilder(WideLightTree& tree, std::vector<TreeLight> lights, std::span<const Cluster> clusters, int threads);
  void build();

 private:
  Cluster leaf_of(const BuildLight& light) const;
  Finished fill_subtree(const std::vector<Shape>& shapes, std::uint32_t first);
  Finished fill_top(const std::vector<Shape>& shapes, std::vector<Finished> subtrees, std::uint32_t limit);
  /// `inner` are the children that are nodes.
  Finished fill_node(const Shape& shape, std::uint32_t node, std::span<const Finished> inner);

  WideLightTree& tree_;
  ThreadPool pool_;
  BigArray<BuildLight> lights_;
  std::span<const Cluster> clusters_;  ///< lengths in the scene's unit
};

WideTreeBuilder::WideTreeBuilder(WideLightTree& tree, std::vector<TreeLight> lights, std::span<const Cluster> clusters,
                                 int threads)
    : tree_(tree), pool_(threads), lights_(lights.size()), clusters_(clusters) {
  double largest = 0;
  for (const TreeLight& light : lights) {
    tree_.intensity_ += light.bounds.intensity;
    for (int k = 0; k < 3; ++k)
      largest = std::max({largest, std::abs(double(light.bounds.box.min[k])), std::abs(double(light.bounds.box.max[k]))});
  }
  if (largest > 0) tree_.to_unit_ = std::ldexp(1.0, -std::ilogb(largest) - 1);
  pool_.for_each(lights.size(), 4096, [&](std::size_t i) {
    lights_[i] = BuildLight::from(lights[i], tree_.to_unit_ > 0 ? tree_.to_unit_ : 1, tree_.intensity_);
  });
  std::vector<TreeLight>().swap(lights);
}

Cluster WideTreeBuilder::leaf_of(const BuildLight& light) const {
  Cluster c = cluster_of(light.bounds());
  if (light.light < WideLightTree::kCluster) return c;
  const Cluster& whole = clusters_[light.light - WideLightTree::kCluster];
  c.count = whole.count;
  c.intensity_square = c.intensity * c.intensity * (whole.intensity_square / (whole.intensity * whole.intensity));
  c.mean = whole.mean * tree_.to_unit_;
  c.variance = whole.variance * tree_.to_unit_ * tree_.to_unit_;
  return c;
}

Finished WideTreeBuilder::fill_node(const Shape& shape, std::uint32_t node, std::span<const Finished> inner) {
  std::array<Cluster, WideNode::kWidth> clusters;
  std::array<std::uint32_t, WideNode::kWidth> children{};
  int depth = 1;
  std::uint32_t light = shape.begin;
  std::size_t size = 0;
  for (; size < WideNode::kWidth && shape.count[size] > 0; ++size) {
    if (shape.count[size] > 1) {
      clusters[size] = inner.front().cluster;
      children[size] = inner.front().node;
      tree_.nodes_[inner.front().node].parent = 8 * node + static_cast<std::uint32_t>(size);
      depth = std::max(depth, inner.front().depth + 1);
      inner = inner.subspan(1);
    } else {
      clusters[size] = leaf_of(lights_[light]);
      children[size] = lights_[light].light;
    }
    light += shape.count[size];
  }
  const auto used = std::span<const Cluster>(clusters).first(size);
  tree_.nodes_[node].set_children(used, std::span(children).first(size));
  for (std::size_t i = 0; i < size; ++i)
    if (shape.count[i] == 1) tree_.nodes_[node].flags[i] |= WideNode::kLeaf;  // of whole clusters too
  return {cluster_union(used), node, depth};
}

Finished WideTreeBuilder::fill_subtree(const std::vector<Shape>& shapes, std::uint32_t first) {
  // In reverse preorder a node's children are those that were finished last, and its first the very last.
  std::vector<Finished> finished;
  for (std::size_t i = shapes.size(); i-- > 0;) {
    std::array<Finished, WideNode::kWidth> inner;
    std::size_t size = 0;
    for_each_inner(shapes[i], [&](std::size_t, Range) {
      inner[size++] = finished.back();
      finished.pop_back();
    });
    finished.push_back(fill_node(shapes[i], first + static_cast<std::uint32_t>(i), std::span(inner).first(size)));
  }
  return finished.back();
}

Finished WideTreeBuilder::fill_top(const std::vector<Shape>& shapes, std::vector<Finished> subtrees, std::uint32_t limit) {
  // Level by level from the last: children were appended in the order of their parents, and are taken from the ends.
  if (shapes.empty()) return subtrees.front();
  std::vector<Finished> finished(shapes.size());
  std::size_t next = shapes.size();
  for (std::size_t i = shapes.size(); i-- > 0;) {
    std::array<Finished, WideNode::kWidth> inner;
    std::size_t size = 0, above = 0;
    for_each_inner(shapes[i], [&](std::size_t, Range child) {
      ++size;
      above += child.count > limit;
    });
    std::size_t top = next -= above, subtree = subtrees.size() - (size - above), k = 0;
    for_each_inner(shapes[i],
                   [&](std::size_t, Range child) { inner[k++] = child.count > limit ? finished[top++] : subtrees[subtree++]; });
    subtrees.resize(subtrees.size() - (size - above));
    finished[i] = fill_node(shapes[i], static_cast<std::uint32_t>(i), std::span(inner).first(size));
  }
  return finished.front();
}

void WideTreeBuilder::build() {
  const auto limit = static_cast<std::uint32_t>(std::max(lights_.size() / kSubtrees, kSmallSubtree));
  const Top top = divide_top(lights_, limit, pool_);
  std::vector<std::vector<Shape>> below(top.subtrees.size());
  pool_.for_each(below.size(), 1, [&](std::size_t i) { below[i] = divide_all(lights_, top.subtrees[i]); });

  std::vector<std::uint32_t> first(below.size() + 1, static_cast<std::uint32_t>(top.shapes.size()));
  for (std::size_t i = 0; i < below.size(); ++i) first[i + 1] = first[i] + static_cast<std::uint32_t>(below[i].size());
  tree_.nodes_ = BigArray<WideNode>(first.back());
  std::vector<Finished> finished(below.size());
  pool_.for_each(below.size(), 1, [&](std::size_t i) {
    finished[i] = fill_subtree(below[i], first[i]);
    below[i] = {};
  });
  const Finished root = fill_top(top.shapes, std::move(finished), limit);
  tree_.nodes_[0].parent = WideLightTree::kAll;
  tree_.all_ = root.cluster;
  tree_.depth_ = root.depth;
}

WideLightTree::WideLightTree(std::vector<TreeLight> lights, std::span<const Cluster> clusters, int threads) {
  assert(lights.size() <= 0x40000000);
  if (lights.empty()) return;
  WideTreeBuilder(*this, std::move(lights), clusters, threads).build();
}

}  // namespace tyndall
