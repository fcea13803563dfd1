#include "light/cell_densities.h"

#include <array>
#include <cmath>

#include "light/tree_cut.h"
#include "math/parallel.h"

namespace tyndall {
namespace {

constexpr std::size_t kFacets = 7, kNoNormal = 6;
constexpr std::size_t kMostBoxes = 16;  ///< along the longest side
/// Of a cell: more make no choice better than the tree below them does.
constexpr CutGoal kCellGoal{.error = 0.02, .nodes = 64};

/// Boxes along the longest side: about eight to a light, up to 4,096.
std::size_t boxes_along(double lights) {
  return static_cast<std::size_t>(std::clamp(2 * std::cbrt(lights), 2.0, double{kMostBoxes}));
}

/// Where lights look different from place to place: within half a diagonal of them.
Bounds3 near_lights(const LightTree& tree, const Bounds3& region) {
  if (tree.empty()) return {};
  Bounds3 box = tree.nodes()[0].bounds.box;
  const auto grown = static_cast<float>(0.5 * length(Vec3d(box.max) - Vec3d(box.min)));
  box.min = box.min - Vec3{grown, grown, grown};
  box.max = box.max + Vec3{grown, grown, grown};
  if (!region.empty()) {
    box.min = max(box.min, region.min);
    box.max = min(box.max, region.max);
  }
  const double diagonal = length(Vec3d(box.max) - Vec3d(box.min));
  return box.empty() || !(diagonal > 0) || !std::isfinite(diagonal) ? Bounds3{} : box;
}

double side(const Bounds3& box, int axis) { return double{box.max[axis]} - box.min[axis]; }

std::size_t facet_of(const PointQuery& query) {
  const Vec3 n = query.n;
  if (query.transmissive || !(dot(n, n) > 0)) return kNoNormal;
  int axis = std::abs(n.y) > std::abs(n.x) ? 1 : 0;
  if (std::abs(n.z) > std::abs(n[axis])) axis = 2;
  return 2 * static_cast<std::size_t>(axis) + (n[axis] < 0 ? 1 : 0);
}

/// One of four normals within a facet.
Vec3 normal_in(std::size_t facet, bool first, bool second) {
  constexpr float kGauss = 0.57735027f;  // nodes of the rule with two points on [-1, 1]
  const int axis = static_cast<int>(facet / 2);
  Vec3 n;
  n[axis] = facet % 2 ? -1.0f : 1.0f;
  n[(axis + 1) % 3] = first ? kGauss : -kGauss;
  n[(axis + 2) % 3] = second ? kGauss : -kGauss;
  return normalize(n);
}

}  // namespace

CellDensities::CellDensities(const LightTree& tree, const FarLights& far, const Bounds3& region, int threads)
    : box_(near_lights(tree, region)) {
  if (box_.empty()) return;
  const double lights = 0.5 * static_cast<double>(tree.nodes().size() + 1);
  const double longest = std::max({side(box_, 0), side(box_, 1), side(box_, 2)});
  const auto along = static_cast<double>(boxes_along(lights));
  for (int axis = 0; axis < 3; ++axis)
    resolution_[axis] = static_cast<std::size_t>(std::max(std::ceil(along * side(box_, axis) / longest), 1.0));

  std::vector<std::vector<Cluster>> cells(boxes() * kFacets);
  ThreadPool(threads).for_each(cells.size(), 16, [&](std::size_t cell) { cells[cell] = integrate(tree, far, cell); });
  begins_.reserve(cells.size() + 1);
  std::size_t total = 0;
  for (const auto& cell : cells) total += cell.size();
  clusters_.reserve(total);
  for (const auto& cell : cells) {
    begins_.push_back(static_cast<std::uint32_t>(clusters_.size()));
    clusters_.insert(clusters_.end(), cell.begin(), cell.end());
  }
  begins_.push_back(static_cast<std::uint32_t>(clusters_.size()));
}

/// Eight points of the cell's box, by Gauss' rule with two along each axis; of a facet with normals that vary over it, every
/// pair of a coordinate and a direction alike.
std::array<PointQuery, 8> CellDensities::questions_in(std::size_t cell) const {
  const std::size_t facet = cell % kFacets, box = cell / kFacets;
  const std::array<std::size_t, 3> at{box % resolution_[0], box / resolution_[0] % resolution_[1],
                                      box / (resolution_[0] * resolution_[1])};
  std::array<PointQuery, 8> questions;
  for (unsigned i = 0; i < 8; ++i) {
    constexpr double kLow = 0.21132487, kHigh = 0.78867513;
    const std::array<bool, 3> high{(i & 1) != 0, (i & 2) != 0, (i & 4) != 0};
    for (int axis = 0; axis < 3; ++axis) {
      const double place =
          (static_cast<double>(at[axis]) + (high[axis] ? kHigh : kLow)) / static_cast<double>(resolution_[axis]);
      questions[i].p[axis] = static_cast<float>(box_.min[axis] + place * side(box_, axis));
    }
    if (facet != kNoNormal) questions[i].n = normal_in(facet, high[0] != high[1], high[1] != high[2]);
  }
  return questions;
}

std::vector<CellDensities::Cluster> CellDensities::integrate(const LightTree& tree, const FarLights& far,
                                                             std::size_t cell) const {
  const auto questions = questions_in(cell);
  const auto mean_of = [&](const auto& value) {
    double sum = 0;
    for (const PointQuery& q : questions) sum += value(q) / 8;
    return sum;
  };
  const auto nodes = tree.nodes();
  const auto measure = [&](std::uint32_t node) -> CutMeasure {
    const LightTree::Node& n = nodes[node];
    const double mean = tree.intensity() * mean_of([&](const PointQuery& q) { return importance(n.bounds, n.two_sided, q); });
    return {mean, mean};
  };
  CutGoal goal = kCellGoal;
  goal.beside = mean_of([&](const PointQuery& q) { return far.importance(q); });

  std::vector<CutNode> parts = refined_cut(tree, goal, measure);
  if (goal.beside > 0) parts.push_back({{goal.beside, goal.beside}, kLightsAtInfinity});
  double total = 0, below = 0;
  for (const CutNode& part : parts) total += part.estimate;
  std::vector<Cluster> clusters;
  if (!(total > 0) || !std::isfinite(total)) return clusters;
  for (const CutNode& part : parts) clusters.push_back({part.node, static_cast<float>((below += part.estimate) / total)});
  clusters.back().below = 1;
  return clusters;
}

std::span<const CellDensities::Cluster> CellDensities::at(const PointQuery& query) const {
  if (box_.empty() || !box_.contains(query.p)) return {};
  std::array<std::size_t, 3> at{};
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = side(box_, axis), n = static_cast<double>(resolution_[axis]);
    const double place = extent > 0 ? (double{query.p[axis]} - box_.min[axis]) / extent * n : 0;
    at[axis] = std::min(static_cast<std::size_t>(place), resolution_[axis] - 1);
  }
  const std::size_t box = (at[2] * resolution_[1] + at[1]) * resolution_[0] + at[0], cell = box * kFacets + facet_of(query);
  return {clusters_.data() + begins_[cell], clusters_.data() + begins_[cell + 1]};
}

std::size_t CellDensities::most_bytes(double lights) {
  const auto along = static_cast<double>(boxes_along(lights));
  // While they are built they are kept twice.
  const double of_cell = 2 * (std::min(lights, double{kCellGoal.nodes}) + 1) * sizeof(Cluster) + sizeof(std::vector<Cluster>);
  return static_cast<std::size_t>(along * along * along * kFacets * of_cell);
}

}  // namespace tyndall
