/// The sun of an environment map.
#include <array>
#include <cmath>

#include "light/environment.h"
#include "math/vec3d.h"

namespace tyndall {
namespace {

/// Cosine of the widest angle between a sun's light and its middle: 8 degrees, with what a hazy sky adds around it.
constexpr double kNarrow = 0.99;
/// Of all light, at least.
constexpr double kLeastShare = 0.1;
/// Directions are gathered on the faces of a cube, in squares about as wide as that.
constexpr int kSide = 16;
constexpr int kBins = 6 * kSide * kSide;

int bin_of(Vec3 w) {
  const std::array<float, 3> a{std::abs(w.x), std::abs(w.y), std::abs(w.z)}, v{w.x, w.y, w.z};
  const std::size_t axis = a[0] >= a[1] && a[0] >= a[2] ? 0 : a[1] >= a[2] ? 1 : 2;
  const auto place = [&](std::size_t i) {
    const float s = 0.5f * (1 + v[i] / a[axis]);
    return std::min(static_cast<int>(s * kSide), kSide - 1);
  };
  const int face = 2 * static_cast<int>(axis) + (v[axis] > 0 ? 1 : 0);
  return (face * kSide + place((axis + 1) % 3)) * kSide + place((axis + 2) % 3);
}

struct Gathered {
  Vec3d moment{0, 0, 0};
  double fluence = 0;
  void add(Vec3 w, double light) {
    moment = moment + Vec3d(w) * light;
    fluence += light;
  }
};

}  // namespace

std::optional<FarCone> Environment::peak() const {
  if (layout_ == Layout::constant) return std::nullopt;
  const auto for_each_lit = [&](const auto& body) {
    for_each_texel(1, [&](Texel t, Vec3 toward, double omega) {
      const Rgb L = L_ * texel(t);
      if (is_black(L)) return;
      const Vec3 w = to_world(toward);
      body(w, strength(L) * omega / stretch(w));
    });
  };
  std::vector<Gathered> bins(kBins);
  for_each_lit([&](Vec3 w, double light) { bins[static_cast<std::size_t>(bin_of(w))].add(w, light); });
  double all = 0;
  const Gathered* brightest = &bins.front();
  for (const Gathered& bin : bins) {
    all += bin.fluence;
    if (bin.fluence > brightest->fluence) brightest = &bin;
  }
  if (!(all > 0) || !std::isfinite(all)) return std::nullopt;
  const Vec3d middle = normalize(brightest->moment);
  Gathered sun;
  for_each_lit([&](Vec3 w, double light) {
    if (dot(Vec3d(w), middle) > kNarrow) sun.add(w, light);
  });
  if (!(sun.fluence >= kLeastShare * all)) return std::nullopt;
  const Vec3 axis = to_vec3(normalize(sun.moment));
  const auto fluence = static_cast<float>(sun.fluence);
  return FarCone{DirectionCone::around(axis, static_cast<float>(2 * std::acos(kNarrow))), to_vec3(sun.moment / sun.fluence),
                 fluence, fluence};
}

}  // namespace tyndall
