#include "volume/medium_walk.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/relative.h"
#include "support/test_media.h"
#include "unit/volume/voxel_oracle.h"
#include "volume/brick_builder.h"
#include "volume/merged_walk.h"

using namespace tyndall;

namespace {

/// A medium straight from voxels, so that index coordinates are those of the test.
ParticipatingMedium medium_of(const VoxelSource& source, const Transform& index_to_world, const MediumOptics& optics) {
  auto data = std::make_unique<MediumData>();
  data->kind = MediumData::Kind::grid;
  data->optics = optics;
  data->density.grid = build_brick_grid(source, {});
  const Index3& o = data->density.grid.origin();
  data->density.to_local = Affine::of(index_to_world.inverse()).minus({{double(o[0]), double(o[1]), double(o[2])}});
  data->clip = data->density.grid.support();
  return ParticipatingMedium(std::move(data));
}

struct Tiling {
  std::uint64_t pieces = 0;
  int gaps = 0, violations = 0, capped = 0, missed = 0;
};

/// Walk the ray, check that the pieces tile [t0, t1] and that their rates bound what is inside.
template <WalkMode Mode>
Tiling walk_along(const ParticipatingMedium& medium, const Ray& ray, double t0, double t1, Rng& rng) {
  Tiling result;
  MediumWalk<Mode> walk(medium.data(), ray, t0, t1);
  double at = t0;
  while (walk.next()) {
    ++result.pieces;
    if (result.pieces > 1000000) break;
    result.gaps += walk.t() != at || walk.t_end() < walk.t() ? 1 : 0;
    at = walk.t_end();
    if (std::isinf(walk.t_end())) continue;
    for (int i = 0; i < 2; ++i) {
      const double t = walk.t() + (walk.t_end() - walk.t()) * (i == 0 ? rng.uniform_wide() : rng.uniform() < 0.5f);
      if (walk.rate() == 0) {
        const GridVec p = medium.data().density.to_local.point(ray.o), d = medium.data().density.to_local.vector(ray.d);
        const GridVec q{{p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]}};
        const float density = medium.data().clip.contains(q) ? medium.data().density.grid.lookup(q) : 0;
        if (Mode == WalkMode::majorant) result.missed += density > 1e-5f ? 1 : 0;
        continue;
      }
      const LocalOptics optics = walk.optics_at(t, false);
      if constexpr (Mode == WalkMode::majorant) {
        result.violations += max_component(optics.sigma_a + optics.sigma_s) > walk.rate() ? 1 : 0;
      } else {
        const Rgb e = walk.excess_at(t);
        result.violations += std::max({std::abs(e.r), std::abs(e.g), std::abs(e.b)}) > walk.rate() / kOversampling ? 1 : 0;
      }
    }
  }
  result.gaps += at != t1 ? 1 : 0;
  result.capped = walk.capped() ? 1 : 0;
  return result;
}

constexpr double kInf = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("pieces tile the ray in all 26 directions, from planes, edges and corners, to infinity, with zeros of both signs") {
  const auto source = test::random_voxels(5, {-16, 0, 8});
  Rng rng(1);
  for (const float thickness : {0.01f, 0.3f, 100.f}) {
    const ParticipatingMedium medium = medium_of(source, {}, {Rgb{thickness}, Rgb{thickness * 2}, {}});
    const BrickGrid& grid = medium.data().density.grid;
    std::uint64_t most = 8;
    for (int i = 0; i < 3; ++i) most += 3 * static_cast<std::uint64_t>((grid.support().hi[i] - grid.support().lo[i]) / 8 + 1);
    int gaps = 0, violations = 0, capped = 0, missed = 0;
    std::uint64_t pieces = 0;
    for (int direction = 0; direction < 27; ++direction) {
      const int dx = direction % 3 - 1, dy = direction / 3 % 3 - 1, dz = direction / 9 - 1;
      if (dx == 0 && dy == 0 && dz == 0) continue;
      for (int start = 0; start < 60; ++start) {
        const float zero = start & 1 ? 0.0f : -0.0f;
        const auto part = [&](int d) { return d == 0 ? zero : static_cast<float>(d); };
        const Vec3 d = normalize({part(dx), part(dy), part(dz)});
        // Starts on multiples of 8 (bricks), 1 (cells) and anywhere, inside and out.
        const float snap = start % 3 == 0 ? 8.0f : start % 3 == 1 ? 1.0f : 0.0f;
        const auto coordinate = [&](float lo) {
          const float x = lo - 20 + rng.uniform() * 90;
          return snap > 0 ? std::round(x / snap) * snap : x;
        };
        Ray ray{{coordinate(-16), coordinate(0), coordinate(8)}, d};
        if (start % 4 == 0) ray.o = ray.at(-100);
        const double t1 = start % 5 == 0 ? kInf : 300 * rng.uniform_wide();
        const Tiling a = walk_along<WalkMode::majorant>(medium, ray, 0, t1, rng);
        const Tiling b = walk_along<WalkMode::residual>(medium, ray, 0, t1, rng);
        gaps += a.gaps + b.gaps;
        violations += a.violations + b.violations;
        capped += a.capped + b.capped;
        missed += a.missed + b.missed;
        pieces = std::max({pieces, a.pieces, b.pieces});
      }
    }
    CHECK(gaps == 0);
    CHECK(violations == 0);
    CHECK(capped == 0);
    CHECK(missed == 0);
    CHECK(pieces <= most);
  }
}

