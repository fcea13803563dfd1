#include "transport/media/span.h"

#include <doctest/doctest.h>

using namespace tyndall;

namespace {

std::vector<ParticipatingMedium> three_media() {
  std::vector<ParticipatingMedium> media;
  std::vector<std::string> notes;
  for (int i = 0; i < 3; ++i) {
    Medium m;
    m.kind = HomogeneousMedium{};
    media.push_back(build_medium(m, {}, notes));
  }
  return media;
}

}  // namespace

TEST_CASE("media at a point are those inside less those outside of each group that holds it") {
  const auto media = three_media();
  // 0: smoke in nothing. 1: smoke in fog. 2: another box of smoke. 3: nothing in fog.
  const std::vector<BoundaryGroup> groups{{0, {}}, {0, 1}, {0, {}}, {{}, 1}};
  MediaState state(MediumId{1});
  CHECK(state.active(groups, media).size() == 1);

  SUBCASE("a medium without an outside adds to what is there") {
    CHECK(state.cross(0, 1));
    const auto active = state.active(groups, media);
    REQUIRE(active.size() == 2);
    CHECK(active[0] == &media[1]);
    CHECK(active[1] == &media[0]);
  }
  SUBCASE("one with an outside replaces it") {
    state.cross(1, 1);
    const auto active = state.active(groups, media);
    REQUIRE(active.size() == 1);
    CHECK(active[0] == &media[0]);
  }
  SUBCASE("two groups of one medium count twice") {
    state.cross(0, 1);
    state.cross(2, 1);
    CHECK(state.active(groups, media).size() == 3);
  }
  SUBCASE("never below zero: a hole in fog inside a hole in fog") {
    state.cross(3, 1);
    state.cross(1, 1);
    CHECK(state.active(groups, media).size() == 1);
  }
  SUBCASE("entering twice takes leaving twice") {
    state.cross(0, 1);
    state.cross(0, 1);
    state.cross(0, -1);
    CHECK(state.active(groups, media).size() == 2);
    state.cross(0, -1);
    CHECK(state.active(groups, media).size() == 1);
    CHECK_FALSE(state.cross(0, -1));
  }
}

TEST_CASE("a span's intervals follow the crossings") {
  const auto media = three_media();
  const std::vector<BoundaryGroup> groups{{0, {}}, {2, {}}};
  Crossings crossings;
  crossings.push_back({1.0f, 0, 1});
  crossings.push_back({2.0f, 1, 1});
  crossings.push_back({3.0f, 0, -1});
  crossings.push_back({4.0f, 1, -1});
  SpanWalk walk({groups, media}, MediaState(), crossings, 5.0f);

  const auto a = walk.next();
  REQUIRE(a);
  CHECK(a->t0 == 1);
  CHECK(a->t1 == 2);
  CHECK(a->media.size() == 1);
  const auto b = walk.next();
  REQUIRE(b);
  CHECK(b->media.size() == 2);
  CHECK(walk.state().in_any_group());
  const auto c = walk.next();
  REQUIRE(c);
  CHECK(c->t1 == 4);
  CHECK(c->media[0] == &media[2]);
  CHECK_FALSE(walk.next());
  CHECK_FALSE(walk.state().in_any_group());
  CHECK(walk.parity_errors() == 0);
}

TEST_CASE("leaving what was never entered is counted") {
  const auto media = three_media();
  const std::vector<BoundaryGroup> groups{{0, {}}};
  Crossings crossings;
  crossings.push_back({1.0f, 0, -1});
  SpanWalk walk({groups, media}, MediaState(), crossings, 2.0f);
  CHECK_FALSE(walk.next());
  CHECK(walk.parity_errors() == 1);
}

TEST_CASE("the box around media holds those that bring them, and everything in a medium without bounds") {
  const std::vector<BoundaryGroup> groups{
      {0, {}, {{-1, -1, -1}, {1, 1, 1}}}, {1, {}, {{0, 0, 0}, {3, 2, 2}}}, {{}, 1, {{-9, -9, -9}, {9, 9, 9}}}};
  MediaState state;
  for (const std::uint32_t group : {0u, 1u, 2u}) state.cross(group, 1);
  CHECK(state.bounds(groups).min == Vec3{-1, -1, -1});
  CHECK(state.bounds(groups).max == Vec3{3, 2, 2});
  state.set_unbounded(MediumId{2});
  for (const Vec3 far : {Vec3{1e30f, 0, 0}, Vec3{0, -1e30f, 0}, Vec3{0, 0, 1e30f}}) CHECK(state.bounds(groups).contains(far));
}
