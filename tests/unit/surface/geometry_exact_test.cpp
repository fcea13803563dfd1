#include <doctest/doctest.h>

#include "geometry_scenes.h"
#include "surface/shape_exact.h"
#include "surface/shape_mesh.h"

using namespace tyndall;
using namespace tyndall::test;

namespace {

__extension__ using Wide = __int128;

/// A point with integer coordinates, which both a double and exact arithmetic hold.
struct Lattice {
  std::int64_t x, y, z;
  Vec3d real() const { return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}; }
};

Lattice random_lattice(Rng& rng, int bits) {
  const auto one = [&] { return static_cast<std::int64_t>(rng.next() >> (64 - bits)) - (std::int64_t{1} << (bits - 1)); };
  return {one(), one(), one()};
}

Lattice minus(Lattice a, Lattice b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

int exact_sign(Lattice o, Lattice d, Lattice a, Lattice b) {
  const Lattice p = minus(a, o), q = minus(b, o);
  const Wide value = (Wide{p.y} * q.z - Wide{p.z} * q.y) * d.x + (Wide{p.z} * q.x - Wide{p.x} * q.z) * d.y +
                     (Wide{p.x} * q.y - Wide{p.y} * q.x) * d.z;
  return (value > 0) - (value < 0);
}

}  // namespace

TEST_CASE("the side of an edge has the sign that integers give, however near the ray") {
  Rng rng(31);
  int ties = 0, close = 0;
  for (int i = 0; i < 300000; ++i) {
    const int bits = i % 2 == 0 ? 24 : 5;
    const Lattice o = random_lattice(rng, bits), a = random_lattice(rng, bits), b = random_lattice(rng, bits);
    // Toward a point of the edge, or nearly: then the determinant all but cancels.
    const Lattice oa = minus(a, o), ob = minus(b, o);
    Lattice d{oa.x + ob.x, oa.y + ob.y, oa.z + ob.z};
    const Lattice nudge = random_lattice(rng, 2);
    if (i % 3 != 0) d = {d.x + nudge.x, d.y + nudge.y, d.z + nudge.z};
    const ShapeRay ray{o.real(), d.real()};
    const EdgeSide side = edge_side(ray, a.real(), b.real());
    const int expected = exact_sign(o, d, a, b);
    if (expected != 0) CHECK(side.sign == expected);
    ties += expected == 0;
    close += expected != 0 && bits == 24;
    const EdgeSide reverse = edge_side(ray, b.real(), a.real());
    CHECK(reverse.sign == -side.sign);
    CHECK(reverse.value == side.value);
    CHECK((expected == 0) == (side.value == 0));
  }
  CHECK(ties > 50000);
  CHECK(close > 50000);
}

TEST_CASE("any fan of triangles around a vertex is met exactly once by a ray through it") {
  Rng rng(32);
  for (int i = 0; i < 20000; ++i) {
    const int spokes = 3 + static_cast<int>(rng.uniform() * 6);
    const Vec3d apex(random_point(rng, 4));
    std::vector<Vec3d> ring;
    for (int k = 0; k < spokes; ++k) {
      const float phi = 2 * kPi * static_cast<float>(k) / static_cast<float>(spokes);
      ring.push_back(Vec3d(to_vec3(apex) + Vec3{std::cos(phi), std::sin(phi), between(rng, -0.5f, 0.5f)}));
    }
    const Vec3 o = to_vec3(apex) + Vec3{0, 0, -4};  // up through the apex, along z
    ShapeRay ray{Vec3d(o), {0, 0, 1}};
    ray.o.x = apex.x, ray.o.y = apex.y;
    int sum = 0;
    for (int k = 0; k < spokes; ++k) {
      const auto hit =
          intersect_triangle(ray, {apex, ring[static_cast<std::size_t>(k)], ring[static_cast<std::size_t>((k + 1) % spokes)]});
      if (!hit) continue;
      sum += hit->facing;
      CHECK(hit->t == doctest::Approx(apex.z - ray.o.z).epsilon(1e-6));
    }
    CHECK(sum == 1);
  }
}
