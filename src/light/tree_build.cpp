// Construction of the light tree: top-down splits by the surface area orientation heuristic, then bounds bottom-up.
#include <array>
#include <cassert>

#include "light/light_tree.h"

namespace tyndall {
namespace {

constexpr int kBuckets = 12;
using Range = std::span<TreeLight>;

double coordinate(const TreeLight& light, int axis) {
  return 0.5 * light.bounds.box.min[axis] + 0.5 * light.bounds.box.max[axis];
}

/// The lights' centres along one axis, cut into equal buckets.
struct Buckets {
  int axis = 0;
  double low = kInfinity, high = -kInfinity;

  bool flat() const { return !(high > low); }
  int of(const TreeLight& light) const {
    const double x = (coordinate(light, axis) - low) / (high - low);
    return std::clamp(static_cast<int>(x * kBuckets), 0, kBuckets - 1);
  }
};

struct Split {
  Buckets buckets;
  int last = 0;  ///< last bucket of the first child
  double cost = 0;
};

double measure(const LightBounds& b) { return b.intensity * size_measure(b.box) * orientation_measure(b); }

std::array<Buckets, 3> make_buckets(Range lights) {
  std::array<Buckets, 3> buckets;
  for (int axis = 0; axis < 3; ++axis) {
    Buckets& b = buckets[axis];
    b.axis = axis;
    for (const TreeLight& light : lights) {
      const double x = coordinate(light, axis);
      b.low = std::min(b.low, x);
      b.high = std::max(b.high, x);
    }
  }
  return buckets;
}

/// The cheapest cut between the buckets of one axis, by unions from both ends.
Split best_cut(const Buckets& buckets, const std::array<LightBounds, kBuckets>& content) {
  // An empty bucket changes no union, and to cut on either side of it is the same.
  std::array<double, kBuckets> before{};
  LightBounds prefix;
  for (int i = 0; i < kBuckets - 1; ++i) {
    if (content[i].box.empty()) {
      before[i] = i > 0 ? before[i - 1] : 0;
      continue;
    }
    expand(prefix, content[i]);
    before[i] = measure(prefix);
  }
  Split best{buckets, 0, kInfinity};
  LightBounds suffix;
  for (int i = kBuckets - 1; i > 0; --i) {
    if (content[i].box.empty()) continue;
    expand(suffix, content[i]);
    const double cost = before[i - 1] + measure(suffix);
    if (cost < best.cost) best = {buckets, i - 1, cost};
  }
  return best;
}

/// Nothing when all centres coincide.
std::optional<Split> find_split(Range lights) {
  const std::array<Buckets, 3> buckets = make_buckets(lights);
  std::array<std::array<LightBounds, kBuckets>, 3> content;
  Bounds3 box;
  for (const TreeLight& light : lights) {
    box.expand(light.bounds.box);
    for (int axis = 0; axis < 3; ++axis) {
      if (buckets[axis].flat()) continue;
      expand(content[axis][buckets[axis].of(light)], light.bounds);
    }
  }

  // Cuts across short sides make slivers: they cost in proportion to the longest side over this one.
  double longest = 0;
  for (int axis = 0; axis < 3; ++axis) longest = std::max(longest, double(box.max[axis]) - box.min[axis]);
  std::optional<Split> best;
  for (int axis = 0; axis < 3; ++axis) {
    if (buckets[axis].flat()) continue;
    Split split = best_cut(buckets[axis], content[axis]);
    split.cost *= longest / (double(box.max[axis]) - box.min[axis]);
    if (!best || split.cost < best->cost) best = split;
  }
  return best;
}

/// Reorders the lights and gives the number of those in the first child; in half when nothing tells them apart.
std::size_t partition(Range lights) {
  if (lights.size() == 2) return 1;
  if (const auto split = find_split(lights)) {
    const auto middle = std::partition(lights.begin(), lights.end(),
                                       [&](const TreeLight& light) { return split->buckets.of(light) <= split->last; });
    const auto count = static_cast<std::size_t>(middle - lights.begin());
    if (count > 0 && count < lights.size()) return count;
  }
  return lights.size() / 2;
}

/// A part of the lights that has yet to become a node.
struct Task {
  std::size_t begin, end;
  std::uint32_t parent;
  bool second;
  int depth;
};

/// Bounds of every node from those of its children. In reverse preorder both children of a node are the last two that
/// were finished, so that a short stack holds all that is needed.
void fill_bounds(std::vector<LightTree::Node>& nodes, std::vector<TreeLight>& lights) {
  std::vector<LightBounds> finished;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    LightTree::Node& node = nodes[i];
    if (node.leaf) {
      finished.push_back(lights.back().bounds);
      lights.pop_back();
    } else {
      const LightBounds first = finished.back();
      finished.pop_back();
      finished.back() = bounds_union(first, finished.back());
    }
    node.bounds = ClusterBounds::from(finished.back());
    node.two_sided = finished.back().two_sided;
  }
}

}  // namespace

LightTree::LightTree(std::vector<TreeLight> lights, ChildRule rule) : rule_(rule) {
  assert(lights.size() < kNoParent / 2);
  if (lights.empty()) return;

  // Relative intensities cannot overflow in sums, and the least of them does not round to "none".
  for (const TreeLight& light : lights) intensity_ += light.bounds.intensity;
  for (TreeLight& light : lights) {
    const double relative = light.bounds.intensity / intensity_;
    light.bounds.intensity = std::max(static_cast<float>(relative), 1e-37f);
  }

  // First children are finished before second ones: preorder, and leaves in the lights' final order.
  nodes_.reserve(2 * lights.size() - 1);
  std::vector<Task> tasks{{0, lights.size(), kNoParent, false, 0}};
  while (!tasks.empty()) {
    const Task task = tasks.back();
    tasks.pop_back();
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    Node& node = nodes_.emplace_back();
    node.parent = task.parent;
    if (task.second) nodes_[task.parent].second_or_light = index;
    depth_ = std::max(depth_, task.depth);

    if (task.end - task.begin == 1) {
      node.leaf = 1;
      node.second_or_light = lights[task.begin].light;
      continue;
    }
    const std::size_t middle = task.begin + partition(Range(lights).subspan(task.begin, task.end - task.begin));
    tasks.push_back({middle, task.end, index, true, task.depth + 1});
    tasks.push_back({task.begin, middle, index, false, task.depth + 1});
  }
  fill_bounds(nodes_, lights);
}

}  // namespace tyndall
