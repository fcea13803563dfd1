// The light tree at the sizes it is made for: 10^5 and 10^6 lights.
#include <doctest/doctest.h>

#include "light/light_tree.h"
#include "light/lights.h"
#include "support/chi_squared.h"
#include "unit/light/light_cases.h"

namespace tyndall {
namespace {

/// Sum over all lights of the probability, and the mass on branches where nothing contributes.
void check_sum(std::size_t n, std::size_t queries) {
  CAPTURE(n);
  const auto bounds = test::mixed_lights(n, n);
  const LightTree tree(test::numbered(bounds));
  const auto nodes = tree.nodes();
  REQUIRE(nodes.size() == 2 * n - 1);
  CHECK(tree.depth() <= 64);
  for (const PointQuery& q : test::queries_for(bounds, queries, 2)) {
    if (!(tree.importance(q) > 0)) continue;
    // Masses from the root down; a child's index is above its parent's.
    std::vector<double> mass(nodes.size());
    mass[0] = 1;
    double dead = 0, sum = 0;
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i].leaf || mass[i] == 0) continue;
      if (const auto p = tree.child_probability(i, q)) {
        mass[i + 1] = mass[i] * *p;
        mass[nodes[i].second_or_light] = mass[i] * (1 - *p);
      } else {
        dead += mass[i];
      }
    }
    for (std::uint32_t i = 0; i < nodes.size(); ++i)
      if (nodes[i].leaf) sum += tree.pmf(q, i);
    CHECK(std::abs(sum + dead - 1) < 1e-5);
  }
}

TEST_CASE("probabilities sum to 1 less the dead mass, for 100,000 lights") { check_sum(100'000, 6); }
TEST_CASE("probabilities sum to 1 less the dead mass, for a million lights") { check_sum(1'000'000, 1); }

TEST_CASE("a million triangle lights: built in little memory, chosen as stated") {
  // A slab of small emissive triangles, a query below it.
  Rng rng(1);
  constexpr std::size_t kLights = 1'000'000;
  TriangleMesh mesh;
  for (std::size_t i = 0; i < kLights; ++i) {
    const Vec3 p = test::random_in_cube(rng) * Vec3{1, 1, 0.01f};
    for (const Vec3 v : {p, p + Vec3{0, 3e-4f, 0}, p + Vec3{3e-4f, 0, 0}}) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(v);
    }
  }
  Shape shape;
  shape.kind = std::move(mesh);
  shape.emission = AreaLight{};
  shape.emission->L = Rgb(1);
  const std::vector<EmitterShape> placed{{&shape, {}}};
  const Lights lights = build_lights({}, placed, {{-1, -1, -1}, {1, 1, 1}}, {{LightStrategy::tree_binary}});
  const LightSelector& selector = lights.selector(LightStrategy::tree_binary);
  CHECK(lights.size() == kLights);
  CHECK(double(lights.memory_bytes()) / kLights < 165);

  // Frequencies of 64 groups of lights against the sums of their probabilities.
  const PointQuery q{{0.3f, 0.2f, -0.2f}, {0, 0, 1}};
  constexpr std::size_t kGroups = 64;
  constexpr int kDraws = 100'000;
  std::vector<double> expected(kGroups), counts(kGroups);
  const auto group = [](LightId id) { return hash(id) % kGroups; };
  double total = 0;
  for (LightId id = 0; id < kLights; ++id) {
    const double pmf = selector.pmf(q, id);
    expected[group(id)] += pmf * kDraws;
    total += pmf;
  }
  CHECK(total == doctest::Approx(1).epsilon(1e-4));
  double inverse = 0;  // the mean of 1/pmf is the number of lights that can be chosen
  for (int i = 0; i < kDraws; ++i) {
    const auto s = selector.select(q, rng.uniform_wide());
    REQUIRE(s);
    REQUIRE(std::abs(selector.pmf(q, s->light) - s->pmf) <= 1e-6f * s->pmf);
    counts[group(s->light)] += 1;
    inverse += 1 / double(s->pmf) / kDraws;
  }
  double statistic = 0;
  for (std::size_t i = 0; i < kGroups; ++i) statistic += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
  CHECK(test::chi_squared_tail(statistic, kGroups - 1) > 1e-4);
  CHECK(inverse == doctest::Approx(double(kLights)).epsilon(0.05));
}

}  // namespace
}  // namespace tyndall
