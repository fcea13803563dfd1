#include "light/environment.h"

#include <doctest/doctest.h>

#include "environment_maps.h"
#include "light/equal_area.h"
#include "light_cases.h"
#include "math/warp.h"
#include "support/chi_squared.h"
#include "support/relative.h"
#include "tyndall/error.h"

namespace tyndall {
namespace {

/// A sky with a gradient, a black patch, noise and, unless it is overcast, a sun ten thousand times as bright.
Rgb sky(int x, int y, bool overcast = false) {
  if (x == 9 && y == 3 && !overcast) return {10'000, 9'000, 8'000};
  if (x < 3 && y > 10) return {};
  const float noise = unit_float(hash(std::uint64_t(x), std::uint64_t(y)));
  return Rgb(0.2f, 0.3f, 0.5f) * (0.5f + noise) + Rgb(0.05f * y, 0, 0);
}

InfiniteLight map_light(const std::string& path, const Transform& t = {}) {
  InfiniteLight light;
  light.to_world = t;
  light.L = {2, 1, 0.5f};
  light.path = path;
  return light;
}

/// Texel of a direction, by the documented mapping.
int texel_of(Vec3 w, int width, int height) {
  Vec2 st = equal_area_sphere_to_square(w);
  if (width != height) {
    const double phi = std::atan2(double(w.y), w.x);
    st = {static_cast<float>((phi < 0 ? phi + 2 * kPi : phi) / (2 * kPi)), static_cast<float>(std::acos(double(w.z)) / kPi)};
  }
  const int x = std::clamp(int(st.x * float(width)), 0, width - 1), y = std::clamp(int(st.y * float(height)), 0, height - 1);
  return y * width + x;
}

double texel_solid_angle(int y, int width, int height) {
  if (width == height) return 4 * kPi / (width * height);
  return 2 * kPi / width * (std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height));
}

TEST_CASE("the equal-area mapping keeps areas, inverts, and is continuous where it should be") {
  Rng rng(1);
  constexpr int kCells = 12, kSamples = 100'000;
  std::vector<double> counts(kCells * kCells);
  for (int i = 0; i < kSamples; ++i) {
    const float ux = rng.uniform(), uy = rng.uniform();
    const Vec3 w = square_to_uniform_sphere({ux, uy});
    const Vec2 p = equal_area_sphere_to_square(w);
    REQUIRE(length(equal_area_square_to_sphere(p) - w) < 2e-6f);
    counts[std::size_t(std::min(int(p.y * kCells), kCells - 1) * kCells + std::min(int(p.x * kCells), kCells - 1))] += 1;
  }
  double statistic = 0;
  const double expected = double(kSamples) / counts.size();
  for (const double c : counts) statistic += (c - expected) * (c - expected) / expected;
  CHECK(test::chi_squared_tail(statistic, double(counts.size()) - 1) > 1e-4);

  CHECK(equal_area_square_to_sphere({0.5f, 0.5f}) == Vec3{0, 0, 1});
  CHECK(equal_area_square_to_sphere({1, 0.5f}).x == doctest::Approx(1));
  CHECK(equal_area_square_to_sphere({0.5f, 1}).y == doctest::Approx(1));
  for (const Vec2 corner : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{1, 1}})
    CHECK(equal_area_square_to_sphere(corner).z == doctest::Approx(-1));
  for (const float z : {1.0f, -1.0f})
    for (const float tiny : {0.0f, 1e-20f, 1e-7f, 1e-4f}) {
      const Vec3 w = normalize(Vec3{tiny, -tiny, z});
      CHECK(length(equal_area_square_to_sphere(equal_area_sphere_to_square(w)) - w) < 1e-6f);
    }
}

void check_map(int width, int height, const Transform& to_world, bool overcast) {
  const auto texel = [&](int x, int y) { return sky(x, y, overcast); };
  const test::ScratchMap map("chi_" + std::to_string(width), width, height, texel);
  const Environment e(map_light(map.path(), to_world), {});
  const Transform to_light = to_world.inverse();

  // Radiance is the documented texel's.
  Rng rng(2);
  int different = 0;  // at the border of a texel rounding may decide otherwise
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 w = test::random_direction(rng);
    const int t = texel_of(normalize(to_light.vector(w)), width, height);
    if (e.radiance(w) != Rgb(2, 1, 0.5f) * texel(t % width, t / width)) ++different;
  }
  CHECK(different < 20);

