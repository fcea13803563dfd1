/// Sets of light bounds and query points that light selection must cope with, from the ordinary to the nasty.
#pragma once

#include <string>
#include <vector>

#include "light/light_tree.h"
#include "light/selection.h"
#include "math/frame.h"
#include "math/rng.h"

namespace tyndall::test {

inline Vec3 random_in_cube(Rng& rng, float half = 1) {
  const float x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
  return Vec3{2 * x - 1, 2 * y - 1, 2 * z - 1} * half;
}

inline Vec3 random_direction(Rng& rng) {
  for (;;) {
    const Vec3 v = random_in_cube(rng);
    const float l = length(v);
    if (l > 1e-3f && l <= 1) return v / l;
  }
}

inline LightBounds point_bounds(Vec3 p, float intensity) {
  LightBounds b;
  b.box.expand(p);
  b.normals = DirectionCone::everything();
  b.theta_e = kPi / 2;
  b.intensity = intensity;
  return b;
}

inline LightBounds spot_bounds(Vec3 p, Vec3 axis, float core, float skirt, float intensity) {
  LightBounds b = point_bounds(p, intensity);
  b.normals = DirectionCone::around(axis, core);
  b.theta_e = skirt;
  return b;
}

inline LightBounds triangle_bounds(Vec3 a, Vec3 b, Vec3 c, bool two_sided, float radiance) {
  LightBounds t;
  for (const Vec3 p : {a, b, c}) t.box.expand(p);
  const Vec3d n = cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a));
  t.normals = DirectionCone::around(to_vec3(normalize(n)));
  t.theta_e = kPi / 2;
  t.intensity = static_cast<float>(0.5 * length(n)) * radiance;
  t.two_sided = two_sided;
  return t;
}

inline std::vector<TreeLight> numbered(const std::vector<LightBounds>& bounds) {
  std::vector<TreeLight> lights;
  for (std::size_t i = 0; i < bounds.size(); ++i) lights.push_back({bounds[i], static_cast<LightId>(i)});
  return lights;
}

/// Triangles, points and spots mixed, spread over a cube, powers over five decades.
inline std::vector<LightBounds> mixed_lights(std::size_t n, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<LightBounds> lights;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = random_in_cube(rng);
    const float strength = std::exp(11 * rng.uniform());
    const float kind = rng.uniform();
    if (kind < 0.6f) {
      const float size = 0.2f * rng.uniform() / std::cbrt(static_cast<float>(n));
      const Vec3 b = p + random_in_cube(rng, size), c = p + random_in_cube(rng, size);
      lights.push_back(triangle_bounds(p, b, c, rng.uniform() < 0.3f, strength));
    } else if (kind < 0.8f) {
      lights.push_back(point_bounds(p, strength));
    } else {
      lights.push_back(spot_bounds(p, random_direction(rng), 0.5f * rng.uniform(), rng.uniform(), strength));
    }
    if (!(lights.back().intensity > 0)) lights.back() = point_bounds(p, strength);
  }
  return lights;
}

struct LightCase {
  std::string name;
  std::vector<LightBounds> lights;
};