TEST_CASE("pieces tile rays through rotated, stretched, mirrored and far-off grids, and optics agree with at()") {
  const Transform transforms[] = {
      Transform::rotate(33, 1, 2, 3) * Transform::scale(0.1, 0.02, 0.3),
      Transform::scale(-0.5, 0.25, 1) * Transform::rotate(70, 0, 1, 0),
      Transform::translate(1e4, -2e4, 3e4) * Transform::scale(0.2, 0.2, 0.2),
      Transform::scale(1e-6, 1e-6, 1e-6),
      Transform::scale(1e5, 1e5, 1e5),
  };
  for (const Index3& corner : {Index3{0, 0, 0}, Index3{-2147483640, 2147483600, 1000000}}) {
    const auto source = test::random_voxels(6, corner);
    Rng rng(2);
    for (const Transform& base : transforms) {
      // Bring the far corner back to the origin, so that the world stays within reach of floats.
      const Transform transform = base * Transform::translate(-double(corner[0]), -double(corner[1]), -double(corner[2]));
      const double size =
          std::cbrt(std::abs(1 / length(transform.inverse().vector({1, 0, 0})) / length(transform.inverse().vector({0, 1, 0})) /
                             length(transform.inverse().vector({0, 0, 1}))));
      const ParticipatingMedium medium = medium_of(source, transform, {Rgb{static_cast<float>(0.2 / size)}, Rgb{0.0f}, {}});
      int gaps = 0, violations = 0, capped = 0, missed = 0;
      double difference = 0;
      for (int i = 0; i < 300; ++i) {
        const auto inside = [&] { return base.point({rng.uniform() * 48, rng.uniform() * 48, rng.uniform() * 48}); };
        const Vec3 a = inside(), b = inside();
        Ray ray{a, normalize(b - a)};
        ray.o = ray.at(-length(b - a) * 3 * rng.uniform());
        const Tiling tiling = walk_along<WalkMode::majorant>(medium, ray, 0, i % 3 == 0 ? kInf : 5 * length(b - a), rng);
        gaps += tiling.gaps;
        violations += tiling.violations;
        capped += tiling.capped;
        missed += tiling.missed;

        MediumWalk<WalkMode::majorant> walk(medium.data(), ray, 0, kInf);
        while (walk.next()) {
          if (walk.rate() == 0) continue;
          const double t = walk.t() + 0.5 * (walk.t_end() - walk.t());
          difference +=
              std::abs(walk.optics_at(t, false).sigma_a.r - medium.at(ray.at(static_cast<float>(t))).sigma_a.r) * size / 300;
        }
      }
      CHECK(gaps == 0);
      CHECK(violations == 0);
      CHECK(capped == 0);
      CHECK(missed == 0);
      CHECK(difference < 0.05);
    }
  }
}

