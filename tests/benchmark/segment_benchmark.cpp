// Light trees asked about segments of rays through media, in figures:
//   SegmentSelect    lights chosen a second, wide tree over binary tree, one thread
//   SegmentVariance  of single scattering by one light a segment, relative: the choice of the light alone, its
//                    scattering along the segment by quadrature. Mean over segments; exact sums over all lights
#include <benchmark/benchmark.h>

#include <chrono>

#include "light/tree_selector.h"
#include "unit/light/segment_cases.h"

namespace tyndall {
namespace {

constexpr MediaStrategy kImportances[] = {MediaStrategy::closest, MediaStrategy::integral, MediaStrategy::product};

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct Smoke {
  std::vector<LightBounds> lights;  ///< in a cube of half side 1
  float sigma = 1, g = 0;           ///< extinction; the albedo drops out
};

Smoke points(std::size_t n, float sigma, float g) {
  Rng rng(4);
  Smoke smoke{{}, sigma, g};
  for (std::size_t i = 0; i < n; ++i)
    smoke.lights.push_back(test::point_bounds(test::random_in_cube(rng), std::exp(3 * rng.uniform())));
  return smoke;
}

Smoke triangles(std::size_t n, float sigma, float g) {
  Rng rng(5);
  Smoke smoke{{}, sigma, g};
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = test::random_in_cube(rng);
    LightBounds b = test::spot_bounds(p, test::random_direction(rng), 0, kPi / 2, std::exp(3 * rng.uniform()));
    b.box.expand(p + test::random_in_cube(rng, 0.01f));
    smoke.lights.push_back(b);
  }
  return smoke;
}

/// Clusters of 100 points each.
Smoke clustered(std::size_t n, float sigma, float g) {
  Rng rng(6);
  Smoke smoke{{}, sigma, g};
  Vec3 center;
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 100 == 0) center = test::random_in_cube(rng);
    smoke.lights.push_back(test::point_bounds(center + test::random_in_cube(rng, 0.03f), std::exp(3 * rng.uniform())));
  }
  return smoke;
}

/// From one side of the cube to the other.
std::vector<SegmentQuery> segments(const Smoke& smoke, std::size_t count, MediaStrategy importance) {
  Rng rng(7);
  std::vector<SegmentQuery> queries;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 from = Vec3{-1.3f, test::random_in_cube(rng).y, test::random_in_cube(rng).z};
    const Vec3 to = Vec3{1.3f, test::random_in_cube(rng).y, test::random_in_cube(rng).z};
    SegmentQuery q{.o = from, .d = normalize(to - from), .t0 = 0, .t1 = length(to - from), .importance = importance};
    q.profile = test::homogeneous_profile(q.t0, q.t1, smoke.sigma, 1.3f, smoke.g);
    queries.push_back(q);
  }
  return queries;
}

template <typename Tree>
double select_seconds(const Tree& tree, const std::vector<SegmentQuery>& queries, int draws) {
  Rng rng(9);
  const double start = seconds();
  for (int i = 0; i < draws; ++i)
    benchmark::DoNotOptimize(tree.select(queries[static_cast<std::size_t>(i) % queries.size()], rng.uniform_wide()));
  return seconds() - start;
}

void SegmentSelect(benchmark::State& state, MediaStrategy importance) {
  const Smoke smoke = points(static_cast<std::size_t>(state.range(0)), 1, 0.5f);
  const auto queries = segments(smoke, 1000, importance);
  const WideLightTree wide(test::numbered(smoke.lights));
  const LightTree binary(test::numbered(smoke.lights));
  constexpr int kDraws = 30'000;
  double wide_seconds = 0, binary_seconds = 0;
  for (auto _ : state) {
    wide_seconds += select_seconds(wide, queries, kDraws);
    binary_seconds += select_seconds(binary, queries, kDraws);
  }
  const double draws = double(kDraws) * double(state.iterations());
  state.counters["tree_ns"] = wide_seconds / draws * 1e9;
  state.counters["binary_ns"] = binary_seconds / draws * 1e9;
  state.counters["ratio"] = binary_seconds / wide_seconds;
}

