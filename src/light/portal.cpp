#include "light/portal.h"

#include <algorithm>
#include <numbers>

#include "tyndall/error.h"

namespace tyndall {
namespace {

constexpr double kPi2 = std::numbers::pi * std::numbers::pi;
/// Cells of the density along a side, at least: the solid angle of a cell varies within it.
constexpr int kFinest = 64;
constexpr double kSquare = 1e-3;  ///< cosine that edges may be off a right angle, as in pbrt

/// Solid angle per area of (u, v), where u and v are the angles atan(x/z) and atan(y/z) by pi, from a unit direction w:
/// dw = pi^2 (1 - x^2)(1 - y^2) / z du dv [pbrt-v4, sec. 12.5.3].
double solid_angle_per_area(Vec3d w) { return kPi2 * (w.y * w.y + w.z * w.z) * (w.x * w.x + w.z * w.z) / w.z; }

}  // namespace

Portal::Portal(const InfiniteLight& light, const Location& where, KeptFiles* kept) {
  const std::array<Vec3, 4>& p = *light.portal;
  corner_ = Vec3d(p[0]);
  const Vec3d edge_x = Vec3d(p[3]) - corner_, edge_y = Vec3d(p[1]) - corner_;
  width_ = length(edge_x);
  height_ = length(edge_y);
  const Vec3d last = Vec3d(p[2]) - corner_ - edge_x - edge_y;
  const double size = std::max(width_, height_);
  if (!(width_ > 0 && height_ > 0 && std::isfinite(size)) || std::abs(dot(edge_x, edge_y)) > kSquare * width_ * height_ ||
      length(last) > kSquare * size)
    throw Error(where, "the portal is no rectangle; give its four corners in order around it, with right angles between");
  x_ = edge_x / width_;
  y_ = normalize(edge_y - x_ * dot(edge_y, x_));
  z_ = cross(x_, y_);
  resample(Environment(light, where, kept));
}

void Portal::resample(const Environment& map) {
  const int resolution = map.resolution(), pieces = (kFinest + resolution - 1) / resolution;
  size_ = resolution;
  const auto to_world = [&](Vec3d w) { return to_vec3(x_ * w.x + y_ * w.y + z_ * w.z); };
  for (int j = 0; j < resolution; ++j)
    for (int i = 0; i < resolution; ++i)
      texels_.push_back(map.interpolated(to_world(direction((i + 0.5) / resolution, (j + 0.5) / resolution))));

  const int cells = resolution * pieces;
  std::vector<float> weights;
  double flux = 0;  // of a unit of area
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const Angles at{(i + 0.5) / cells, (j + 0.5) / cells};
      const Vec3d w = direction(at.u, at.v);
      const double omega = solid_angle_per_area(w);
      const Rgb L = texel(at);
      weights.push_back(luminance({std::abs(L.r), std::abs(L.g), std::abs(L.b)}) * static_cast<float>(omega));
      flux += strength(L) * omega * w.z / (static_cast<double>(cells) * cells);
    }
  distribution_ = WindowedDistribution(cells, cells, weights);
  power_ = flux * width_ * height_;
}

std::optional<Portal::Angles> Portal::angles_of(Vec3d w) {
  if (!(w.z > 0)) return std::nullopt;
  return Angles{std::atan2(w.x, w.z) / std::numbers::pi + 0.5, std::atan2(w.y, w.z) / std::numbers::pi + 0.5};
}

Vec3d Portal::direction(double u, double v) {
  return normalize(Vec3d(std::tan((u - 0.5) * std::numbers::pi), std::tan((v - 0.5) * std::numbers::pi), 1));
}

std::optional<Window> Portal::window(Vec3 p) const {
  const Vec3d r = corner_ - Vec3d(p);
  const double x = dot(r, x_), y = dot(r, y_), z = dot(r, z_);
  const auto low = angles_of({x, y, z}), high = angles_of({x + width_, y + height_, z});
  if (!low || !high) return std::nullopt;
  return Window{low->u, low->v, high->u, high->v};
}

Rgb Portal::texel(Angles at) const {
  const auto index = [&](double u) { return std::clamp(static_cast<int>(u * size_), 0, size_ - 1); };
  return texels_[static_cast<std::size_t>(index(at.v)) * static_cast<std::size_t>(size_) +
                 static_cast<std::size_t>(index(at.u))];
}

Rgb Portal::radiance(Vec3 p, Vec3 w) const {
  const auto seen = window(p);
  const auto at = angles_of(local(w));
  return seen && at && seen->contains(at->u, at->v) ? texel(*at) : Rgb();
}

std::optional<Environment::Sample> Portal::sample(Vec3 p, Vec2 u) const {
  const auto seen = window(p);
  const auto drawn = seen ? distribution_.sample(*seen, u) : std::nullopt;
  if (!drawn) return std::nullopt;
  const Vec3d w = direction(drawn->x, drawn->y);
  // Density and radiance are those of the direction as rounded, which every other caller will see.
  const Vec3 wi = normalize(to_vec3(x_ * w.x + y_ * w.y + z_ * w.z));
  const Environment::Sample sample{wi, pdf(p, wi), radiance(p, wi)};
  if (!(sample.pdf > 0)) return std::nullopt;
  return sample;
}

float Portal::pdf(Vec3 p, Vec3 w) const {
  const Vec3d direction = local(w);
  const auto seen = window(p);
  const auto at = angles_of(direction);
  const double density = seen && at ? distribution_.pdf(*seen, at->u, at->v) : 0;
  return density > 0 ? static_cast<float>(density / solid_angle_per_area(direction)) : 0.0f;
}

std::array<Vec3, 4> Portal::corners() const {
  const Vec3d x = x_ * width_, y = y_ * height_;
  return {to_vec3(corner_), to_vec3(corner_ + x), to_vec3(corner_ + x + y), to_vec3(corner_ + y)};
}

/// A flat light emits radiance L over an area A with intensity L A along its normal; here L is the mean that enters.
LightBounds Portal::bounds() const {
  LightBounds bounds;
  for (const Vec3& p : corners()) bounds.box.expand(p);
  bounds.normals = DirectionCone::around(to_vec3(z_ * -1.0));
  bounds.theta_e = kPi / 2;
  bounds.intensity = static_cast<float>(std::clamp(power_ / std::numbers::pi, 1e-37, 1e38));
  return bounds;
}

LightPlace Portal::place() const { return flat_place(corners(), to_vec3(z_ * -1.0)); }

}  // namespace tyndall