namespace {

/// Reads pieces of a walk together and one by one: the largest difference of the sums, in units of the rate.
template <typename Walk>
double apart_together(Walk& walk, int& read, int& unbounded) {
  double worst = 0;
  while (walk.next()) {
    if (!(walk.rate() > 0) || std::isinf(walk.t_end())) continue;
    for (const int count : {1, 3, 8, 16}) {
      const Teeth teeth{walk.t(), (walk.t_end() - walk.t()) / count, count};
      const ExcessSum together = walk.excess_at(teeth), each = sum_of_each(walk, teeth);
      worst = std::max(worst, double{kernel::max_abs(together.sum - each.sum)} / walk.rate());
      unbounded += together.largest < each.largest * (1 - 1e-5f) || together.largest > walk.rate() * (1 + 1e-6f) ? 1 : 0;
      ++read;
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("teeth that are read together add up to what they are one by one, and none of them is above the rate") {
  const MediumOptics colours{Rgb{0.1f, 0.2f, 0.3f}, Rgb{0.1f}, {}};
  const auto grid = medium_of(test::random_voxels(8, {0, 0, 0}), {}, colours);
  const auto channels = medium_of(test::random_voxels(10, {0, 0, 0}, 3), {}, colours);
  const auto fog = test::homogeneous({Rgb{0.01f}, Rgb{0.02f}, 0});
  Rng rng(5);
  int read = 0, unbounded = 0;
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 a{rng.uniform() * 40, rng.uniform() * 40, rng.uniform() * 40};
    const Ray ray{a, normalize({rng.uniform() - 0.5f, rng.uniform() - 0.5f, rng.uniform() - 0.5f})};
    for (const auto& media :
         std::vector<std::vector<const ParticipatingMedium*>>{{&grid}, {&channels}, {&grid, &fog, &channels}}) {
      TrackingStats stats;
      const double apart = with_walk<WalkMode::march>(media, ray, 0, 40, stats,
                                                      [&](auto& walk) { return apart_together(walk, read, unbounded); });
      worst = std::max(worst, apart);
    }
  }
  CHECK(worst < 1e-4);
  CHECK(unbounded == 0);
  CHECK(read > 5'000);
}

TEST_CASE("merged pieces tile the ray, rates and coefficients add") {
  const auto first =
      medium_of(test::random_voxels(8, {0, 0, 0}), {}, {Rgb{0.1f, 0.2f, 0.3f}, Rgb{0.1f}, HenyeyGreenstein{0.5f}});
  const auto second = medium_of(test::random_voxels(9, {16, -8, 0}), Transform::scale(0.7, 0.7, 0.7),
                                {Rgb{0.4f}, Rgb{0.1f}, HenyeyGreenstein{-0.5f}});
  const auto fog = test::homogeneous({Rgb{0.01f}, Rgb{0.02f}, 0});
  std::vector<const ParticipatingMedium*> media{&first, &second, &fog};
  Rng rng(3);
  for (const std::size_t count : {2u, 3u, 9u}) {
    while (media.size() < count) media.push_back(media[media.size() % 3]);
    const MediaView view{media.data(), count};
    for (int i = 0; i < 200; ++i) {
      const Vec3 a{rng.uniform() * 60 - 10, rng.uniform() * 60 - 10, rng.uniform() * 60 - 10};
      const Ray ray{a, normalize({rng.uniform() - 0.5f, rng.uniform() - 0.5f, rng.uniform() - 0.5f})};
      const double t1 = i % 2 ? kInf : 40.0;
      MergedWalk<WalkMode::majorant> walk(view, ray, 0, t1);
      double at = 0;
      while (walk.next()) {
        REQUIRE(walk.t() == at);
        REQUIRE(walk.t_end() > at);
        at = walk.t_end();
        if (std::isinf(at)) continue;
        const double t = walk.t() + 0.3 * (walk.t_end() - walk.t());
        Rgb expected;
        for (const ParticipatingMedium* medium : view) expected += medium->at(ray.at(static_cast<float>(t))).sigma_t();
        const LocalOptics optics = walk.optics_at(t, false);
        REQUIRE(max_component(optics.sigma_a + optics.sigma_s) <= walk.rate() * (1 + 1e-6f));
        REQUIRE((optics.sigma_a + optics.sigma_s).g == test::relative(expected.g).epsilon(1e-3));
      }
      CHECK(at == t1);
      CHECK_FALSE(walk.capped());
    }
  }
}

TEST_CASE("empty space is crossed in few pieces and an empty grid in one") {
  test::OracleSource empty;
  empty.add_leaf({0, 0, 0}, [](auto, auto, auto) { return 0.0f; });
  const ParticipatingMedium nothing = medium_of(empty, {}, {Rgb{1.0f}, Rgb{1.0f}, {}});
  Rng rng(4);
  CHECK(walk_along<WalkMode::majorant>(nothing, {{-5, 3, 3}, {1, 0, 0}}, 0, kInf, rng).pieces == 1);

  test::OracleSource two;  // far apart
  two.add_leaf({0, 0, 0}, [](auto, auto, auto) { return 1.0f; });
  two.add_leaf({1 << 20, 0, 0}, [](auto, auto, auto) { return 1.0f; });
  const ParticipatingMedium medium = medium_of(two, {}, {Rgb{1.0f}, Rgb{1.0f}, {}});
  const Tiling tiling = walk_along<WalkMode::majorant>(medium, {{-50, 3.5f, 3.5f}, {1, 0, 0}}, 0, kInf, rng);
  CHECK(tiling.gaps == 0);
  CHECK(tiling.pieces < 70);
}