/// Single scattering of a small light along a segment in the homogeneous medium, by places in equal angles.
double scattered(const LightBounds& light, const Smoke& smoke, const SegmentQuery& q) {
  const Vec3d to = Vec3d(light.box.min) * 0.5 + Vec3d(light.box.max) * 0.5 - Vec3d(q.o), d(q.d);
  const double along = dot(to, d), h = std::max(length(to - d * along), 1e-6);
  const double begin = std::atan2(q.t0 - along, h), end = std::atan2(q.t1 - along, h);
  constexpr int kPlaces = 48;
  double sum = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const double place = h * std::tan(begin + (end - begin) * (i + 0.5) / kPlaces), r = std::sqrt(h * h + place * place);
    const double t = along + place;
    double emitted = 1;
    if (!light.normals.full()) emitted = std::max(dot(Vec3d(light.normals.axis), d * t - to) / r, 0.0);
    sum += emitted * std::exp(-smoke.sigma * (t - q.t0 + r)) * phase_ratio(smoke.g, -place / r);
  }
  return light.intensity * sum * (end - begin) / kPlaces / h;
}

/// sum f^2 / p / (sum f)^2 - 1, mean over the segments.
double relative_variance(const LightSelector& selector, const Smoke& smoke, const std::vector<SegmentQuery>& queries) {
  double mean = 0;
  for (const SegmentQuery& q : queries) {
    double sum = 0, second = 0;
    for (LightId light = 0; light < smoke.lights.size(); ++light) {
      const double f = scattered(smoke.lights[light], smoke, q);
      if (!(f > 0)) continue;
      sum += f;
      second += f * f / selector.pmf(q, light);
    }
    mean += second / (sum * sum) - 1;
  }
  return mean / double(queries.size());
}

void SegmentVariance(benchmark::State& state, Smoke (*make)(std::size_t, float, float), float sigma, float g) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const Smoke smoke = make(n, sigma, g);
  SelectionInput input;
  for (const LightBounds& light : smoke.lights) input.power.push_back(light.intensity);
  input.near = test::numbered(smoke.lights);
  const auto power = make_selector(LightStrategy::power, input), tree = make_selector(LightStrategy::tree, input),
             binary = make_selector(LightStrategy::tree_binary, input), rule = make_selector(LightStrategy::cycles_rule, input);
  for (auto _ : state) {
    for (const MediaStrategy importance : kImportances) {
      const auto queries = segments(smoke, n > 5000 ? 12 : 24, importance);
      const std::string name(importance == MediaStrategy::closest    ? "closest"
                             : importance == MediaStrategy::integral ? "integral"
                                                                     : "product");
      state.counters["tree_" + name] = relative_variance(*tree, smoke, queries);
      state.counters["binary_" + name] = relative_variance(*binary, smoke, queries);
      if (importance == MediaStrategy::integral) state.counters["cycles_rule"] = relative_variance(*rule, smoke, queries);
      if (importance == MediaStrategy::closest) state.counters["power"] = relative_variance(*power, smoke, queries);
    }
  }
}

BENCHMARK_CAPTURE(SegmentSelect, closest, MediaStrategy::closest)->Arg(1000)->Arg(1'000'000)->Iterations(3);
BENCHMARK_CAPTURE(SegmentSelect, integral, MediaStrategy::integral)->Arg(1000)->Arg(1'000'000)->Iterations(3);
BENCHMARK_CAPTURE(SegmentSelect, product, MediaStrategy::product)->Arg(1000)->Arg(1'000'000)->Iterations(3);
BENCHMARK_CAPTURE(SegmentVariance, thin, points, 0.5f, 0)->Arg(1000)->Arg(20'000)->Iterations(1);
BENCHMARK_CAPTURE(SegmentVariance, dense, points, 5, 0)->Arg(1000)->Arg(20'000)->Iterations(1);
BENCHMARK_CAPTURE(SegmentVariance, thin_clustered, clustered, 0.5f, 0)->Arg(2000)->Arg(20'000)->Iterations(1);
BENCHMARK_CAPTURE(SegmentVariance, dense_clustered, clustered, 5, 0)->Arg(2000)->Arg(20'000)->Iterations(1);
BENCHMARK_CAPTURE(SegmentVariance, forward, points, 0.5f, 0.85f)->Arg(1000)->Arg(20'000)->Iterations(1);
BENCHMARK_CAPTURE(SegmentVariance, triangles, triangles, 0.5f, 0)->Arg(1000)->Arg(20'000)->Iterations(1);
BENCHMARK_CAPTURE(SegmentVariance, dense_triangles, triangles, 5, 0)->Arg(1000)->Arg(20'000)->Iterations(1);

}  // namespace
}  // namespace tyndall