  // The mean luminance decides what compensation leaves.
  double mean_luminance = 0;
  for (int t = 0; t < width * height; ++t)
    mean_luminance += luminance(texel(t % width, t / width)) * texel_solid_angle(t / width, width, height) / (4 * kPi);

  std::vector<double> weights, counts(std::size_t(width * height));
  double total = 0;
  for (int t = 0; t < width * height; ++t) {
    const double lum = luminance(texel(t % width, t / width));
    weights.push_back(std::max(lum - mean_luminance, 0.0) * texel_solid_angle(t / width, width, height));
    total += weights.back();
  }
  constexpr int kSamples = 100'000;
  for (int i = 0; i < kSamples; ++i) {
    const float ux = rng.uniform(), uy = rng.uniform();
    const auto s = e.sample({ux, uy});
    if (!s) continue;
    REQUIRE(s->pdf == e.pdf(s->wi));
    REQUIRE(s->L == e.radiance(s->wi));
    const int t = texel_of(normalize(to_light.vector(s->wi)), width, height);
    counts[std::size_t(t)] += 1;
    if (i % 16 == 0 && weights[std::size_t(t)] > 0 && to_world.is_identity())
      CHECK(s->pdf ==
            test::relative(weights[std::size_t(t)] / total / texel_solid_angle(t / width, width, height)).epsilon(0.02));
  }
  double statistic = 0, rest = 0, rest_expected = 0;
  int bins = 0;
  for (std::size_t t = 0; t < counts.size(); ++t) {
    const double expected = weights[t] / total * kSamples;
    if (expected >= 5) {
      statistic += (counts[t] - expected) * (counts[t] - expected) / expected;
      ++bins;
    } else {
      rest += counts[t];
      rest_expected += expected;
    }
  }
  if (rest_expected >= 5) statistic += (rest - rest_expected) * (rest - rest_expected) / rest_expected, ++bins;
  if (bins > 1) CHECK(test::chi_squared_tail(statistic, bins - 1) > 1e-5);
  CHECK(rest < rest_expected + 6 * std::sqrt(rest_expected) + 20);

  double integral = 0;
  constexpr int kSteps = 700;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < 2 * kSteps; ++j) {
      const double z = 1 - 2 * (i + 0.5) / kSteps, phi = kPi * (j + 0.5) / kSteps, r = std::sqrt(1 - z * z);
      integral += e.pdf({float(r * std::cos(phi)), float(r * std::sin(phi)), float(z)}) * 4 * kPi / (2.0 * kSteps * kSteps);
    }
  CHECK(integral == doctest::Approx(1).epsilon(0.03));
}

TEST_CASE("maps are sampled in proportion to what exceeds their mean luminance") {
  for (const bool overcast : {false, true}) {
    check_map(16, 16, {}, overcast);
    check_map(32, 16, {}, overcast);
  }
}

