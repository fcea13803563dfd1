// Density look-ups: trilinear reads of the teapot cloud at the points where tracking reads it, ray by ray and in order.
//   nanovdb_ns  SampleFromVoxels of order 1 with its cache on a cached accessor, in floats, of the file as it is
//   tyndall_ns  BrickGrid::lookup, which keeps nothing from one look-up to the next
//   ratio       of the two, the best of turns in one run                                           bar: 3
//   error       largest difference of any two values, over the range of the grid                bar: 2^-16 = 1.5e-5
// Row 1 is the cloud as its scene has it, about one point a brick. The others are so many times as dense: with several points
// a voxel, SampleFromVoxels keeps the voxel's corners.
//   procedural  ns of a density of pbrt's cloud, above its solid lower part, which Prices counts for more than a read of a grid
#include <benchmark/benchmark.h>
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/SampleFromVoxels.h>

#include <ctime>
#include <limits>

#include "support/test_media.h"
#include "volume/cloud_noise.h"
#include "volume/medium_walk.h"
#include "volume/tracking_kernel.h"
#include "volume/vdb_file.h"
#include "volume/vdb_nano_file.h"

namespace tyndall {
namespace {

const std::string kCloud = std::string(TYNDALL_SOURCE_DIR) + "/volumes/teapot_cloud/teapot_cloud.nvdb";

/// A ray in the index space of both grids, and where it was read.
struct TrackedRay {
  Line line;
  nanovdb::Vec3d o, d;
  std::vector<double> t;
};

double thread_seconds() {
  std::timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Tentative collisions of tracking to the end of the ray.
std::vector<double> tentative_collisions(const MediumData& medium, const Ray& ray, Rng& rng) {
  std::vector<double> found;
  MediumWalk<WalkMode::majorant> walk(medium, ray, 0, kInfinity);
  while (walk.next()) {
    if (walk.rate() == 0) continue;
    double t = walk.t() + kernel::exponential(rng) / walk.rate();
    for (; t < walk.t_end(); t += kernel::exponential(rng) / walk.rate()) found.push_back(t);
  }
  return found;
}

std::vector<TrackedRay> track(const ParticipatingMedium& cloud, const Affine& world_to_index, int count) {
  const Bounds3 box = cloud.bounds();
  Rng rng(1);
  const auto point = [&] { return box.min + box.extent() * Vec3{rng.uniform(), rng.uniform(), rng.uniform()}; };
  std::vector<TrackedRay> rays;
  while (rays.size() < static_cast<std::size_t>(count)) {
    const Vec3 from = point();
    const Ray ray{from, normalize(point() - from)};
    TrackedRay tracked{
        GridRay(cloud.data().density.to_local, ray).line(), {}, {}, tentative_collisions(cloud.data(), ray, rng)};
    const GridVec o = world_to_index.point(ray.o), d = world_to_index.vector(ray.d);
    for (int i = 0; i < 3; ++i) {
      tracked.o[i] = o[i];
      tracked.d[i] = d[i];
    }
    rays.push_back(std::move(tracked));
  }
  return rays;
}

/// sink(value) for every look-up, at points computed in Real; the sink is given back.
template <typename Real, typename Sink>
Sink read_nanovdb(const nanovdb::FloatGrid& grid, const std::vector<TrackedRay>& rays, Sink sink) {
  const auto accessor = grid.getAccessor();
  const auto sampler = nanovdb::createSampler<1>(accessor);
  for (const TrackedRay& ray : rays) {
    const nanovdb::Vec3<Real> o(ray.o), d(ray.d);
    for (const double t : ray.t) sink(sampler(o + d * static_cast<Real>(t)));
  }
  return sink;
}

template <typename Sink>
Sink read_tyndall(const BrickGrid& grid, const std::vector<TrackedRay>& rays, Sink sink) {
  for (const TrackedRay& ray : rays)
    for (const double t : ray.t) sink(grid.lookup(ray.line, t));
  return sink;
}

struct Sum {
  float total = 0;
  void operator()(float value) { total += value; }
};

double largest_difference(const nanovdb::FloatGrid& theirs, const BrickGrid& ours, const std::vector<TrackedRay>& rays) {
  std::vector<float> values;
  read_nanovdb<double>(theirs, rays, [&](float value) { values.push_back(value); });
  std::size_t i = 0;
  double worst = 0;
  read_tyndall(ours, rays, [&](float value) { worst = std::max(worst, std::abs(double{value} - values[i++])); });
  return worst;
}

void density(benchmark::State& state) {
  const NanoFile file = read_nano_file(kCloud, std::numeric_limits<std::size_t>::max());
  const auto& theirs = *reinterpret_cast<const nanovdb::FloatGrid*>(file.grids[0].bytes.data());
  Medium medium;
  VdbMedium vdb;
  vdb.path = kCloud;
  medium.kind = vdb;
  const ParticipatingMedium cloud = test::built(medium, {{}, Rgb{float(state.range(0))}, 0});
  const BrickGrid& ours = cloud.data().density.grid;
  const Affine world_to_index = Affine::of(open_volume(kCloud)->load(0).index_to_world.inverse());
  const std::vector<TrackedRay> rays = track(cloud, world_to_index, 1000);
  std::size_t points = 0;
  for (const TrackedRay& ray : rays) points += ray.t.size();

  double nanovdb_seconds = kInfinity, tyndall_seconds = kInfinity;
  for (auto _ : state) {
    const double start = thread_seconds();
    benchmark::DoNotOptimize(read_nanovdb<float>(theirs, rays, Sum()));
    const double middle = thread_seconds();
    benchmark::DoNotOptimize(read_tyndall(ours, rays, Sum()));
    nanovdb_seconds = std::min(nanovdb_seconds, middle - start);
    tyndall_seconds = std::min(tyndall_seconds, thread_seconds() - middle);
  }
  state.counters["points"] = double(points);
  state.counters["nanovdb_ns"] = nanovdb_seconds / double(points) * 1e9;
  state.counters["tyndall_ns"] = tyndall_seconds / double(points) * 1e9;
  state.counters["ratio"] = nanovdb_seconds / tyndall_seconds;
  state.counters["error"] = largest_difference(theirs, ours, rays) / ours.range().max;
}

void density_of_noise(benchmark::State& state) {
  const CloudMedium cloud;
  constexpr int kPoints = 100'000;
  for (auto _ : state) {
    const double start = thread_seconds();
    Rng rng(1);
    for (int i = 0; i < kPoints; ++i)
      benchmark::DoNotOptimize(cloud_density(cloud, {rng.uniform(), 1 - rng.uniform(), rng.uniform()}));
    state.counters["procedural"] = (thread_seconds() - start) / kPoints * 1e9;
  }
}

BENCHMARK(density_of_noise)->Iterations(10)->Unit(benchmark::kMillisecond);
BENCHMARK(density)->Arg(1)->Arg(4)->Arg(16)->Iterations(50)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tyndall
