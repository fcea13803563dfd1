/// Small emitters on the film: each pixel finds its own, by brute force.
#include "transport/film_emitters.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "math/rng.h"

namespace tyndall {
namespace {

using Footprint = FilmEmitters::Spot;

/// Whether the filter's square around the pixel and the footprint's meet.
bool sees(int x, int y, Vec2 radius, const Footprint& footprint) {
  const float dx = std::abs(footprint.at.x - (static_cast<float>(x) + 0.5f)),
              dy = std::abs(footprint.at.y - (static_cast<float>(y) + 0.5f));
  return dx <= radius.x + footprint.radius && dy <= radius.y + footprint.radius;
}

std::vector<Footprint> random_footprints(int count, Vec2 size, Rng& rng) {
  std::vector<Footprint> footprints;
  for (int i = 0; i < count; ++i) {
    const Vec2 at{(1.4f * rng.uniform() - 0.2f) * size.x, (1.4f * rng.uniform() - 0.2f) * size.y};
    footprints.push_back({static_cast<LightId>(i), at, 0.3f * rng.uniform(), 0.1f + rng.uniform()});
  }
  return footprints;
}

float chance_of(const PixelEmitters& emitters, LightId light) {
  const FilmEmitter* found = emitters.find(light);
  return found ? found->brightness : 0.0f;
}

TEST_CASE("a pixel aims at the emitters that its filter sees, the brightest first, in crops too") {
  Rng rng(4);
  const auto footprints = random_footprints(120, {24, 18}, rng);
  for (const Vec2 radius : {Vec2{0.5f, 0.5f}, Vec2{1.5f, 1.5f}, Vec2{2, 0.75f}}) {
    for (const PixelBounds pixels : {PixelBounds{0, 0, 24, 18}, PixelBounds{5, 3, 9, 18}}) {
      const FilmEmitters all({pixels, radius}, footprints);
      for (int y = pixels.y0; y < pixels.y1; ++y) {
        for (int x = pixels.x0; x < pixels.x1; ++x) {
          std::size_t expected = 0, found = 0;
          const PixelEmitters emitters = all.of(x, y);
          double chances = 0;
          for (const Footprint& footprint : footprints) {
            const float chance = chance_of(emitters, footprint.light);
            expected += sees(x, y, radius, footprint);
            found += chance > 0;
            chances += chance;
            if (chance > 0) REQUIRE(sees(x, y, radius, footprint));
          }
          REQUIRE(found == std::min(expected, PixelEmitters::kMost));
          REQUIRE(emitters.empty() == (expected == 0));
          if (!emitters.empty()) REQUIRE(chances == doctest::Approx(1).epsilon(1e-5));
        }
      }
    }
  }
}

TEST_CASE("emitters are drawn with their pmf") {
  PixelEmitters::List list;
  for (const float brightness : {3.0f, 1.0f, 0.5f, 0.5f}) list.push_back({static_cast<LightId>(10 + list.size()), brightness});
  const PixelEmitters emitters(std::move(list));
  CHECK(chance_of(emitters, 10) == doctest::Approx(0.6));
  CHECK(chance_of(emitters, 9) == 0);
  std::array<int, 4> drawn{};
  constexpr int kDraws = 10'000;
  for (int i = 0; i < kDraws; ++i) {
    const auto [light, chance] = emitters.draw((static_cast<float>(i) + 0.5f) / kDraws);
    REQUIRE(chance == chance_of(emitters, light));
    ++drawn[light - 10];
  }
  for (LightId k = 0; k < 4; ++k) CHECK(drawn[k] == doctest::Approx(kDraws * chance_of(emitters, 10 + k)).epsilon(1e-3));
  CHECK(emitters.draw(0x1.fffffep-1f).light == 13);
}

TEST_CASE("emitters that fill a pixel, that are large, far off the film or dark are not aimed at") {
  const PixelBounds pixels{0, 0, 8, 8};
  const FilmEmitters::View view{pixels, {1, 1}};
  CHECK(view.wants({0, {4, 4}, 0.5f, 1}));
  CHECK(view.aims_at({0, {4, 4}, 0.5f, 1}));
  CHECK(view.wants({0, {4, 4}, 1.5f, 1}));
  CHECK_FALSE(view.aims_at({0, {4, 4}, 1.5f, 1}));
  CHECK_FALSE(view.wants({0, {4, 4}, 2.5f, 1}));
  CHECK_FALSE(view.wants({0, {4, 4}, 0.5f, 0}));
  CHECK_FALSE(view.wants({0, {4, 4}, 0.5f, kInfinity}));
  CHECK_FALSE(view.wants({0, {1e30f, 4}, 0.5f, 1}));
  CHECK_FALSE(view.wants({0, {4, -3}, 0.5f, 1}));
  CHECK_FALSE(FilmEmitters::View{pixels, {100, 100}}.wants({0, {4, 4}, 0.5f, 1}));
  std::vector<Footprint> crowd;
  for (LightId i = 0; i < 10; ++i) crowd.push_back({i, {4.5f, 4.5f}, 0.9f, 1});
  CHECK(FilmEmitters(view, crowd).of(4, 4).empty());
  CHECK(FilmEmitters(view, crowd).unaimed(4, 4) == FilmEmitters::Unaimed::crowd);
  crowd.resize(1);
  CHECK_FALSE(FilmEmitters(view, crowd).of(4, 4).empty());
  CHECK(FilmEmitters(view, crowd).unaimed(4, 4) == FilmEmitters::Unaimed::none);
  crowd.push_back({1, {4.5f, 4.5f}, 1.5f, 1});
  CHECK_FALSE(FilmEmitters(view, crowd).of(4, 4).empty());
  CHECK(FilmEmitters(view, crowd).unaimed(4, 4) == FilmEmitters::Unaimed::large);
  CHECK(FilmEmitters(view, crowd).unaimed(0, 0) == FilmEmitters::Unaimed::none);
  CHECK(FilmEmitters().of(4, 4).empty());
  CHECK(FilmEmitters().unaimed(4, 4) == FilmEmitters::Unaimed::none);
}

}  // namespace
}  // namespace tyndall