inline std::vector<LightCase> light_cases() {
  std::vector<LightCase> cases;
  for (const std::size_t n : {1u, 2u, 3u, 10u, 100u, 1000u, 10000u})
    cases.push_back({std::to_string(n) + " mixed lights", mixed_lights(n, n)});
  const auto add = [&](std::string name, std::size_t n, auto make) {
    LightCase c{std::move(name), {}};
    for (std::size_t i = 0; i < n; ++i) c.lights.push_back(make(i));
    cases.push_back(std::move(c));
  };
  Rng rng(99);
  add("coincident points", 300, [](std::size_t) { return point_bounds({0.25f, 0.5f, -0.75f}, 1); });
  add("coincident triangles, opposite orientations", 300, [](std::size_t i) {
    const Vec3 a{0, 0, 0}, b{0.5f, 0, 0}, c{0, 0.5f, 0};
    return i % 2 ? triangle_bounds(a, b, c, false, 1) : triangle_bounds(a, c, b, false, 1);
  });
  add("on a line", 300, [](std::size_t i) { return point_bounds({i / 300.0f, 0, 0}, 1); });
  add("two places", 300, [](std::size_t i) { return point_bounds({i % 2 ? 1.0f : -1.0f, 0, 0}, 1); });
  add("a chain of halved distances", 120, [](std::size_t i) { return point_bounds({std::ldexp(1.0f, -int(i)), 0, 0}, 1); });
  add("radii over thirty decades", 300,
      [&](std::size_t) { return point_bounds(random_direction(rng) * std::pow(10.0f, 30 * rng.uniform() - 15), 1); });
  add("powers over sixty decades", 300,
      [&](std::size_t) { return point_bounds(random_in_cube(rng), std::pow(10.0f, 60 * rng.uniform() - 30)); });
  add("a ceiling", 1000, [](std::size_t i) {
    const float x = float(i % 32) / 16 - 1, y = float(i / 32) / 16 - 1, s = 0.02f;
    return triangle_bounds({x, y, 1}, {x, y + s, 1}, {x + s, y, 1}, false, 1);
  });
  add("at the ends of the float range", 50,
      [&](std::size_t i) { return point_bounds(random_in_cube(rng) * (i % 2 ? 1e38f : 1e-38f), 1); });
  return cases;
}

/// Places where trees break, each with powers that strain them: 8 x 8 layouts.
inline std::vector<LightCase> degenerate_cases(std::size_t n = 150) {
  using Place = Vec3 (*)(Rng&, std::size_t);
  const std::pair<const char*, Place> places[] = {
      {"coincident",
       [](Rng&, std::size_t) {
         return Vec3{0.3f, -0.7f, 0.1f};
       }},
      {"at the origin", [](Rng&, std::size_t) { return Vec3{}; }},
      {"on an axis",
       [](Rng& rng, std::size_t) {
         return Vec3{rng.uniform(), 0, 0};
       }},
      {"on a diagonal",
       [](Rng& rng, std::size_t) {
         return Vec3{1, 1, 1} * rng.uniform();
       }},
      {"two places",
       [](Rng&, std::size_t i) {
         return Vec3{i % 2 ? 1e6f : -1e-6f, 0, 1};
       }},
      {"a chain",
       [](Rng&, std::size_t i) {
         return Vec3{std::ldexp(1.0f, 60 - int(i % 120)), 0, 0};
       }},
      {"a plane far off",
       [](Rng& rng, std::size_t) {
         return Vec3{1e6f + rng.uniform(), 1e6f - rng.uniform(), 1e6f};
       }},
      {"the float range", [](Rng& rng, std::size_t i) { return random_in_cube(rng) * (i % 2 ? 1e38f : 1e-40f); }},
  };
  using Make = LightBounds (*)(Rng&, std::size_t, Vec3);
  const std::pair<const char*, Make> kinds[] = {
      {"equal points", [](Rng&, std::size_t, Vec3 p) { return point_bounds(p, 1); }},
      {"powers over sixty decades",
       [](Rng& rng, std::size_t, Vec3 p) { return point_bounds(p, std::pow(10.0f, 60 * rng.uniform() - 30)); }},
      {"one that outshines all", [](Rng&, std::size_t i, Vec3 p) { return point_bounds(p, i == 7 ? 1e30f : 1e-5f); }},
      {"spots of no width", [](Rng& rng, std::size_t, Vec3 p) { return spot_bounds(p, random_direction(rng), 0, 1e-4f, 1); }},
      {"spots all around", [](Rng& rng, std::size_t, Vec3 p) { return spot_bounds(p, random_direction(rng), kPi, kPi, 1); }},
      {"opposite faces",
       [](Rng&, std::size_t i, Vec3 p) {
         LightBounds b = spot_bounds(p, {0, 0, i % 2 ? 1.0f : -1.0f}, 0, kPi / 2, 1);
         b.two_sided = i % 3 == 0;
         return b;
       }},
      {"boxes over thirty decades",
       [](Rng& rng, std::size_t, Vec3 p) {
         LightBounds b = spot_bounds(p, random_direction(rng), 0, kPi / 2, 1);
         b.box.expand(p + random_direction(rng) * std::pow(10.0f, 30 * rng.uniform() - 15));
         return b;
       }},
      {"flat boxes",
       [](Rng& rng, std::size_t, Vec3 p) {
         LightBounds b = spot_bounds(p, {0, 1, 0}, 0, kPi / 2, rng.uniform() + 0.1f);
         b.box.expand(p + Vec3{0.1f * rng.uniform(), 0, 0.1f * rng.uniform()});
         return b;
       }},
  };
  std::vector<LightCase> cases;
  Rng rng(123);
  for (const auto& [place_name, place] : places) {
    for (const auto& [kind_name, make] : kinds) {
      LightCase c{std::string(place_name) + ", " + kind_name, {}};
      for (std::size_t i = 0; i < n; ++i) c.lights.push_back(make(rng, i, place(rng, i)));
      cases.push_back(std::move(c));
    }
  }
  return cases;
}

