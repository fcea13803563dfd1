/// Lights that say directly whether they contribute to a point: what "importance 0" is held against.
#pragma once

#include "light_cases.h"

namespace tyndall::test {

/// A light that can be asked for its contribution directly, with the bounds that selection sees of it.
struct ContributionOracle {
  enum class Kind { triangle, point, spot } kind;
  Vec3 a, b, c;  // spot: a = position, b = axis
  float core = 0, skirt = 0;
  bool two_sided = false;

  LightBounds bounds() const {
    if (kind == Kind::triangle) return triangle_bounds(a, b, c, two_sided, 1);
    if (kind == Kind::point) return point_bounds(a, 1);
    return spot_bounds(a, b, core, skirt, 1);
  }

  /// Whether the point on it that (u, v) picks sends light to the query point, by the float arithmetic of rendering.
  bool contributes(const PointQuery& q, float u, float v) const {
    Vec3 x = a;
    if (kind == Kind::triangle) {
      if (u + v > 1) u = 1 - u, v = 1 - v;
      x = a + (b - a) * u + (c - a) * v;
    }
    if (x == q.p) return false;
    const Vec3 wi = normalize(x - q.p);
    if (kind == Kind::triangle) {
      const Vec3 n = normalize(cross(b - a, c - a));
      if (two_sided ? dot(n, wi) == 0 : dot(n, -wi) <= 0) return false;
    }
    if (kind == Kind::spot && !(dot(b, -wi) > std::cos(std::min(core + skirt, kPi)))) return false;
    return length_squared(q.n) == 0 || q.transmissive || dot(q.n, wi) > 0;
  }
};

inline ContributionOracle random_light(Rng& rng) {
  ContributionOracle l;
  const float kind = rng.uniform();
  l.kind = kind < 0.6f ? ContributionOracle::Kind::triangle
                       : (kind < 0.7f ? ContributionOracle::Kind::point : ContributionOracle::Kind::spot);
  l.a = random_in_cube(rng);
  if (l.kind == ContributionOracle::Kind::triangle) {
    const float size = std::pow(10.0f, -3 * rng.uniform());
    l.b = l.a + random_in_cube(rng, size);
    l.c = l.a + random_in_cube(rng, size);
    l.two_sided = rng.uniform() < 0.3f;
  } else {
    l.b = random_direction(rng);
    l.core = rng.uniform() < 0.3f ? 0 : kPi * rng.uniform();
    l.skirt = std::min(kPi - l.core, std::pow(10.0f, 0.5f - 3 * rng.uniform()));
  }
  return l;
}

/// Near the horizon and the light's plane as often as anywhere else.
inline PointQuery random_query(const ContributionOracle& l, Rng& rng) {
  PointQuery q;
  q.p = rng.uniform() < 0.5f ? random_in_cube(rng, 2) : l.a + random_in_cube(rng, std::pow(10.0f, -4 * rng.uniform()));
  q.n = random_direction(rng);
  if (rng.uniform() < 0.3f) {  // the light just about touches the horizon
    const Vec3 to_light = normalize(l.a - q.p);
    q.n = normalize(q.n - to_light * dot(q.n, to_light) + to_light * (1e-6f * (rng.uniform() - 0.3f)));
  }
  if (l.kind == ContributionOracle::Kind::triangle && rng.uniform() < 0.2f) {  // seen nearly edge-on
    const Vec3 n = normalize(cross(l.b - l.a, l.c - l.a));
    q.p = l.a + (l.b - l.a) * (4 * rng.uniform() - 2) + (l.c - l.a) * (4 * rng.uniform() - 2) + n * (1e-6f * rng.uniform());
  }
  if (rng.uniform() < 0.2f) q.n = {};
  q.transmissive = rng.uniform() < 0.2f;
  return q;
}

}  // namespace tyndall::test
