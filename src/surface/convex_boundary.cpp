#include "surface/convex_boundary.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace tyndall {
namespace {

/// Beyond, a hierarchy of triangles is as fast.
constexpr std::size_t kMostPlanes = 32, kMostTriangles = 64;
/// Vertices may be this far off a plane, relative to coordinates: two roundings.
constexpr double kRounding = 0x1p-23;

using Triangle = std::array<Vec3d, 3>;

std::vector<Triangle> triangles_of(const PlacedMesh& mesh) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; 3 * i < mesh.indices->size(); ++i) {
    const auto c = mesh.corners<3>(i);
    triangles.push_back({mesh.position(c[0]), mesh.position(c[1]), mesh.position(c[2])});
  }
  return triangles;
}

/// How far coordinates reach, which their roundings go with.
double reach_of(const std::vector<Triangle>& triangles) {
  double reach = 0;
  for (const Triangle& t : triangles) {
    for (const Vec3d& p : t) reach = std::max(reach, max_component(abs(p)));
  }
  return reach;
}

Vec3d center_of(const std::vector<Triangle>& triangles) {
  Vec3d sum;
  for (const Triangle& t : triangles) sum = sum + t[0] + t[1] + t[2];
  return sum * (1.0 / static_cast<double>(3 * triangles.size()));
}

/// Each edge is passed once in either direction.
bool is_closed(const std::vector<Triangle>& triangles) {
  using Point = std::tuple<double, double, double>;
  std::map<std::pair<Point, Point>, int> edges;
  const auto key = [](Vec3d p) { return Point(p.x, p.y, p.z); };
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{key(t[i]), key(t[(i + 1) % 3])}];
  }
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto back = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != edges.end();
  });
}

}  // namespace

std::optional<ConvexBoundary> ConvexBoundary::of(const PlacedMesh& mesh) {
  if (mesh.indices->empty() || mesh.indices->size() > 3 * kMostTriangles) return {};
  const std::vector<Triangle> triangles = triangles_of(mesh);
  if (!is_closed(triangles)) return {};
  const Vec3d center = center_of(triangles);
  const double rounding = kRounding * reach_of(triangles);
  ConvexBoundary boundary(center);
  double side = 0;  // of the first triangle: the winding of all
  for (const Triangle& t : triangles) {
    const Vec3d winding = cross(t[1] - t[0], t[2] - t[0]);
    const double area = length(winding), h = dot(winding, t[0] - center);
    if (!(area > 0) || h == 0 || h * side < 0) return {};
    side = h;
    if (std::abs(h) <= 4 * rounding * area) return {};  // as thin as its vertices are exact
    if (!boundary.has(t, rounding)) boundary.planes_.push_back({winding * ((h < 0 ? -1 : 1) / area), std::abs(h) / area});
  }
  if (boundary.planes_.size() > kMostPlanes) return {};
  const bool convex =
      std::all_of(triangles.begin(), triangles.end(), [&](const Triangle& t) { return boundary.holds(t, rounding); });
  return convex ? std::optional(std::move(boundary)) : std::nullopt;
}

bool ConvexBoundary::holds(const Triangle& triangle, double rounding) const {
  return std::all_of(triangle.begin(), triangle.end(), [&](Vec3d p) {
    return std::all_of(planes_.begin(), planes_.end(),
                       [&](const Plane& plane) { return dot(plane.n, p - center_) <= plane.h + rounding; });
  });
}

bool ConvexBoundary::has(const Triangle& triangle, double rounding) const {
  return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    return std::all_of(triangle.begin(), triangle.end(),
                       [&](Vec3d p) { return std::abs(dot(plane.n, p - center_) - plane.h) <= rounding; });
  });
}

// [Cyrus and Beck 1978]: the last plane that is entered, the first that is left. The sign of t is that of the distance from
// the plane, in whatever direction the ray goes.
std::optional<ConvexBoundary::Passage> ConvexBoundary::passage(const ShapeRay& ray) const {
  Passage passage{-kInfinity, kInfinity, 0, 0};
  const Vec3d o = ray.o - center_;
  for (const Plane& plane : planes_) {
    const double inward = plane.h - dot(plane.n, o), slope = dot(plane.n, ray.d);
    if (slope == 0) {
      if (!(inward > 0)) return {};
      continue;
    }
    const double t = inward / slope;
    if (slope > 0 && t < passage.leaves) {
      passage.leaves = t;
      passage.leaves_cosine = slope;
    } else if (slope < 0 && t > passage.enters) {
      passage.enters = t;
      passage.enters_cosine = -slope;
    }
  }
  if (!(passage.enters < passage.leaves)) return {};
  const double scale = 1 / length(ray.d);
  passage.enters_cosine *= scale;
  passage.leaves_cosine *= scale;
  return passage;
}

}  // namespace tyndall
