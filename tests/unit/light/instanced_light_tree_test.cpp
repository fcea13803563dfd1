#include "light/instanced_light_tree.h"

#include <doctest/doctest.h>

#include "instanced_cases.h"
#include "segment_cases.h"
#include "support/chi_squared.h"

namespace tyndall {
namespace {

using NodeRef = InstancedLightTree::NodeRef;

/// A tree, and the leaves of its lights.
struct Case {
  InstancedLightTree tree;
  std::vector<NodeRef> leaf;  ///< by LightId; kAll: dark

  explicit Case(SelectionInput input) : leaf(test::size_of(input), InstancedLightTree::kAll) {
    const auto alone = static_cast<LightId>(input.power.size());
    tree = InstancedLightTree(input);
    tree.for_each_leaf([&](LightId light, NodeRef ref) { leaf[light] = ref; });
    for (LightId light = alone; light < leaf.size(); ++light) leaf[light] = tree.leaf_of(light);
  }
};

/// What no light gets, from the root down.
template <typename Query>
double dead_mass(const InstancedLightTree& tree, const Query& query, std::size_t& alive) {
  const auto local = tree.localize(query);
  std::vector<std::pair<NodeRef, double>> stack{{tree.root(), 1.0}};
  double dead = 0;
  while (!stack.empty()) {
    const auto [ref, mass] = stack.back();
    stack.pop_back();
    if (tree.is_leaf(ref)) {
      ++alive;
      continue;
    }
    tree.open(ref, local, [&](NodeRef first, const WideNode& node, const auto& question, float) {
      const ChildImportance children = child_importance(node, question);
      double sum = 0;
      for (const float c : children.of) sum += c;
      if (!(sum > 0)) dead += mass;
      for (NodeRef i = 0; i < 8; ++i)
        if (children.of[i] > 0) stack.push_back({first + i, mass * children.of[i] / sum});
      return true;
    });
  }
  constexpr double by_number = 0x1p-20;
  const double lights = tree.count_of(tree.root());
  return (1 - by_number) * dead + by_number * (1 - double(alive) / lights);
}

template <typename Query>
void check_sums(const Case& c, const Query& q) {
  std::size_t alive = 0, chosen = 0;
  const double dead = dead_mass(c.tree, q, alive);
  double sum = 0;
  for (const NodeRef leaf : c.leaf) {
    const double pmf = leaf == InstancedLightTree::kAll ? 0 : c.tree.pmf(q, leaf);
    REQUIRE((pmf >= 0 && pmf <= 1));
    sum += pmf;
    chosen += pmf > 0;
  }
  REQUIRE(std::abs(sum - (1 - dead)) < 1e-5);
  REQUIRE(chosen == alive);
}

TEST_CASE("instances: the tree is sound, every light with power has a leaf of its own, parents lead to the root") {
  const SelectionInput input = test::instanced_lights(9, 3);
  const Case c(input);
  std::vector<NodeRef> seen;
  for (LightId light = 0; light < c.leaf.size(); ++light) {
    NodeRef ref = c.leaf[light];
    if (ref == InstancedLightTree::kAll) continue;
    seen.push_back(ref);
    REQUIRE(c.tree.is_leaf(ref));
    REQUIRE(c.tree.count_of(ref) == 1);
    const auto choice = c.tree.select_below(ref, c.tree.localize(PointQuery{}), 0.5);
    REQUIRE((choice && choice->light == light && choice->pmf == 1));
    std::uint32_t count = 1;
    int steps = 0;
    for (; ref != c.tree.root(); ref = c.tree.parent_of(ref)) {
      REQUIRE(c.tree.count_of(ref) >= count);
      count = c.tree.count_of(ref);
      REQUIRE(++steps < 64);
    }
    REQUIRE(c.tree.count_of(ref) == test::world_bounds(input).size());
  }
  CHECK(seen.size() == test::world_bounds(input).size());
  std::sort(seen.begin(), seen.end());
  CHECK(std::adjacent_find(seen.begin(), seen.end()) == seen.end());
}

TEST_CASE("instances: the pmf sums to 1 less the dead mass, for points and segments") {
  for (const std::size_t n : {2u, 7u, 40u}) {
    const SelectionInput input = test::instanced_lights(n, 10 + n);
    const Case c(input);
    for (const PointQuery& q : test::instanced_queries(input, 40, n)) check_sums(c, q);
    for (const SegmentQuery& q : test::segments_for(test::world_bounds(input), 40, n)) check_sums(c, Segment(q));
  }
}

TEST_CASE("instances: what select() returns is what pmf() says") {
  const SelectionInput input = test::instanced_lights(30, 5);
  const Case c(input);
  Rng rng(8);
  std::size_t selected = 0;
  const auto points = test::instanced_queries(input, 300, 6);
  const auto segments = test::segments_for(test::world_bounds(input), 300, 6);
  const auto check = [&](const auto& q, double u) {
    const auto s = c.tree.select(q, u);
    if (!s) return;
    ++selected;
    REQUIRE(s->pmf > 0);
    REQUIRE(c.leaf[s->light] != InstancedLightTree::kAll);
    REQUIRE(std::abs(c.tree.pmf(q, c.leaf[s->light]) - s->pmf) <= 1e-6 * s->pmf);
  };
  for (std::size_t i = 0; i < 60'000; ++i) {
    const double u = i % 50 == 0 ? rng.uniform_wide() * 0x1p-20 : rng.uniform_wide();
    check(points[i % points.size()], u);
    if (i % 4 == 0) check(Segment(segments[i / 4 % segments.size()]), u);
  }
  CHECK(selected > 40'000);
}

TEST_CASE("instances: by number every light that can contribute is chosen, once") {
  const SelectionInput input = test::instanced_lights(6, 15);
  const Case c(input);
  for (const PointQuery& q : test::instanced_queries(input, 20, 5)) {
    const std::uint32_t n = c.tree.count_of(c.tree.root());
    std::vector<int> times(c.leaf.size());
    for (std::uint32_t i = 0; i < n; ++i)
      if (const auto s = c.tree.select(q, (i + 0.5) / n * 0x1p-20)) ++times[s->light];
    for (LightId light = 0; light < times.size(); ++light) {
      const NodeRef leaf = c.leaf[light];
      REQUIRE(times[light] == (leaf != InstancedLightTree::kAll && c.tree.pmf(q, leaf) > 0));
    }
  }
}

template <typename Query>
void check_frequencies(const Case& c, const Query& q) {
  constexpr int kDraws = 40'000;
  std::vector<double> counts(c.leaf.size());
  Rng rng(4);
  for (int i = 0; i < kDraws; ++i)
    if (const auto s = c.tree.select(q, (i + rng.uniform_wide()) / kDraws)) counts[s->light] += 1;
  std::vector<double> pmf(counts.size());
  for (LightId light = 0; light < counts.size(); ++light) {
    pmf[light] = c.leaf[light] == InstancedLightTree::kAll ? 0 : c.tree.pmf(q, c.leaf[light]);
    REQUIRE((pmf[light] > 0 || counts[light] == 0));
  }
  CHECK(test::count_p_value(counts, pmf, kDraws) > 1e-5);
}

TEST_CASE("instances: lights are chosen with their probability") {
  const SelectionInput input = test::instanced_lights(12, 21);
  const Case c(input);
  for (const PointQuery& q : test::instanced_queries(input, 12, 9)) check_frequencies(c, q);
  for (const SegmentQuery& q : test::segments_for(test::world_bounds(input), 12, 9)) check_frequencies(c, Segment(q));
}

/// In the world, lights of instances like any others.
SelectionInput alone(const SelectionInput& input) {
  SelectionInput result;
  for (const LightBounds& l : test::world_bounds(input)) {
    result.near.push_back({l, static_cast<LightId>(result.power.size())});
    result.power.push_back(l.intensity);
  }
  return result;
}

TEST_CASE("instances: importance is comparable with that of the same lights alone, in instances of every size") {
  // Once all clusters are single lights, what a cut gives them is their importance alone.
  SelectionInput input = test::instanced_lights(8, 31);
  const SelectionInput expanded = alone(input);
  std::vector<LightId> ids;
  for (const TreeLight& l : input.near) ids.push_back(l.light);
  for (const LightInstance& i : input.instances)
    for (const TreeLight& l : input.objects[i.object].near) ids.push_back(i.first + l.light);
  const auto shared = make_selector(LightStrategy::tree, input), single = make_selector(LightStrategy::tree, expanded);
  const CutSettings settings{1'000'000, 1};
  double worst = 0;
  const auto compare = [&](const auto& q) {
    const LightCut a = shared->cut(q, settings), b = single->cut(q, settings);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const double x = shared->n_pmf(a, q, ids[i]), y = single->n_pmf(b, q, static_cast<LightId>(i));
      if (x > 2000 && y > 2000) worst = std::max(worst, std::abs(std::log(x / y)));
    }
  };
  Rng rng(3);
  for (PointQuery q : test::instanced_queries(input, 60, 3)) {
    q.p = test::random_direction(rng) * 40.0f;
    if (q.g > 0) q.forward = normalize(test::random_direction(rng) - q.p * 0.05f);
    compare(q);
  }
  for (SegmentQuery q : test::segments_for(test::world_bounds(input), 60, 3)) {
    q.o = normalize(q.o) * 60.0f;
    q.t0 = 0;
    q.t1 = 5;
    q.profile = test::homogeneous_profile(q.t0, q.t1, 0.1f, 60, 0.3f);
    compare(q);
  }
  CHECK(worst < 0.2);  // factors of scale would be two orders larger
  CHECK(worst > 0);
}

TEST_CASE("instances: from afar each gets the share that its lights get alone") {
  const SelectionInput input = test::instanced_lights(10, 81);
  const auto shared = make_selector(LightStrategy::tree, input), single = make_selector(LightStrategy::tree, alone(input));
  double worst = 0;
  const auto compare = [&](const auto& q) {
    auto next = static_cast<LightId>(input.near.size());
    for (const LightInstance& i : input.instances) {
      double x = 0, y = 0;
      for (const TreeLight& l : input.objects[i.object].near) {
        x += shared->pmf(q, i.first + l.light);
        y += single->pmf(q, next++);
      }
      if (x + y > 0.01) worst = std::max(worst, std::abs(std::log(x / y)));
    }
  };
  Rng rng(6);
  for (int k = 0; k < 30; ++k) {
    const Vec3 p = test::random_direction(rng) * 40.0f;
    compare(PointQuery{.p = p, .n = {}});
    SegmentQuery q{.o = p, .d = test::random_direction(rng), .t0 = 0, .t1 = 5};
    q.importance = MediaStrategy::integral;
    compare(q);
  }
  CHECK(worst < 0.4);
  CHECK(worst > 0);
}

TEST_CASE("instances: they are reckoned with where most of their power is") {
  SelectionInput input;
  SharedLights& object = input.objects.emplace_back();
  for (LightBounds l : test::mixed_lights(64, 4)) {
    l = test::point_bounds(l.box.min, object.near.empty() ? 1000.0f : 0.01f);
    if (object.near.empty()) l.box.min = l.box.max = {0.9f, 0.9f, 0.9f};
    object.near.push_back({l, static_cast<LightId>(object.power.size())});
    object.power.push_back(l.intensity);
  }
  for (LightId i = 0; i < 2; ++i) {
    const Transform map =
        Transform::translate(i * 20.0, 0, 0) * Transform::rotate(200.0 * i, 1, 2, 3) * Transform::scale(2, 2, 2);
    input.instances.push_back({0, 64 * i, *Similarity::of(map), 4});
  }
  const Case c(input);
  Rng rng(3);
  for (int k = 0; k < 40; ++k) {
    const PointQuery q{.p = Vec3{20.0f * (k % 2), 0, 0} + test::random_direction(rng) * 6.0f, .n = {}};
    const Vec3d bright(0.9, 0.9, 0.9);
    const double a = length(Vec3d(q.p) - input.instances[0].to_world.point(bright)),
                 b = length(Vec3d(q.p) - input.instances[1].to_world.point(bright));
    CHECK(c.tree.pmf(q, c.leaf[0]) == doctest::Approx(b * b / (a * a + b * b)).epsilon(0.05));
  }
}

TEST_CASE("instances: cuts go into them, and every light is drawn as often as expected") {
  for (const bool sun : {false, true}) {
    const SelectionInput input = test::instanced_lights(6, 41, sun);
    const std::size_t n = test::size_of(input);
    const auto selector = make_selector(LightStrategy::tree, input);
    bool inside = false;
    const auto check = [&](const auto& q, const CutSettings& settings) {
      const LightCut cut = selector->cut(q, settings);
      for (const LightCluster& c : cut) inside = inside || (c.ref / 8 > 8 && c.ref < 0x80000000);
      std::vector<double> drawn(n);
      Rng rng(2);
      constexpr int kDraws = 3000;
      for (int i = 0; i < kDraws; ++i) {
        for (const LightCandidate& c : selector->draw(cut, q, rng.uniform_wide())) {
          drawn[c.light] += 1;
          REQUIRE(std::abs(c.n_pmf - selector->n_pmf(cut, q, c.light)) <= 1e-5f * c.n_pmf);
        }
      }
      double sum = 0;
      for (LightId light = 0; light < n; ++light) {
        const double e = kDraws * double(selector->n_pmf(cut, q, light));
        sum += e;
        CHECK(std::abs(drawn[light] - e) <= 6 * std::sqrt(e) + 6);
        if (e == 0) CHECK(drawn[light] == 0);
      }
      CHECK(sum <= kDraws * candidates_of(cut) * (1 + 1e-5));
    };
    for (const PointQuery& q : test::instanced_queries(input, 10, 9)) {
      for (const CutSettings s : {CutSettings{4, 0.5f}, {16, 1}, {0, 0.7f}, {6, 0, true}}) check(q, s);
    }
    for (const SegmentQuery& q : test::segments_for(test::world_bounds(input), 6, 9)) check(q, {8, 0.8f});
    CHECK(inside);
  }
}

TEST_CASE("instances: splitting 1 without a limit goes down to single lights") {
  const SelectionInput input = test::instanced_lights(5, 51);
  const auto selector = make_selector(LightStrategy::tree, input);
  for (const PointQuery& q : test::instanced_queries(input, 12, 9)) {
    const LightCut all = selector->cut(q, {0, 1});
    for (LightId i = 0; i < test::size_of(input); ++i) {
      const float expected = selector->n_pmf(all, q, i);
      CHECK((expected == 0 || expected == 1));
      if (selector->pmf(q, i) > 0) CHECK(expected == 1);
    }
  }
}

TEST_CASE("instances: scaling the scene by powers of two changes no probability") {
  const SelectionInput input = test::instanced_lights(5, 61);
  const Case c(input);
  for (const int k : {-20, 9}) {
    const double s = std::ldexp(1.0, k);
    SelectionInput scaled = input;
    for (TreeLight& l : scaled.near) l.bounds.box = {l.bounds.box.min * float(s), l.bounds.box.max * float(s)};
    for (LightInstance& i : scaled.instances)
      i.to_world = *Similarity::of(Transform::scale(s, s, s) * test::transform_of(i.to_world));
    const Case d(scaled);
    for (PointQuery q : test::instanced_queries(input, 20, 5)) {
      PointQuery large = q;
      large.p = q.p * float(s);
      for (LightId light = 0; light < c.leaf.size(); light += 7) {
        if (c.leaf[light] == InstancedLightTree::kAll) continue;
        REQUIRE(d.leaf[light] == c.leaf[light]);
        CHECK(d.tree.pmf(large, c.leaf[light]) == doctest::Approx(c.tree.pmf(q, c.leaf[light])).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("instances: other strategies choose among every light on its own") {
  const SelectionInput input = test::instanced_lights(7, 71);
  const std::size_t n = test::size_of(input);
  for (const LightStrategy strategy : {LightStrategy::uniform, LightStrategy::power, LightStrategy::tree_binary}) {
    const auto selector = make_selector(strategy, input);
    for (const PointQuery& q : test::instanced_queries(input, 6, 5)) {
      double sum = 0;
      for (LightId light = 0; light < n; ++light) sum += selector->pmf(q, light);
      CHECK(sum <= 1 + 1e-5);
      if (strategy != LightStrategy::tree_binary) CHECK(sum > 1 - 1e-5);
    }
    if (strategy == LightStrategy::tree_binary) continue;
    const LightInstance& last = input.instances.back();
    const SharedLights& object = input.objects[last.object];
    double total = 0;
    for (const double w : input.power) total += w;
    for (const LightInstance& i : input.instances)
      for (const double w : input.objects[i.object].power) total += w * i.growth;
    for (LightId i = 0; i < object.power.size(); ++i) {
      const float pmf = selector->pmf(PointQuery{}, last.first + i);
      CHECK((pmf > 0) == (object.power[i] > 0));
      if (strategy == LightStrategy::power) CHECK(pmf == doctest::Approx(object.power[i] * last.growth / total));
    }
  }
}

}  // namespace
}  // namespace tyndall
