/// Scenes in which emissive objects stand many times, as selection sees them and as shapes.
#pragma once

#include "light/lights.h"
#include "light_cases.h"

namespace tyndall::test {

inline Transform random_similarity(Rng& rng, float spread, float least_scale = 0.2f) {
  const Vec3 axis = random_direction(rng), move = random_in_cube(rng, spread);
  const double s = least_scale * std::exp(2.0 * rng.uniform()), mirror = rng.uniform() < 0.5f ? -1 : 1;
  return Transform::translate(move.x, move.y, move.z) * Transform::rotate(360 * rng.uniform(), axis.x, axis.y, axis.z) *
         Transform::scale(mirror * s, s, s);
}

inline Transform transform_of(const Similarity& s) {
  const Vec3d o = s.point({0, 0, 0}), x = s.point({1, 0, 0}) - o, y = s.point({0, 1, 0}) - o, z = s.point({0, 0, 1}) - o;
  return Transform(Transform::Matrix{{{x.x, y.x, z.x, o.x}, {x.y, y.y, z.y, o.y}, {x.z, y.z, z.z, o.z}, {0, 0, 0, 1}}});
}

/// Two objects of mixed lights, one far from its own origin, with some dark ones; instances of both, and lights of the
/// scene, 20 of them.
inline SelectionInput instanced_lights(std::size_t instances, std::uint64_t seed, bool sun = false) {
  SelectionInput input;
  Rng rng(seed);
  for (const LightBounds& l : mixed_lights(20, seed)) {
    input.near.push_back({l, static_cast<LightId>(input.power.size())});
    input.power.push_back(l.intensity);
  }
  if (sun) {
    input.far.push_back(
        {{{DirectionCone::around({0, 0, 1}), {0, 0, 1}, 3e3f, 3e3f}}, static_cast<LightId>(input.power.size())});
    input.power.push_back(10);
  }
  for (const std::size_t size : {40u, 150u}) {
    SharedLights& object = input.objects.emplace_back();
    for (LightBounds l : mixed_lights(size, seed + size)) {
      if (size == 40) l.box = {l.box.min + Vec3{300, 0, 0}, l.box.max + Vec3{300, 0, 0}};
      const bool dark = object.power.size() % 9 == 4;
      if (!dark) object.near.push_back({l, static_cast<LightId>(object.power.size())});
      object.power.push_back(dark ? 0.0 : l.intensity);
    }
  }
  auto next = static_cast<LightId>(input.power.size());
  for (std::uint32_t i = 0; i < instances; ++i) {
    const auto map = Similarity::of(random_similarity(rng, 4) * Transform::translate(i % 2 ? 0 : -300, 0, 0));
    input.instances.push_back({i % 2, next, *map, i % 3 ? map->scale() * map->scale() : 1});
    next += static_cast<LightId>(input.objects[i % 2].power.size());
  }
  return input;
}

inline std::size_t size_of(const SelectionInput& input) {
  std::size_t lights = input.power.size();
  for (const LightInstance& i : input.instances) lights += input.objects[i.object].power.size();
  return lights;
}

/// Bounds of every light in the world; those without power have none.
inline std::vector<LightBounds> world_bounds(const SelectionInput& input) {
  std::vector<LightBounds> all;
  for (const TreeLight& l : input.near) all.push_back(l.bounds);
  for (const LightInstance& i : input.instances)
    for (const TreeLight& l : input.objects[i.object].near) all.push_back(placed(l.bounds, i.to_world, i.growth));
  return all;
}

/// Points near the lights, some on glossy surfaces, some in media with a forward phase function.
inline std::vector<PointQuery> instanced_queries(const SelectionInput& input, std::size_t count, std::uint64_t seed) {
  auto queries = queries_for(world_bounds(input), count, seed);
  Rng rng(seed);
  for (std::size_t i = 0; i < queries.size(); i += 2) {
    PointQuery& q = queries[i];
    if (!(length_squared(q.n) > 0)) {
      q.g = 0.8f * rng.uniform();
      q.forward = random_direction(rng);
      continue;
    }
    QueryLobe& lobe = q.lobes[0];
    q.lobe_count = 1;
    lobe.tangent = normalize(cross(q.n, random_direction(rng)));
    lobe.bitangent = cross(q.n, lobe.tangent);
    lobe.sin_o = 0.6f;
    lobe.cos_o = 0.8f;
    lobe.slope2_t = 0.02f;
    lobe.slope2_b = 0.1f;
    lobe.spread_t = lobe.spread_b = 0.25f;
    lobe.scale = 0.5f;
    q.diffuse = 0.1f;
  }
  return queries;
}

}  // namespace tyndall::test
