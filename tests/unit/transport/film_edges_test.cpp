/// Edges of emitters on the film, by brute force.
#include "transport/film_edges.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/rng.h"

namespace tyndall {
namespace {

/// Most of it dark, with emitters whose brightness differs a little and much.
std::vector<float> random_brightness(const PixelBounds& pixels, Rng& rng) {
  std::vector<float> brightness(pixels.size());
  for (float& b : brightness) {
    const float u = rng.uniform();
    b = u < 0.96f ? 0.0f : u < 0.98f ? 3.0f : u < 0.99f ? 3.1f : 9.0f;
  }
  return brightness;
}

TEST_CASE(
    "a pixel is an edge where centers within its filter's reach see more than a tenth more light than others, in crops too") {
  Rng rng(11);
  for (const Vec2 radius : {Vec2{0.5f, 0.5f}, Vec2{1.5f, 1.5f}, Vec2{2, 0.75f}}) {
    const FilmEdges::View whole{{0, 0, 40, 30}, radius};
    const PixelBounds all = whole.around();
    const auto brightness = random_brightness(all, rng);
    const int rx = static_cast<int>(std::ceil(radius.x)), ry = static_cast<int>(std::ceil(radius.y));
    int edges = 0;
    const FilmEdges found(whole, brightness);
    const FilmEdges::View crop{{5, 3, 9, 30}, radius};
    std::vector<float> part;
    for (int y = crop.around().y0; y < crop.around().y1; ++y)
      for (int x = crop.around().x0; x < crop.around().x1; ++x) part.push_back(brightness[all.index(x, y)]);
    const FilmEdges of_crop(crop, part);
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) {
        bool expected = false;
        for (int j = -ry; j <= ry; ++j) {
          for (int i = -rx; i <= rx; ++i)
            for (int k = -rx; k <= rx; ++k)
              for (int l = -ry; l <= ry; ++l)
                expected = expected || brightness[all.index(x + i, y + j)] < 0.9f * brightness[all.index(x + k, y + l)];
        }
        edges += expected;
        REQUIRE(found.at(x, y) == expected);
        if (x >= 5 && x < 9 && y >= 3) REQUIRE(of_crop.at(x, y) == expected);
      }
    }
    CHECK(edges > 200);
    CHECK(edges < 1100);
  }
}

TEST_CASE("where nothing emits, or all emits alike, there are no edges") {
  const FilmEdges::View view{{0, 0, 6, 5}, {1.5f, 1.5f}};
  for (const float everywhere : {0.0f, 7.0f}) {
    const FilmEdges none(view, std::vector<float>(view.around().size(), everywhere));
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 6; ++x) CHECK_FALSE(none.at(x, y));
  }
  CHECK_FALSE(FilmEdges().at(3, 2));
}

TEST_CASE("pixels can be edges besides those that centers tell of") {
  CHECK(Contrast{0, 2}.is_edge());
  CHECK(Contrast{1.7f, 2}.is_edge());
  CHECK_FALSE(Contrast{1.9f, 2}.is_edge());
  CHECK_FALSE(Contrast{0, 0}.is_edge());
  const FilmEdges::View view{{2, 1, 5, 3}, {0.5f, 0.5f}};
  std::vector<float> brightness(view.around().size());
  brightness[view.around().index(2, 1)] = 1;
  for (const bool with_centers : {false, true}) {
    FilmEdges edges = with_centers ? FilmEdges(view, brightness) : FilmEdges();
    edges.add(view, {0, 0, 0, 0, 0, 1});
    CHECK(edges.at(4, 2));
    CHECK_FALSE(edges.at(4, 1));
    CHECK(edges.at(2, 1) == with_centers);
  }
}

}  // namespace
}  // namespace tyndall
