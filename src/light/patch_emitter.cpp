#include "light/patch_emitter.h"

#include "math/spherical.h"

namespace tyndall {
namespace {

constexpr double kSmallest = 1e-8;  ///< solid angles from which directions are drawn

/// Weights at the corners (0,0) (1,0) (0,1) (1,1) of the unit square, in proportion to which (u, v) is drawn:
/// the patch's area per du dv there.
using Corners = std::array<double, 4>;

double sum(const Corners& w) { return w[0] + w[1] + w[2] + w[3]; }

/// x in [0, 1] with density in proportion to (1 - x) a + x b.
double sample_linear(double u, double a, double b) {
  const double root = std::sqrt((1 - u) * a * a + u * b * b);
  return a + root > 0 ? std::min(u * (a + b) / (a + root), 1.0) : u;
}

std::array<double, 2> sample_bilinear(Vec2 u, const Corners& w) {
  const double v = sample_linear(u.y, w[0] + w[1], w[2] + w[3]);
  return {sample_linear(u.x, (1 - v) * w[0] + v * w[2], (1 - v) * w[1] + v * w[3]), v};
}

double bilinear_pdf(double u, double v, const Corners& w) {
  return 4 * ((1 - v) * ((1 - u) * w[0] + u * w[1]) + v * ((1 - u) * w[2] + u * w[3])) / sum(w);
}

template <typename Form>
Corners corner_areas(const Form& f) {
  return {length(f.normal(0, 0)), length(f.normal(1, 0)), length(f.normal(0, 1)), length(f.normal(1, 1))};
}

}  // namespace

PatchEmitter::PatchEmitter(const BilinearMesh& mesh, const Transform& to_world, bool reverse_orientation, bool with_uvs) {
  const bool flip = reverse_orientation != to_world.swaps_handedness();
  const std::size_t count = mesh.indices.size() / 4;
  for (std::size_t i = 0; i < 4 * count; ++i) positions_.push_back(to_world.point(mesh.positions[mesh.indices[i]]));
  if (with_uvs && !mesh.uvs.empty())
    for (std::size_t i = 0; i < 4 * count; ++i) uvs_.push_back(mesh.uvs[mesh.indices[i]]);

  for (std::uint32_t i = 0; i < count; ++i) {
    const Form f = form(i, {});
    const double lu = length(f.eu), lv = length(f.ev);
    rectangle_.push_back(lu > 0 && lv > 0 && std::abs(dot(f.eu, f.ev)) <= 1e-5 * lu * lv &&
                         length(f.euv) <= 1e-5 * std::min(lu, lv));
    flipped_.push_back(flip);
    if (mesh.normals.empty()) continue;
    Vec3 shading;
    for (std::size_t k = 0; k < 4; ++k) shading += to_world.normal(mesh.normals[mesh.indices[4 * i + k]]);
    flipped_[i] = (dot(f.normal(0.5, 0.5), Vec3d(shading)) < 0) != reverse_orientation;
  }
}

PatchEmitter::Form PatchEmitter::form(std::uint32_t i, Vec3d observer) const {
  const Vec3* p = &positions_[4 * std::size_t(i)];
  const Vec3d p00(p[0]), p10(p[1]), p01(p[2]), p11(p[3]);
  return {p00 - observer, p10 - p00, p01 - p00, (p11 - p01) - (p10 - p00)};
}

double PatchEmitter::area(std::uint32_t i) const {
  // Gauss-Legendre, 4 x 4 points: exact for planar convex patches, whose normal's length is affine.
  constexpr std::array<double, 4> x{0.069431844202973712, 0.330009478207571868, 0.669990521792428132, 0.930568155797026288};
  constexpr std::array<double, 4> w{0.173927422568726929, 0.326072577431273071, 0.326072577431273071, 0.173927422568726929};
  const Form f = form(i, {});
  double area = 0;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < 4; ++b) area += w[a] * w[b] * length(f.normal(x[a], x[b]));
  return area;
}

EmitterExtent PatchEmitter::extent(std::uint32_t i) const {
  EmitterExtent extent;
  for (std::size_t k = 0; k < 4; ++k) extent.box.expand(positions_[4 * std::size_t(i) + k]);

  // Normals are affine combinations of those at the corners: a cone below 90 degrees that holds these holds all.
  const Form f = form(i, {});
  for (const auto& [u, v] : {std::array{0., 0.}, std::array{1., 0.}, std::array{0., 1.}, std::array{1., 1.}}) {
    const Vec3d n = outward(i, f.normal(u, v));
    if (length(n) > 0)
      extent.normals = cone_union(extent.normals, DirectionCone::around(to_vec3(normalize(n)), rectangle_[i] ? 2e-5f : 0));
  }
  if (extent.normals.empty() || extent.normals.theta > 0.49f * kPi) extent.normals = DirectionCone::everything();
  return extent;
}

