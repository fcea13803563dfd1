#include "light/near_cut.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "light/near_light.h"
#include "light/selection.h"
#include "light_cases.h"

namespace tyndall {
namespace {

constexpr CutSettings near_lights(int candidates) { return {.candidates = candidates, .near_lights = true}; }

/// What a point light brings: intensity x cosine / distance^2; in a medium that scatters evenly without the cosine.
double brought(const LightBounds& light, const PointQuery& q) {
  const Vec3d d = Vec3d(light.box.min) - Vec3d(q.p);
  const double cosine = length_squared(q.n) > 0 ? dot(Vec3d(q.n), d) / length(d) : 1;
  return light.intensity * std::max(q.transmissive ? std::abs(cosine) : cosine, 0.0) / dot(d, d);
}

/// Points a thousandth to a tenth of the lights' mean distance off one of them, every other one on a surface.
std::vector<PointQuery> close_to(const std::vector<LightBounds>& lights, int n, Rng& rng) {
  const float apart = std::cbrt(8 / static_cast<float>(lights.size()));
  std::vector<PointQuery> queries;
  for (int i = 0; i < n; ++i) {
    const auto light = static_cast<std::size_t>(rng.uniform() * static_cast<float>(lights.size()));
    PointQuery q{};
    q.p = lights[light].box.min + test::random_direction(rng) * (apart * std::pow(10.0f, -1 - 2 * rng.uniform()));
    if (i % 2) q.n = test::random_direction(rng);
    queries.push_back(q);
  }
  return queries;
}

std::vector<LightBounds> points(std::size_t n, Rng& rng) {
  std::vector<LightBounds> lights;
  for (std::size_t i = 0; i < n; ++i)
    lights.push_back(test::point_bounds(test::random_in_cube(rng), std::exp(2 * rng.uniform())));
  return lights;
}

TEST_CASE("a light that brings a candidate's share of all gets most of a candidate, however near it is") {
  Rng rng(5);
  for (const std::size_t n : {30u, 2000u, 50'000u}) {
    const auto lights = points(n, rng);
    const auto selector = make_selector(LightStrategy::tree, test::input_of(lights));
    for (const int candidates : {1, 4, 16}) {
      int large = 0;
      for (const PointQuery& q : close_to(lights, 60, rng)) {
        const LightCut cut = selector->cut(q, near_lights(candidates));
        double all = 0;
        for (const LightBounds& light : lights) all += brought(light, q);
        for (LightId i = 0; i < n; ++i) {
          const double share = candidates * brought(lights[i], q) / all;
          if (!(share >= 2)) continue;  // all may be below the surface
          ++large;
          CHECK(selector->n_pmf(cut, q, i) > 0.5 * share);
        }
      }
      if (candidates > 1) CHECK(large > 20);
    }
  }
}

TEST_CASE("few nodes are opened for it, and the fewer the fewer the candidates") {
  Rng rng(6);
  const auto lights = points(50'000, rng);
  const auto selector = make_selector(LightStrategy::tree, test::input_of(lights));
  std::array<double, 2> mean{};
  for (int i = 0; i < 500; ++i) {
    const PointQuery q{.p = test::random_in_cube(rng), .n = {}};
    for (const std::size_t k : {0u, 1u}) mean[k] += double(selector->cut(q, near_lights(k ? 32 : 1)).size()) / 500;
  }
  CHECK(mean[0] < 8 * 7);  // measured: 35 and 49
  CHECK(mean[1] < 8 * 16);
  CHECK(mean[0] < mean[1]);
}

TEST_CASE("among lights whose boxes all overlap a cut stays small") {
  SelectionInput input;
  for (LightId i = 0; i < 5000; ++i) {
    const float r = 1 + static_cast<float>(i) * 1e-4f;
    input.near.push_back({test::triangle_bounds({-r, -r, -r}, {r, r, -r}, {-r, r, r}, true, 1), i});
    input.power.push_back(1);
  }
  const auto selector = make_selector(LightStrategy::tree, input);
  CHECK(selector->cut(PointQuery{}, near_lights(8)).size() < 300);
}

TEST_CASE("no light of a child brings more than the bound says; where the box holds the point there is none") {
  Rng rng(7);
  for (int round = 0; round < 300; ++round) {
    std::vector<LightBounds> lights;
    std::vector<Cluster> clusters;
    const Vec3 middle = test::random_in_cube(rng);
    for (int i = 0; i < 20; ++i) lights.push_back(test::point_bounds(middle + test::random_in_cube(rng, 0.2f), 0.05f));
    for (const LightBounds& light : lights) clusters.push_back(cluster_of(light));
    const std::array<Cluster, 2> children{cluster_union(clusters), clusters.front()};
    WideNode node{};
    node.set_children(children, std::array<std::uint32_t, 2>{1, 2});
    PointQuery q{.p = test::random_in_cube(rng), .n = {}};
    if (round % 2) q.n = test::random_direction(rng);
    const WideQuery local{q.p, q.n, round % 2 == 1, false};
    const double bound = nearest_light(node, local).of[0] * double{node.scale};
    for (const LightBounds& light : lights) CHECK(brought(light, q) <= bound * 1.02);  // intensities have 8 bits
    CHECK(nearest_light(node, local).of[1] == 0);
    const WideQuery inside{middle, q.n, round % 2 == 1, false};
    CHECK(nearest_light(node, inside).of[0] == kInfinity);
  }
}

TEST_CASE("cuts are finer where a lobe or a phase function peaks") {
  Rng rng(8);
  const auto selector = make_selector(LightStrategy::tree, test::input_of(points(2000, rng)));
  const auto size = [&](PointQuery q, Vec3 peak) {
    q.p = {0, 0, -6};
    if (length_squared(q.n) > 0) {
      test::add_lobe(q, q.n, 0.03f);
      q.lobes[0].sin_o = -dot(peak, q.lobes[0].tangent);
      q.lobes[0].cos_o = dot(peak, q.n);
      q.diffuse = 0.5f;
    } else {
      q.g = 0.97f;
      q.forward = peak;
    }
    return selector->cut(q, near_lights(200)).size();
  };
  for (const Vec3 n : {Vec3{}, Vec3{0, 0, 1}}) {
    const PointQuery q{.p = {}, .n = n};
    const std::size_t toward = size(q, {0, 0, 1}), away = size(q, normalize(Vec3{1, 0, 0.2f}));
    CAPTURE(away);
    CHECK(toward > 2 * away);
  }
}

}  // namespace
}  // namespace tyndall
