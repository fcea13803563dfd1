// The light tree in figures, as ratios within one run:
//   Select    lights chosen a second, wide tree over binary tree, one thread               bar: 4
//             `ratio`: one by one; `ratio_8`: eight for a point at once, as cuts are drawn from
//   Build     time over that of tbb::parallel_sort of as many 64-bit keys with 32 bytes    bar: 6
//   Variance  of unoccluded direct light, one light a point, relative; exact sums over all lights
#include <benchmark/benchmark.h>
#include <tbb/parallel_sort.h>

#include <array>
#include <chrono>

#include "light/tree_selector.h"
#include "unit/light/light_cases.h"

namespace tyndall {
namespace {

struct LightScene {
  std::vector<LightBounds> lights;
  std::vector<PointQuery> points;
};

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Triangles, points and spots all over a cube, points in and around it.
LightScene mixed(std::size_t n, std::size_t points) {
  LightScene scene{test::mixed_lights(n, 1), {}};
  scene.points = test::queries_for(scene.lights, points, 5);
  return scene;
}

/// A ceiling of triangles at z = 1 that emit downward, points on the floor and in the air below.
LightScene ceiling(std::size_t n, std::size_t points) {
  Rng rng(4);
  LightScene scene;
  const auto side = static_cast<std::size_t>(std::sqrt(double(n)));
  const float h = 2.0f / float(side);
  for (std::size_t i = 0; i < side * side; ++i) {
    const float x = h * float(i % side) - 1, y = h * float(i / side) - 1;
    scene.lights.push_back(test::triangle_bounds({x, y, 1}, {x, y + h, 1}, {x + h, y, 1}, false, std::exp(2 * rng.uniform())));
  }
  for (std::size_t i = 0; i < points; ++i) {
    PointQuery q{test::random_in_cube(rng), {0, 0, 1}};
    q.p.z = i % 2 ? -1 : 0.9f - 0.5f * rng.uniform();
    if (i % 4 == 3) q.n = normalize(Vec3{rng.uniform() - 0.5f, rng.uniform() - 0.5f, 0.3f});
    if (i % 5 == 4) q.n = {};
    scene.points.push_back(q);
  }
  return scene;
}

/// Spherical emitters, each a mesh of outward triangles, among surfaces that face anywhere.
LightScene spheres(std::size_t n, std::size_t points) {
  Rng rng(7);
  LightScene scene;
  for (std::size_t sphere = 0; sphere < n / 200; ++sphere) {
    const Vec3 center = test::random_in_cube(rng);
    const float r = 0.05f + 0.1f * rng.uniform(), strength = std::exp(3 * rng.uniform());
    for (int i = 0; i < 200; ++i) {
      const Vec3 normal = test::random_direction(rng);
      LightBounds b = test::spot_bounds(center + normal * r, normal, 0, kPi / 2, strength);
      b.box.expand(center + normal * r + test::random_in_cube(rng, 0.1f * r));
      scene.lights.push_back(b);
    }
  }
  for (std::size_t i = 0; i < points; ++i) scene.points.push_back({test::random_in_cube(rng), test::random_direction(rng)});
  return scene;
}

template <typename Tree>
double select_seconds(const Tree& tree, const LightScene& scene, int draws) {
  Rng rng(9);
  const double start = seconds();
  for (int i = 0; i < draws; ++i)
    benchmark::DoNotOptimize(tree.select(scene.points[static_cast<std::size_t>(i) % scene.points.size()], rng.uniform_wide()));
  return seconds() - start;
}

/// Eight for a point at once.
double select_eight_seconds(const WideLightTree& tree, const LightScene& scene, int draws) {
  Rng rng(9);
  std::array<WideLightTree::Draw, 8> eight;
  std::array<std::optional<WideLightTree::Choice>, 8> choices;
  const double start = seconds();
  for (int i = 0; i < draws; i += 8) {
    for (auto& draw : eight) draw = {tree.root(), rng.uniform_wide()};
    const WideQuery query = tree.localize(scene.points[static_cast<std::size_t>(i / 8) % scene.points.size()]);
    tree.select_below(eight, query, choices);
    benchmark::DoNotOptimize(choices);
  }
  return seconds() - start;
}

void select(benchmark::State& state, LightScene (*make)(std::size_t, std::size_t)) {
  const LightScene scene = make(static_cast<std::size_t>(state.range(0)), 1000);
  const WideLightTree wide(test::numbered(scene.lights));
  const LightTree binary(test::numbered(scene.lights));
  constexpr int kDraws = 100'000;
  double wide_seconds = 0, binary_seconds = 0, eight_seconds = 0;
  for (auto _ : state) {
    wide_seconds += select_seconds(wide, scene, kDraws);
    eight_seconds += select_eight_seconds(wide, scene, kDraws);
    binary_seconds += select_seconds(binary, scene, kDraws);
  }
  const double draws = double(kDraws) * double(state.iterations());
  state.counters["tree_ns"] = wide_seconds / draws * 1e9;
  state.counters["tree_8_ns"] = eight_seconds / draws * 1e9;
  state.counters["binary_ns"] = binary_seconds / draws * 1e9;
  state.counters["ratio"] = binary_seconds / wide_seconds;
  state.counters["ratio_8"] = binary_seconds / eight_seconds;
}

void build(benchmark::State& state, LightScene (*make)(std::size_t, std::size_t)) {
  struct Item {
    std::uint64_t key;
    std::array<char, 32> payload;
  };
  const auto n = static_cast<std::size_t>(state.range(0));
  const LightScene scene = make(n, 1);
  double build_seconds = 0, sort_seconds = 0;
  std::size_t bytes = 0;
  for (auto _ : state) {
    std::vector<Item> items(n);
    Rng rng(3);
    for (Item& item : items) item.key = rng.next();
    double start = seconds();
    tbb::parallel_sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.key < b.key; });
    sort_seconds += seconds() - start;
    auto lights = test::numbered(scene.lights);
    start = seconds();
    const WideLightTree tree(std::move(lights));
    build_seconds += seconds() - start;
    bytes = tree.memory_bytes();
  }
  state.counters["build_ms"] = build_seconds / double(state.iterations()) * 1e3;
  state.counters["sort_ms"] = sort_seconds / double(state.iterations()) * 1e3;
  state.counters["ratio"] = build_seconds / sort_seconds;
  state.counters["bytes_a_light"] = double(bytes) / double(n) + sizeof(std::uint32_t);
}

