#include "transport/budget/light_counts.h"

#include <doctest/doctest.h>

#include "light/query.h"
#include "session/world_parts.h"
#include "support/sphere_scene.h"

namespace tyndall {
namespace {

/// Counts in a world with as many point lights, and an area light or none.
class Counted {
 public:
  Counted(int points, bool area_light)
      : world_(test::world_of(scene(points, area_light), {.lights = {LightStrategy::tree, LightStrategy::lightcuts}})) {}

  /// `lobe`: its share of what is scattered.
  LightCounts vertex(const RenderSettings& settings, int bounce, float lobe = 0) {
    PointQuery query{.p = {0, 0, 0}, .n = {0, 0, -1}, .diffuse = 1 - lobe};
    query.lobe_count = lobe > 0 ? 1 : 0;
    const LightContext here = context(settings, bounce);
    return counts_at_vertex(here, here.selector, query);
  }
  SpanCounts span(const RenderSettings& settings, int bounce, float scattered) {
    const LightContext here = context(settings, bounce);
    return counts_along_span(here, here.selector, scattered);
  }

  const LightBudget* measured = nullptr;
  int mirrors = 0;  ///< of the bounces

  CutSettings cut(const RenderSettings& settings, int candidates) { return cut_settings(context(settings, 0), candidates); }

 private:
  static std::string scene(int points, bool area_light) {
    std::string text = test::sphere_scene(4, 4);
    for (int i = 1; i < points; ++i) text += "LightSource \"point\" \"point3 from\" [2 0 " + std::to_string(i) + "]\n";
    if (area_light) text += "AreaLightSource \"diffuse\"\nShape \"sphere\" \"float radius\" 0.1\n";
    return text;
  }
  LightContext context(const RenderSettings& settings, int bounce) {
    LightContext context{
        world_.parts().built, world_.parts().built.lights.selector(settings.lights), settings, sampler_, counters_, bounce,
        bounce - mirrors};
    context.budget = measured;
    return context;
  }