TEST_CASE("within large texels directions are uniform") {
  for (const int width : {4, 8}) {
    const test::ScratchMap map("coarse", width, 4, [](int x, int y) { return Rgb(0.2f + float((3 * x + 5 * y) % 7)); });
    const Environment e(map_light(map.path()), {});
    const auto result = test::chi_squared_test(
        [&](const test::Uniform& random) -> std::optional<Vec3> {
          const float x = random(), y = random();
          const auto s = e.sample({x, y});
          return s ? std::optional(s->wi) : std::nullopt;
        },
        [&](Vec3 w) { return e.pdf(w); }, {.samples = 40'000, .theta_bins = 12, .phi_bins = 24, .alpha = 1e-5});
    CHECK_MESSAGE(result.passed, width, " ", result.summary());
  }
}

TEST_CASE("maps are sampled alike under rotations, mirrors and stretching") {
  const Transform mirrored = Transform::scale(-1, 1, 1) * Transform::rotate(-90, 1, 0, 0) * Transform::rotate(33, 0, 0, 1);
  check_map(16, 16, mirrored, true);
  check_map(32, 16, mirrored, true);
  // Under a map that is no rotation the density follows the change of solid angle.
  const test::ScratchMap map("stretched", 8, 8, [](int x, int y) { return Rgb((x + y) % 2 == 0 ? 1.0f : 0.0f); });
  const Environment e(map_light(map.path(), Transform::scale(1, 2, 0.5)), {});
  const auto result = test::chi_squared_test(
      [&](const test::Uniform& random) {
        const float x = random(), y = random();
        return e.sample({x, y})->wi;
      },
      [&](Vec3 w) { return e.pdf(w); }, {.samples = 50'000, .theta_bins = 12, .phi_bins = 24});
  CHECK_MESSAGE(result.passed, result.summary());
}

TEST_CASE("a constant environment is left to scattered rays") {
  InfiniteLight light;
  light.L = {1, 2, 3};
  const Environment e(light, {});
  CHECK(e.radiance({0, 0, 1}) == Rgb(1, 2, 3));
  CHECK(!e.sample({0.3f, 0.6f}));
  CHECK(e.pdf({0, 0, 1}) == 0);
  light.illuminance = 5;
  CHECK(Environment(light, {}).radiance({0, 0, 1}).r == doctest::Approx(5 / kPi));
  const test::ScratchMap map("constant", 8, 8, [](int, int) { return Rgb(3); });
  const Environment constant_map(map_light(map.path()), {});
  CHECK(!constant_map.sample({0.3f, 0.6f}));
  CHECK(constant_map.pdf({0, 0, 1}) == 0);
  CHECK(constant_map.mean_radiance().r == doctest::Approx(6));
}

TEST_CASE("a black environment is harmless, a map of another shape is refused with the reason") {
  const test::ScratchMap black("black", 4, 4, [](int, int) { return Rgb(); });
  const Environment e(map_light(black.path()), {});
  CHECK(is_black(e.mean_radiance()));
  CHECK(!e.sample({0.3f, 0.6f}));
  const test::ScratchMap odd("odd", 6, 4, [](int, int) { return Rgb(1); });
  CHECK_THROWS_WITH_AS(Environment(map_light(odd.path()), {"a.pbrt", 3, 4}), doctest::Contains("a.pbrt:3:4"), Error);
  CHECK_THROWS_WITH_AS(Environment(map_light("no such file.exr"), {"a.pbrt", 3, 4}), doctest::Contains("a.pbrt:3:4"), Error);
}

TEST_CASE("the cones add up to the map, and each holds the light of its part") {
  for (const int width : {16, 32}) {
    const test::ScratchMap map("cones", width, 16, [](int x, int y) { return sky(x, y); });
    const Environment e(map_light(map.path(), Transform::rotate(40, 1, 2, 3)), {});
    double fluence = 0;
    Vec3d flux;
    for (const FarCone& c : e.cones()) {
      fluence += c.fluence;
      CHECK(c.sampled <= c.fluence * 1.0001f);
      flux = flux + Vec3d(c.mean) * c.fluence;
    }
    CHECK(fluence == doctest::Approx(4 * kPi * mean(e.mean_radiance())).epsilon(0.02));
    // The vector irradiance by directions of equal density.
    Rng rng(9);
    Vec3d irradiance;
    for (int i = 0; i < 4'000'000; ++i) {
      const Vec3 w = test::random_direction(rng);
      irradiance = irradiance + Vec3d(w) * (mean(e.radiance(w)) * 4 * kPi / 4e6);
    }
    CHECK(length(flux - irradiance) < 0.03 * length(irradiance));
  }
}

TEST_CASE("the sun of a map is found where it is, and none where the sky is clouded") {
  const test::ScratchMap bright("sun", 64, 32, [](int x, int y) { return x == 40 && y == 9 ? Rgb(4000) : Rgb(1); });
  const test::ScratchMap overcast("no sun", 16, 16, [](int x, int y) { return sky(x, y, true); });
  const Transform turned = Transform::rotate(40, 1, 2, 3);
  const auto sun = Environment(map_light(bright.path(), turned), {}).peak();
  REQUIRE(sun);
  const double phi = 2 * kPi * 40.5 / 64, theta = kPi * 9.5 / 32;
  const Vec3 there = turned.vector({static_cast<float>(std::sin(theta) * std::cos(phi)),
                                    static_cast<float>(std::sin(theta) * std::sin(phi)), static_cast<float>(std::cos(theta))});
  CHECK(length(sun->directions.axis - normalize(there)) < 0.02);
  const double around = 2 * kPi * 0.01, texel = texel_solid_angle(9, 64, 32);
  CHECK(sun->fluence == doctest::Approx(mean(Rgb{2, 1, 0.5f}) * (4000 * texel + around - texel)).epsilon(0.01));
  CHECK(!Environment(map_light(overcast.path()), {}).peak());
  CHECK(!Environment(InfiniteLight{}, {}).peak());
}

}  // namespace
}  // namespace tyndall