LightPlace PatchEmitter::place(std::uint32_t i) const {
  if (!rectangle_[i]) return place_of(extent(i).box);
  return flat_place({&positions_[4 * std::size_t(i)], 4}, to_vec3(normalize(outward(i, form(i, {}).normal(0.5, 0.5)))));
}

Vec2 PatchEmitter::uv(std::uint32_t i, double u, double v) const {
  const auto x = static_cast<float>(u), y = static_cast<float>(v);
  if (uvs_.empty()) return {x, y};
  const Vec2* uv = &uvs_[4 * std::size_t(i)];
  return (uv[0] * (1 - x) + uv[1] * x) * (1 - y) + (uv[2] * (1 - x) + uv[3] * x) * y;
}

std::optional<EmitterSample> PatchEmitter::sample(std::uint32_t i, const RoundedPoint& p, Vec2 u) const {
  const Form f = form(i, p.at);
  if (rectangle_[i]) {
    if (f.is_seen_edge_on(p)) return std::nullopt;
    const SphericalRectangle rectangle(f.p00, f.eu, f.ev);
    if (rectangle.solid_angle() > kSmallest) {
      const auto [x, st] = rectangle.sample(u);
      const double distance = length(x);
      const Vec3d n = normalize(outward(i, cross(f.eu, f.ev)));
      if (!(distance > 0)) return std::nullopt;
      return EmitterSample{to_vec3(x / distance), static_cast<float>(distance), to_vec3(n), uv(i, st.x, st.y),
                           static_cast<float>(1 / rectangle.solid_angle())};
    }
  }

  const Corners weights = corner_areas(f);
  if (!(sum(weights) > 0)) return std::nullopt;
  const auto [s, t] = sample_bilinear(u, weights);
  const Vec3d x = f.point(s, t), n = f.normal(s, t);
  if (!(length(n) > 0)) return std::nullopt;
  const auto pdf = solid_angle_density(bilinear_pdf(s, t, weights) / length(n), x, n);
  if (!pdf) return std::nullopt;
  return EmitterSample{to_vec3(normalize(x)), static_cast<float>(length(x)), to_vec3(normalize(outward(i, n))), uv(i, s, t),
                       *pdf};
}

float PatchEmitter::pdf(std::uint32_t i, const RoundedPoint& p, const RoundedPoint& hit) const {
  const Form f = form(i, p.at);
  if (rectangle_[i]) {
    if (f.is_seen_edge_on(p)) return 0;
    const SphericalRectangle rectangle(f.p00, f.eu, f.ev);
    if (rectangle.solid_angle() > kSmallest) return static_cast<float>(1 / rectangle.solid_angle());
  }
  const Corners weights = corner_areas(f);
  if (!(sum(weights) > 0)) return 0;
  const Vec3d x = hit.at - p.at;
  const auto [s, t] = f.invert(x);
  const Vec3d n = f.normal(s, t);
  if (!(length(n) > 0)) return 0;
  return solid_angle_density(bilinear_pdf(s, t, weights) / length(n), x, n).value_or(0.0f);
}

// (p00 - p + v ev) is parallel to (eu + v euv) where P(u, v) = p: each component of their cross product is a quadratic
// in v. The component along the mean normal is the well-conditioned one.
std::array<double, 2> PatchEmitter::Form::invert(Vec3d p) const {
  const Vec3d d = p00 - p, m = normal(0.5, 0.5);
  const double a = dot(cross(ev, euv), m), b = dot(cross(d, euv) + cross(ev, eu), m), c = dot(cross(d, eu), m);
  const double discriminant = std::sqrt(std::max(0.0, b * b - 4 * a * c));
  const double q = -0.5 * (b + std::copysign(discriminant, b));

  // The root whose point lies nearest to p; both may be in range where the patch folds over.
  std::array<double, 2> best{0.5, 0.5};
  double best_error = kInfinity;
  const auto ratio = [](double x, double y) { return y != 0 ? x / y : double{kInfinity}; };
  for (const double root : {ratio(q, a), ratio(c, q)}) {
    if (!std::isfinite(root)) continue;
    const double v = std::clamp(root, 0.0, 1.0);
    const Vec3d side = eu + euv * v, offset = d + ev * v;
    const double s2 = dot(side, side);
    const double u = s2 > 0 ? std::clamp(-dot(offset, side) / s2, 0.0, 1.0) : 0.5;
    const double error = length(point(u, v) - p);
    if (error < best_error) {
      best = {u, v};
      best_error = error;
    }
  }
  return best;
}

std::size_t PatchEmitter::memory_bytes() const {
  return positions_.capacity() * sizeof(Vec3) + uvs_.capacity() * sizeof(Vec2) +
         (flipped_.capacity() + rectangle_.capacity()) / 8;
}

}  // namespace tyndall