/// Points inside and outside the lights' box, on lights, at the centre, far away; a third of them in a medium.
inline std::vector<PointQuery> queries_for(const std::vector<LightBounds>& lights, std::size_t count, std::uint64_t seed) {
  Bounds3 box;
  for (const LightBounds& l : lights) box.expand(l.box);
  const Vec3 center = box.min * 0.5f + box.max * 0.5f, half = box.max * 0.5f - box.min * 0.5f;
  Rng rng(seed);
  std::vector<PointQuery> queries;
  for (std::size_t i = 0; i < count; ++i) {
    PointQuery q;
    const LightBounds& light = lights[rng.next() % lights.size()];
    switch (i % 6) {
      case 0:
        q.p = center + half * random_in_cube(rng);
        break;
      case 1:
        q.p = light.box.min;
        break;
      case 2:
        q.p = center;
        break;
      case 3:
        q.p = light.box.center() + random_in_cube(rng, 1e-6f);
        break;
      case 4:
        q.p = center + random_direction(rng) * (10 * length(half) + 1);
        break;
      default:
        q.p = center + half * random_in_cube(rng, 3);
        break;
    }
    q.n = random_direction(rng);
    if (i % 7 == 0) q.n = {0, 0, 1};
    if (i % 3 == 2) q.n = {};
    q.transmissive = rng.uniform() < 0.3f;
    queries.push_back(q);
  }
  return queries;
}

/// A lobe of facets that mirrors light from `axis`, seen along the normal.
inline void add_lobe(PointQuery& q, Vec3 axis, float alpha) {
  q.n = axis;
  QueryLobe& lobe = q.lobes[q.lobe_count++];
  const Frame frame = Frame::around(axis);
  lobe.tangent = frame.x;
  lobe.bitangent = frame.y;
  lobe.slope2_t = lobe.slope2_b = alpha * alpha;
  lobe.spread_t = lobe.spread_b = 0.25f;
  lobe.scale = 0.5f;
  q.diffuse = 0.01f;
}

/// What a selector is made of.
inline SelectionInput input_of(const std::vector<LightBounds>& lights) {
  SelectionInput input;
  input.near = numbered(lights);
  for (const LightBounds& light : lights) input.power.push_back(light.intensity);
  return input;
}

/// Mixed lights, and one at infinity if `sun`.
inline SelectionInput lights_of(std::size_t count, bool sun) {
  SelectionInput input = input_of(mixed_lights(count, 5));
  if (sun) {
    input.far.push_back({{{DirectionCone::around({0, 0, 1}), {0, 0, 1}, 3, 3}}, static_cast<LightId>(input.power.size())});
    input.power.push_back(10);
  }
  return input;
}

/// Candidates of all clusters.
inline double total(const LightCut& cut) {
  double sum = 0;
  for (const LightCluster& c : cut) sum += c.candidates;
  return sum;
}

}  // namespace tyndall::test
