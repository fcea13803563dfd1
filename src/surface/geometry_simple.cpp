#include <algorithm>

#include "surface/geometry_impl.h"

namespace tyndall {
namespace {

/// Each costs every ray a few planes or one quadric; a hierarchy over more is faster.
constexpr std::size_t kMostSimple = 8;

std::optional<SimpleBoundary> as_simple(const Part& part, std::uint32_t group) {
  const auto* mesh = std::get_if<PlacedMesh>(&part.form);
  if (!mesh) return SimpleBoundary{&part, group, {}};
  if (part.is_patch) return {};
  auto convex = ConvexBoundary::of(*mesh);
  if (!convex) return {};
  return SimpleBoundary{&part, group, std::move(convex)};
}

}  // namespace

/// Of the world's parts, whose places in placed() are the first.
void GeometryImpl::find_simple_boundaries() {
  std::vector<int> parts_of(groups.size(), 0);
  for (const PlacedShape& shape : placed) {
    if (shape.group != kNone) ++parts_of[shape.group];
  }
  for (const Part& part : sets.front()->parts) {
    const std::uint32_t group = placed[part.index].group;
    if (group == kNone || part.real || parts_of[group] > 1) continue;
    if (auto boundary = as_simple(part, group)) simple.push_back(std::move(*boundary));
    if (simple.size() > kMostSimple) return simple.clear();
  }
}

/// What is convex is entered and left as a solid, whichever way its normals point: a group that is closed is turned by them.
void SimpleBoundary::record(const GeometryImpl& impl, const RTCRay& ray, BoundaryRecords& records) const {
  const ShapeRay line = ray_toward(*part, ray);
  const auto add = [&](double t, double cosine, std::uint32_t side, int sign) {
    if (t > ray.tnear && t < ray.tfar) records.push_back({t, cosine, group, part->index, side, sign});
  };
  if (!convex) {
    for (const ShapeRoot& root : part->intersect(0, line)) {
      add(root.t, root.cosine, 0, boundary_sign(impl, *part, 0, group, root.facing));
    }
  } else if (const auto passage = convex->passage(line)) {
    add(passage->enters, passage->enters_cosine, 0, 1);
    add(passage->leaves, passage->leaves_cosine, 1, -1);
  }
}

}  // namespace tyndall