  World world_;
  Sampler sampler_{{0, 0, 0, 0}};
  Counters counters_;
};

void check(LightCounts counts, int candidates, int shadow_rays) {
  CHECK(counts.candidates == candidates);
  CHECK(counts.shadow_rays == shadow_rays);
}

TEST_CASE("single scattering has more candidates, and so have glossy surfaces") {
  Counted many(8, true);
  RenderSettings deep, direct;
  deep.max_depth = 5;
  direct.max_depth = 1;
  for (const int bounce : {0, 1, 4}) {
    const bool late = bounce > 1;
    check(many.vertex(deep, bounce), late ? 1 : 2, late ? 1 : 2);
    check(many.vertex(deep, bounce, 0.9f), 4, 2);
    check(many.vertex(deep, bounce, 0.1f), late ? 1 : 2, late ? 1 : 2);  // coated
    check(many.span(deep, bounce, 0.5f), late ? 1 : 3, late ? 1 : 2);
  }
  check(many.vertex(direct, 0), 8, 4);
  check(many.vertex(direct, 0, 0.9f), 8, 4);
  check(many.span(direct, 0, 0.5f), 16, 8);
}

TEST_CASE("what mirrors show has the numbers of what the camera sees") {
  Counted many(8, true);
  const LightBudget budget{{7, 5}, {6, 4}};
  many.measured = &budget;
  many.mirrors = 1;
  check(many.vertex({}, 1), 7, 5);
  check(many.span({}, 1, 0.5f), 6, 4);
  check(many.vertex({}, 2), 2, 2);
  check(many.vertex({}, 3), 1, 1);
}

TEST_CASE("segments that scatter next to nothing have one candidate") { check(Counted(3, true).span({}, 0, 0.9e-3f), 1, 1); }

TEST_CASE("segments that scatter little seldom have pairs, but in single scattering and where candidates are set") {
  Counted many(3, true);
  RenderSettings direct, set;
  direct.max_depth = 1;
  set.candidates = 2;
  CHECK(many.span({}, 0, 0.5f).chance == 1);
  CHECK(many.span({}, 0, 0.05f).chance == doctest::Approx(0.5));
  CHECK(many.span({}, 2, 1e-4f).chance == 1 / 16.0f);
  CHECK(many.span({}, 0, 0).chance == 1 / 16.0f);  // perhaps the coarse profile has missed something
  CHECK(many.span(direct, 0, 0.05f).chance == 1);
  CHECK(many.span(set, 0, 0.05f).chance == 1);
}

TEST_CASE("at one point a light without extent is one candidate") {
  RenderSettings direct;
  direct.max_depth = 1;
  check(Counted(5, false).vertex(direct, 0), 5, 4);
  check(Counted(5, true).vertex(direct, 0), 8, 4);
  check(Counted(1, false).span(direct, 0, 0.5f), 16, 8);  // from several points along the segment
}

TEST_CASE("what was measured holds at the first vertex and along the first segment, up to what there are lights") {
  Counted many(20, true), three(2, true);
  const LightBudget measured{{12, 7}, {9, 5}};
  RenderSettings deep, set;
  set.candidates = 3;
  many.measured = three.measured = &measured;
  check(many.vertex(deep, 0), 12, 7);
  check(many.vertex(deep, 0, 0.9f), 12, 7);
  check(many.span(deep, 0, 0.5f), 9, 5);
  check(many.vertex(deep, 1), 2, 2);
  check(many.span(deep, 1, 0.5f), 3, 2);
  check(three.vertex(deep, 0), 3, 2);
  check(three.span(deep, 0, 0.5f), 3, 2);
  RenderSettings direct;
  direct.max_depth = 1;
  check(many.vertex(direct, 0), 12, 7);
  check(three.vertex(direct, 0), 12, 7);  // other points of the same lights
  check(three.span(direct, 0, 0.5f), 9, 5);
  check(many.vertex(set, 0), 3, 7);
}

TEST_CASE("a strategy that sizes its cuts itself is limited by what is set alone") {
  Counted many(20, true);
  RenderSettings cuts, set;
  cuts.lights = set.lights = LightStrategy::lightcuts;
  set.candidates = 3;
  set.shadow_rays = 1;
  check(many.vertex(cuts, 0), 0, 0);
  check(many.vertex(set, 0), 3, 1);
  const SpanCounts faint = many.span(cuts, 0, 1e-5f);
  check(faint, 0, 0);
  CHECK(faint.chance == 1);
  check(many.span(set, 0, 0.5f), 3, 1);
}

TEST_CASE("paths that share have more candidates and shadow rays at their first vertex") {
  RenderSettings sharing;
  sharing.reuse = ReuseStrategy::pixels;
  check(Counted(20, true).vertex(sharing, 0), 8, 4);
  check(Counted(20, true).vertex(sharing, 1), 2, 2);
}

TEST_CASE("few lights need few candidates, unless the path ends there") {
  RenderSettings deep, direct;
  deep.max_depth = 5;
  direct.max_depth = 1;
  Counted one(1, false), three(2, true);
  check(one.vertex(deep, 0), 1, 1);
  check(one.vertex(deep, 0, 0.9f), 1, 1);
  check(one.span(deep, 0, 0.5f), 1, 1);
  check(three.vertex(deep, 1), 2, 2);
  check(three.vertex(deep, 1, 0.9f), 3, 2);
  check(three.span(deep, 0, 0.5f), 3, 2);
  check(Counted(1, true).span(deep, 1, 0.5f), 2, 1);
  check(three.vertex(direct, 0), 8, 4);
  check(three.span(direct, 0, 0.5f), 16, 8);
}

TEST_CASE("cuts find near lights, unless a score is set or nothing limits them") {
  Counted lights(2, false);
  RenderSettings set;
  set.splitting = 0.2f;
  for (const int candidates : {1, 2, 8, 32}) CHECK(lights.cut({}, candidates).near_lights);
  CHECK(lights.cut({}, 0).splitting == 0.5f);
  for (const int candidates : {0, 1, 8}) {
    CHECK(lights.cut(set, candidates).splitting == 0.2f);
    CHECK(!lights.cut(set, candidates).near_lights);
  }
}

TEST_CASE("what is set holds everywhere") {
  Counted many(3, false);
  RenderSettings set;
  set.candidates = 12;
  set.shadow_rays = 0;
  for (const int bounce : {0, 1}) {
    check(many.vertex(set, bounce), 12, 0);
    check(many.vertex(set, bounce, 0.9f), 12, 0);
    for (const float scattered : {0.5f, 1e-5f}) check(many.span(set, bounce, scattered), 12, 0);
  }
}

}  // namespace
}  // namespace tyndall
