/// Emissive objects that stand many times: what sharing their lights costs a choice and saves in memory, beside the wide tree
/// over the same lights one by one. Times are of the processor.
#include <benchmark/benchmark.h>

#include <ctime>

#include "light/instanced_light_tree.h"
#include "unit/light/instanced_cases.h"

namespace tyndall {
namespace {

double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Triangles all over a bumpy square, turned, mirrored and scaled.
SelectionInput sheets(std::size_t instances) {
  SelectionInput input;
  SharedLights& object = input.objects.emplace_back();
  const auto at = [](int i, int j) {
    const float x = 2 * float(i) / 45 - 1, y = 2 * float(j) / 45 - 1;
    return Vec3{x, y, 0.3f * std::sin(3 * x) * std::cos(4 * y)};
  };
  for (int i = 0; i < 2 * 45 * 45; ++i) {
    const int x = i / 2 % 45, y = i / 90;
    const Vec3 a = at(x, y), b = at(x + 1, y + 1), c = i % 2 ? at(x + 1, y) : at(x, y + 1);
    object.near.push_back({test::triangle_bounds(a, b, c, true, 1), static_cast<LightId>(i)});
    object.power.push_back(object.near.back().bounds.intensity);
  }
  Rng rng(1);
  for (std::size_t i = 0; i < instances; ++i) {
    const auto map = Similarity::of(test::random_similarity(rng, 30));
    input.instances.push_back({0, static_cast<LightId>(i * object.power.size()), *map, map->scale() * map->scale()});
  }
  return input;
}

template <typename Tree>
double nanoseconds(const Tree& tree, const std::vector<PointQuery>& points) {
  constexpr int kDraws = 100'000;
  Rng rng(9);
  const double start = seconds();
  for (int i = 0; i < kDraws; ++i)
    benchmark::DoNotOptimize(tree.select(points[static_cast<std::size_t>(i) % points.size()], rng.uniform_wide()));
  return (seconds() - start) / kDraws * 1e9;
}

void instanced(benchmark::State& state) {
  SelectionInput input = sheets(static_cast<std::size_t>(state.range(0)));
  Rng rng(2);
  std::vector<PointQuery> points;
  for (int i = 0; i < 1000; ++i) points.push_back({.p = test::random_in_cube(rng, 35), .n = test::random_direction(rng)});
  const bool compare = state.range(0) <= 500;
  std::vector<TreeLight> alone;
  if (compare) alone = test::numbered(test::world_bounds(input));
  for (auto _ : state) {
    double start = seconds();
    const InstancedLightTree shared(input);
    state.counters["build_ms"] = (seconds() - start) * 1e3;
    state.counters["bytes"] = double(shared.memory_bytes());
    state.counters["select_ns"] = nanoseconds(shared, points);
    if (!compare) continue;
    start = seconds();
    const WideLightTree single(std::move(alone));
    state.counters["alone_build_ms"] = (seconds() - start) * 1e3;
    state.counters["alone_bytes"] = double(single.memory_bytes());
    state.counters["alone_select_ns"] = nanoseconds(single, points);
  }
}

BENCHMARK(instanced)->Arg(450)->Arg(4500)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tyndall
