#include "light/triangle_emitter.h"

#include "math/spherical.h"

namespace tyndall {
namespace {

/// Solid angles that directions are drawn from; beyond them double precision runs out, or the observer is in the
/// triangle's plane.
constexpr double kSmallest = 1e-9, kLargest = 6.2831;

/// Seen from so far that points uniform in area are nearly uniform in solid angle: the angle under which its longest edges are
/// seen is below a fifth. Spherical geometry is much more expensive and would gain nothing (docs/measurements.md).
bool far_off(const Vec3d& a, const Vec3d& e1, const Vec3d& e2) { return std::max(dot(e1, e1), dot(e2, e2)) < 0.04 * dot(a, a); }

/// 1/sr, of the direction to a point `x` uniform over the triangle with n = e1 x e2, twice its area long.
std::optional<float> area_density(const Vec3d& x, const Vec3d& n) {
  const double d2 = dot(x, x), pdf = 2 * d2 * std::sqrt(d2) / std::abs(dot(n, x));
  if (!(pdf > 0) || !(pdf < std::numeric_limits<float>::max())) return std::nullopt;
  return static_cast<float>(pdf);
}

bool by_solid_angle(double solid_angle) { return solid_angle > kSmallest && solid_angle < kLargest; }

}  // namespace

TriangleEmitter::TriangleEmitter(const TriangleMesh& mesh, const Transform& to_world, bool reverse_orientation, bool with_uvs) {
  const bool flip = reverse_orientation != to_world.swaps_handedness();
  const std::size_t count = mesh.indices.size() / 3;
  positions_.reserve(3 * count);
  for (std::size_t i = 0; i < 3 * count; ++i) positions_.push_back(to_world.point(mesh.positions[mesh.indices[i]]));
  if (with_uvs && !mesh.uvs.empty())
    for (std::size_t i = 0; i < 3 * count; ++i) uvs_.push_back(mesh.uvs[mesh.indices[i]]);

  // Vertex normals, where there are any, decide which side is the outer one.
  flipped_.assign(count, flip);
  if (mesh.normals.empty()) return;
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = [&](std::size_t k) { return to_world.normal(mesh.normals[mesh.indices[3 * i + k]]); };
    const Vec3 shading = (n(0) + n(1) + n(2)) * (reverse_orientation ? -1.0f : 1.0f);
    flipped_[i] = false;
    flipped_[i] = dot(normal(static_cast<std::uint32_t>(i)), shading) < 0;
  }
}

Vec3 TriangleEmitter::oriented(std::uint32_t i, const Vec3d& n) const {
  const Vec3d unit = n * ((flipped_[i] ? -1 : 1) / length(n));
  return to_vec3(unit);
}

Vec3 TriangleEmitter::normal(std::uint32_t i) const {
  const Vec3d a = vertex(i, 0);
  return oriented(i, cross(vertex(i, 1) - a, vertex(i, 2) - a));
}

double TriangleEmitter::area(std::uint32_t i) const {
  const Vec3d a = vertex(i, 0);
  return 0.5 * length(cross(vertex(i, 1) - a, vertex(i, 2) - a));
}

Bounds3 TriangleEmitter::box(std::uint32_t i) const {
  Bounds3 box;
  for (std::size_t k = 0; k < 3; ++k) box.expand(positions_[3 * std::size_t(i) + k]);
  return box;
}

EmitterExtent TriangleEmitter::extent(std::uint32_t i) const { return {box(i), DirectionCone::around(normal(i))}; }

LightPlace TriangleEmitter::place(std::uint32_t i) const { return flat_place({&positions_[3 * std::size_t(i)], 3}, normal(i)); }

Vec2 TriangleEmitter::uv(std::uint32_t i, double b1, double b2) const {
  const auto x = static_cast<float>(b1), y = static_cast<float>(b2);
  if (uvs_.empty()) return {x + y, y};
  const Vec2* uv = &uvs_[3 * std::size_t(i)];
  return uv[0] * (1 - x - y) + uv[1] * x + uv[2] * y;
}

std::optional<EmitterSample> TriangleEmitter::sample(std::uint32_t i, const RoundedPoint& p, Vec2 u) const {
  const Vec3d a = vertex(i, 0) - p.at, b = vertex(i, 1) - p.at, c = vertex(i, 2) - p.at;
  const Vec3d e1 = b - a, e2 = c - a, n = cross(e1, e2);
  const double n2 = dot(n, n);
  if (!(n2 > 0) || in_plane(p, a, n)) return std::nullopt;
  if (far_off(a, e1, e2)) return sample_area(i, a, e1, e2, u);
  const SphericalTriangle triangle(a, b, c);

  if (by_solid_angle(triangle.solid_angle())) {
    // The point under the direction; seen at a grazing angle rounding could place it outside the triangle.
    const Vec3d w = triangle.sample(u);
    const Vec3d h = w * (dot(a, n) / dot(w, n)) - a;
    const double b1 = std::clamp(dot(cross(h, e2), n) / n2, 0.0, 1.0);
    const double b2 = std::clamp(dot(cross(e1, h), n) / n2, 0.0, 1.0 - b1);
    const double distance = length(a + e1 * b1 + e2 * b2);
    if (!std::isfinite(distance)) return std::nullopt;
    return EmitterSample{to_vec3(w), static_cast<float>(distance), oriented(i, n), uv(i, b1, b2),
                         static_cast<float>(1 / triangle.solid_angle())};
  }

  return sample_area(i, a, e1, e2, u);
}

std::optional<EmitterSample> TriangleEmitter::sample_area(std::uint32_t i, const Vec3d& a, const Vec3d& e1, const Vec3d& e2,
                                                          Vec2 u) const {
  const double root = std::sqrt(static_cast<double>(u.x));
  const double b1 = root * (1 - u.y), b2 = root * u.y;
  const Vec3d x = a + e1 * b1 + e2 * b2, n = cross(e1, e2);
  const auto pdf = area_density(x, n);
  if (!pdf) return std::nullopt;
  const double distance = length(x);
  return EmitterSample{to_vec3(x / distance), static_cast<float>(distance), oriented(i, n), uv(i, b1, b2), *pdf};
}

float TriangleEmitter::pdf(std::uint32_t i, const RoundedPoint& p, const RoundedPoint& hit) const {
  const Vec3d a = vertex(i, 0) - p.at, b = vertex(i, 1) - p.at, c = vertex(i, 2) - p.at;
  const Vec3d e1 = b - a, e2 = c - a, n = cross(e1, e2);
  if (!(dot(n, n) > 0) || in_plane(p, a, n)) return 0;
  if (far_off(a, e1, e2)) return area_density(hit.at - p.at, n).value_or(0.0f);
  const SphericalTriangle triangle(a, b, c);
  if (by_solid_angle(triangle.solid_angle())) return static_cast<float>(1 / triangle.solid_angle());
  return area_density(hit.at - p.at, n).value_or(0.0f);
}

std::size_t TriangleEmitter::memory_bytes() const {
  return positions_.capacity() * sizeof(Vec3) + uvs_.capacity() * sizeof(Vec2) + flipped_.capacity() / 8;
}

}  // namespace tyndall
