/// Emitters by pixel, against rays.
#include "transport/pixel/film_emitters.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "math/rng.h"
#include "session/world_parts.h"
#include "support/emitter_scene.h"
#include "support/sphere_scene.h"
#include "transport/pixel/directly_visible.h"
#include "transport/pixel/emitter_image.h"

namespace tyndall {
namespace {

using test::emitter;
using test::kOrthographic;
using test::kPerspective;

FilmEmitters search(const World& world, const RenderSettings& settings, const PixelBounds& pixels) {
  ThreadPool pool(1);
  return FilmEmitters({world.parts().built, settings, pixels, pool, [] {}});
}

RenderSettings with_points() {
  RenderSettings settings;
  settings.joint = JointStrategy::points;
  return settings;
}

void require_same(const PixelEmitters& a, const PixelEmitters& b) {
  const auto same = [](const FilmEmitter& x, const FilmEmitter& y) {
    return x.shape == y.shape && x.primitive == y.primitive && x.share == y.share;
  };
  REQUIRE(std::equal(a.emitters.begin(), a.emitters.end(), b.emitters.begin(), b.emitters.end(), same));
  REQUIRE(a.positions == b.positions);
}

TEST_CASE("pixels draw the emitters that end in them, in crops too; none where one fills all") {
  const std::string wall =
      "Translate 0 0 2 AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true\nShape \"disk\" \"float radius\" "
      "9\n";
  const World world = test::world_of(test::emitter_scene(kPerspective) + wall, {});
  const BuiltWorld& built = world.parts().built;
  const FilterCells cells(built.filter);
  const PixelBounds whole{0, 0, 24, 18}, part{5, 3, 12, 18};
  const FilmEmitters all = search(world, with_points(), whole), some = search(world, with_points(), part);
  std::size_t drawing = 0;
  for (int y = 0; y < 18; ++y) {
    for (int x = 0; x < 24; ++x) {
      const PixelEmitters emitters = all.of(x, y);
      if (part.contains(x, y)) require_same(some.of(x, y), emitters);
      // The disk is behind all; with no other emitter in the filter's support a pixel looks even.
      bool others = false;
      for (std::uint32_t shape = 0; shape < 6; ++shape) {
        for (std::uint32_t k = 0; k < primitives_of(*built.geometry.placed()[shape].shape); ++k) {
          const auto image = EmitterImage::of(built, shape, k);
          others |= image && cells.mass(image->on_film().moved({-x - 0.5, -y - 0.5})) > 0;
        }
      }
      if (!others) REQUIRE(emitters.empty());
      drawing += !emitters.empty();
      double shares = 0;
      for (const FilmEmitter& e : emitters.emitters) shares += static_cast<double>(e.share);
      if (!emitters.empty()) REQUIRE(shares == doctest::Approx(1).epsilon(1e-5));
    }
  }
  CHECK(drawing > 40);
}

TEST_CASE("pixels through which a curved outline goes draw several places, straight ones one") {
  const auto places = [](const std::string& shape) {
    const World world = test::world_of(
        "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 18\nPixelFilter \"box\"\n"
        "LookAt 0.1 0.2 -3  0 0 0  0 1 0\n" +
            kPerspective + "\nWorldBegin\n" + emitter("", shape),
        {});
    const FilmEmitters all = search(world, with_points(), {0, 0, 24, 18});
    std::array<int, 2> pixels{};  // that draw one place, several
    for (int y = 0; y < 18; ++y) {
      for (int x = 0; x < 24; ++x) {
        const PixelEmitters emitters = all.of(x, y);
        if (!emitters.empty()) ++pixels[emitters.positions > 1];
      }
    }
    return pixels;
  };
  const auto [round_one, round_several] = places("Shape \"sphere\" \"float radius\" 0.6\n");
  CHECK(round_one == 0);
  CHECK(round_several > 30);
  const auto [straight_one, straight_several] =
      places("Shape \"trianglemesh\" \"point3 P\" [-0.6 -0.5 0  0.6 -0.5 0  0 0.6 0] \"integer indices\" [0 1 2]\n");
  CHECK(straight_one > 30);
  CHECK(straight_several == 0);
}

/// 256 triangles, as wide as the gaps between dark stripes before them: 16 in each of 4 x 4 pixels, half of each hidden.
std::string striped_triangles() {
  std::string points, indices, stripes, corners;
  for (int i = 0; i < 256; ++i) {
    const std::string x = std::to_string(-1 + 0.125 * (i % 16) + 0.01), y = std::to_string(-1 + 0.125 * (i / 16) + 0.01);
    points += x + " " + y + " 0 " + std::to_string(std::stod(x) + 0.1) + " " + y + " 0 " + x + " " +
              std::to_string(std::stod(y) + 0.1) + " 0 ";
    for (int k = 0; k < 3; ++k) indices += std::to_string(3 * i + k) + " ";
  }
  for (int i = 0; i < 37; ++i) {
    const std::string left = std::to_string(-1 + 0.057 * i), right = std::to_string(-1 + 0.057 * i + 0.0285);
    stripes += left + " -1 -1 " + right + " -1 -1 " + right + " 1 -1 " + left + " 1 -1 ";
    for (const int k : {0, 1, 2, 0, 2, 3}) corners += std::to_string(4 * i + k) + " ";
  }
  return "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\nPixelFilter \"box\" \"float xradius\" 0.5 "
         "\"float yradius\" 0.5\nLookAt 0 0 -3  0 0 0  0 1 0\nCamera \"orthographic\"\nWorldBegin\n" +
         emitter("", "Shape \"trianglemesh\" \"point3 P\" [" + points + "] \"integer indices\" [" + indices + "]\n") +
         "Material \"diffuse\" \"rgb reflectance\" [0 0 0]\nShape \"trianglemesh\" \"point3 P\" [" + stripes +
         "] \"integer indices\" [" + corners + "]\n";
}

// Of n_l of an emitter that is seen with the chance v_l the estimate's mean square is sum (L m)^2 v / share, least where shares
// go with L m sqrt(v). By whether the single look met it, 1 or 0.1, it is 3 times that; by Jeffreys's prior 1.1 times.
TEST_CASE("one look at each of many emitters leaves little more to chance than to know what hides them") {
  const World world = test::world_of(striped_triangles(), {});
  const BuiltWorld& built = world.parts().built;
  const FilterCells cells(built.filter);
  const FilmEmitters all = search(world, with_points(), {0, 0, 4, 4});
  Rng rng(7);
  double chosen = 0, best = 0;
  for (int i = 0; i < 16; ++i) {
    const Point2 center{i % 4 + 0.5, i / 4 + 0.5};
    const PixelEmitters emitters = all.of(i % 4, i / 4);
    REQUIRE(emitters.emitters.size() >= 16);
    double roots = 0;
    for (const FilmEmitter& e : emitters.emitters) {
      const ConvexPolygon image = EmitterImage::of(built, e.shape, e.primitive)->on_film().moved({-center.x, -center.y});
      const double mass = cells.mass(image);
      double seen = 0;
      for (int k = 0; k < 200; ++k) {
        const auto place = cells.sample(image, {rng.uniform(), rng.uniform()});
        const auto met = directly_visible(built, built.camera.ray_through({center.x + place.at.x, center.y + place.at.y}));
        seen += met && met->light == e.light(built) ? 1 / 200.0 : 0;
      }
      chosen += mass * mass * seen / static_cast<double>(e.share);
      roots += mass * std::sqrt(seen);
    }
    best += roots * roots;
  }
  MESSAGE("mean square ", chosen / best, " of the least");
  CHECK(chosen < 1.2 * best);
}

/// 100 emitters, the first five brightest, that a lens blurs over all of the frame.
std::string blurred_bulbs() {
  std::string bulbs;
  for (int i = 0; i < 100; ++i) {
    const std::string x = std::to_string(-0.2 + 0.04 * (i % 10)), y = std::to_string(-0.2 + 0.04 * (i / 10));
    bulbs += "AttributeBegin\nTranslate " + x + " " + y + " 0\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"float scale\" " +
             std::to_string(i < 5 ? 9 : 1) + "\nShape \"sphere\" \"float radius\" 0.01\nAttributeEnd\n";
  }
  return test::before_camera(kPerspective + " \"float lensradius\" 1 \"float focaldistance\" 1", bulbs);
}

TEST_CASE("of many emitters that a lens blurs the brightest are listed, as many as there is room for, in crops the same") {
  const World world = test::world_of(blurred_bulbs(), {});
  const PixelBounds whole{0, 0, 24, 18}, part{5, 3, 12, 10};
  const FilmEmitters all = search(world, with_points(), whole), some = search(world, with_points(), part);
  std::size_t listed = 0;
  for (int y = 0; y < 18; ++y) {
    for (int x = 0; x < 24; ++x) {
      const PixelEmitters of_pixel = all.of(x, y);
      const auto emitters = of_pixel.emitters;
      listed += emitters.size();
      for (std::uint32_t shape = 0; shape < 5; ++shape) {
        CHECK(std::any_of(emitters.begin(), emitters.end(), [&](const FilmEmitter& e) { return e.shape == shape; }));
      }
      if (part.contains(x, y)) require_same(some.of(x, y), of_pixel);
    }
  }
  CHECK(listed > 6 * 24 * 18);
  CHECK(listed <= static_cast<std::size_t>(FilmEmitters::kMostBlurred) * 24 * 18);
}

TEST_CASE("a bulb out of focus has few places in a pixel, one in focus many") {
  const auto most_places = [](const std::string& focus) {
    const World world =
        test::world_of(test::before_camera(kPerspective + " \"float lensradius\" 0.1 \"float focaldistance\" " + focus,
                                           emitter("", "Shape \"sphere\" \"float radius\" 0.15\n")),
                       {});
    const FilmEmitters all = search(world, with_points(), {0, 0, 24, 18});
    int most = 0;
    for (int i = 0; i < 24 * 18; ++i)
      most = std::max(most, all.of(i % 24, i / 24).empty() ? 0 : all.of(i % 24, i / 24).positions);
    return most;
  };
  CHECK(most_places("3") == 13);
  CHECK(most_places("1") == 5);
}

TEST_CASE("emitters are drawn with their shares") {
  const std::vector<FilmEmitter> list{{0, 0, 0.6f}, {1, 0, 0.2f}, {1, 1, 0.1f}, {2, 0, 0.1f}};
  const PixelEmitters emitters{list, 1};
  std::array<int, 4> drawn{};
  std::array<double, 4> left{};
  constexpr int kDraws = 10'000;
  for (int i = 0; i < kDraws; ++i) {
    float u = (static_cast<float>(i) + 0.5f) / kDraws;
    const auto k = static_cast<std::size_t>(&emitters.draw(u) - list.data());
    REQUIRE((u >= 0 && u < 1));
    ++drawn[k];
    left[k] += static_cast<double>(u);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(drawn[k] == doctest::Approx(kDraws * static_cast<double>(list[k].share)).epsilon(2e-3));
    CHECK(left[k] / drawn[k] == doctest::Approx(0.5).epsilon(0.01));
  }
  float last = 0x1.fffffep-1f;
  CHECK(&emitters.draw(last) == &list[3]);
}

TEST_CASE("no emitters are drawn by wide filters, and where camera, settings or the film forbid it") {
  const auto draws_any = [](const std::string& text, const RenderSettings& settings) {
    const World world = test::world_of(text, {});
    const FilmEmitters all = search(world, settings, {0, 0, 24, 18});
    for (int y = 0; y < 18; ++y) {
      for (int x = 0; x < 24; ++x) {
        if (!all.of(x, y).empty()) return true;
      }
    }
    return false;
  };
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string plain = test::emitter_scene(kPerspective);
  RenderSettings off = with_points(), exhaustive = with_points();
  off.joint = JointStrategy::off;
  exhaustive.lights = LightStrategy::exhaustive;
  CHECK(draws_any(plain, with_points()));
  CHECK(draws_any(test::emitter_scene(kOrthographic), with_points()));
  CHECK_FALSE(draws_any(plain, off));
  CHECK(draws_any(test::emitter_scene(kPerspective + " \"float lensradius\" 0.1 \"float focaldistance\" 3"), with_points()));
  CHECK(draws_any(test::emitter_scene(kOrthographic + " \"float lensradius\" 0.1 \"float focaldistance\" 3"), with_points()));
  CHECK_FALSE(
      draws_any(replaced(plain, "\"gaussian\"", "\"gaussian\" \"float xradius\" 5 \"float yradius\" 5"), with_points()));
  CHECK_FALSE(draws_any(replaced(plain, "\"rgb\"", "\"rgb\" \"float maxcomponentvalue\" 9"), with_points()));
  CHECK_FALSE(draws_any(replaced(plain, kPerspective, "Camera \"spherical\""), with_points()));
}

}  // namespace
}  // namespace tyndall