/// Irradiance from a light as small as its distance allows, unoccluded; in a medium the fluence.
double contribution(const LightBounds& light, const PointQuery& q) {
  const Vec3d d = Vec3d(light.box.min) * 0.5 + Vec3d(light.box.max) * 0.5 - Vec3d(q.p);
  const double d2 = dot(d, d);
  if (!(d2 > 0)) return 0;
  double f = light.intensity / d2;
  if (!light.normals.full()) {
    const double c = -dot(Vec3d(light.normals.axis), d) / std::sqrt(d2);
    f *= light.two_sided ? std::abs(c) : std::max(c, 0.0);
  }
  if (length_squared(q.n) == 0) return f;
  const double c = dot(Vec3d(q.n), d) / std::sqrt(d2);
  return f * (q.transmissive ? std::abs(c) : std::max(c, 0.0));
}

/// sum f^2 / p / (sum f)^2 - 1, mean over the points.
double relative_variance(const LightSelector& selector, const LightScene& scene) {
  double mean = 0;
  std::size_t points = 0;
  for (const PointQuery& q : scene.points) {
    double sum = 0, second = 0;
    for (LightId light = 0; light < scene.lights.size(); ++light) {
      const double f = contribution(scene.lights[light], q);
      if (!(f > 0)) continue;
      sum += f;
      second += f * f / selector.pmf(q, light);
    }
    if (!(sum > 0)) continue;
    mean += second / (sum * sum) - 1;
    ++points;
  }
  return mean / double(points);
}

void variance(benchmark::State& state, LightScene (*make)(std::size_t, std::size_t)) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const LightScene scene = make(n, n > 100'000 ? 6 : 40);
  SelectionInput input;
  for (const LightBounds& light : scene.lights) input.power.push_back(light.intensity);
  input.near = test::numbered(scene.lights);
  for (auto _ : state) {
    const auto of = [&](LightStrategy strategy) { return relative_variance(*make_selector(strategy, input), scene); };
    const double tree = of(LightStrategy::tree), binary = of(LightStrategy::tree_binary);
    state.counters["tree"] = tree;
    state.counters["binary"] = binary;
    state.counters["cycles_rule"] = of(LightStrategy::cycles_rule);
    state.counters["power"] = of(LightStrategy::power);
    state.counters["ratio"] = binary / tree;
  }
}

BENCHMARK_CAPTURE(select, ceiling, ceiling)->Arg(1'000'000)->Iterations(4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(select, mixed, mixed)->Arg(10'000)->Arg(1'000'000)->Iterations(4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build, ceiling, ceiling)->Arg(1'000'000)->Iterations(5)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(build, mixed, mixed)->Arg(1'000'000)->Iterations(5)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(variance, ceiling, ceiling)->Arg(10'000)->Arg(1'000'000)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(variance, spheres, spheres)->Arg(10'000)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tyndall
