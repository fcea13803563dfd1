// Transmittance along rays through the plume of plume_hall, by every estimator and by ratio tracking under one global majorant.
// Rays start and end outside of its box and aim at random points of it.
//   lookups      densities read a ray                                       bar: residual needs 1/10 of what global needs
//   variance     of the estimates, mean over rays of (estimate - exact)^2   bar: residual has no more than global
//   pieces       of constant majorant walked a ray
//   ns           thread CPU time a ray
//   var_x_us     variance times time: what it costs to get to a given error
#include <benchmark/benchmark.h>

#include <ctime>

#include "support/test_media.h"
#include "volume/grid_ray.h"
#include "volume/medium_data.h"
#include "volume/tracking_kernel.h"

namespace tyndall {
namespace {

constexpr int kRays = 400, kRepeats = 100;

struct KnownRay {
  Ray ray;
  float t1;
  double exact;
};

/// The plume with the extinction it has in its scene, and its rays.
struct Plume {
  ParticipatingMedium medium = load();
  const ParticipatingMedium* media[1] = {&medium};
  std::vector<KnownRay> rays;

  Plume() {
    const Bounds3 box = medium.bounds();
    const float reach = length(box.extent());
    Rng rng(1);
    const auto point = [&] { return box.min + box.extent() * Vec3{rng.uniform(), rng.uniform(), rng.uniform()}; };
    for (int i = 0; i < kRays; ++i) {
      const Vec3 at = point(), d = normalize(point() - at);
      const Ray ray{at - d * reach, d};
      rays.push_back({ray, 2 * reach, test::integrate_line(media, ray, 0, 2 * reach, 8000).transmittance(0)});
    }
  }

  static ParticipatingMedium load() {
    VdbMedium vdb;
    vdb.path = std::string(TYNDALL_SOURCE_DIR) + "/volumes/plume_hall/plume.vdb";
    Medium medium;
    medium.kind = vdb;
    return test::built(medium, {Rgb{0.6f}, Rgb{20.0f}, 0});
  }
};

double thread_seconds() {
  std::timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Ratio tracking as it is without a hierarchy, in the box of the grid.
double global_majorant(const Plume& plume, const KnownRay& known, Rng& rng, TrackingStats& stats) {
  const MediumData& data = plume.medium.data();
  const float sigma_maj = plume.medium.sigma_maj(), top = max_component(data.optics.sigma_a + data.optics.sigma_s);
  const GridRay local(data.density.to_local, known.ray);
  const auto [begin, end] = local.clip(data.clip, 0, known.t1);
  double T = 1;
  for (double t = begin; begin < end;) {
    t += kernel::exponential(rng) / sigma_maj;
    if (t >= end) break;
    ++stats.lookups;
    T *= 1 - data.density.grid.lookup(local.line(), t) * top / sigma_maj;
  }
  return T;
}

template <typename Estimate>
void measure(benchmark::State& state, const Plume& plume, const Estimate& estimate) {
  Rng rng(7);
  TrackingStats stats;
  double squares = 0, seconds = 0;
  for (auto _ : state) {
    const double start = thread_seconds();
    for (const KnownRay& known : plume.rays)
      for (int i = 0; i < kRepeats; ++i) {
        const double error = estimate(known, rng, stats) - known.exact;
        squares += error * error;
      }
    seconds += thread_seconds() - start;
  }
  const double count = double(kRays) * kRepeats * double(state.iterations());
  state.counters["lookups"] = double(stats.lookups) / count;
  state.counters["variance"] = squares / count;
  state.counters["pieces"] = double(stats.segments) / count;
  state.counters["ns"] = seconds / count * 1e9;
  state.counters["var_x_us"] = squares / count * seconds / count * 1e6;
}

const Plume& plume() {
  static const Plume plume;
  return plume;
}

void global(benchmark::State& state) {
  measure(state, plume(),
          [](const KnownRay& known, Rng& rng, TrackingStats& stats) { return global_majorant(plume(), known, rng, stats); });
}
void estimator(benchmark::State& state, TransmittanceStrategy strategy) {
  measure(state, plume(), [&](const KnownRay& known, Rng& rng, TrackingStats& stats) {
    return double{transmittance({strategy}, plume().media, known.ray, 0, known.t1, rng, stats).g};
  });
}

BENCHMARK(global)->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(estimator, residual, TransmittanceStrategy::residual)->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(estimator, raymarch, TransmittanceStrategy::raymarch)->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(estimator, ratio, TransmittanceStrategy::ratio)->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(estimator, delta, TransmittanceStrategy::delta)->Iterations(5)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tyndall
