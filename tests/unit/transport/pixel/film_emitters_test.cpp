/// Emitters by pixel, against rays.
#include "transport/pixel/film_emitters.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "math/rng.h"
#include "session/world_parts.h"
#include "support/sphere_scene.h"
#include "transport/pixel/directly_visible.h"

namespace tyndall {
namespace {

std::string emitter(const std::string& where, const std::string& shape) {
  return "AttributeBegin\n" + where + "\nAreaLightSource \"diffuse\" \"rgb L\" [3 2 1] \"bool twosided\" true\n" + shape +
         "AttributeEnd\n";
}

/// One of each shape, whole and cut, some beyond the frame, one behind the camera.
std::string emitters() {
  return emitter("Translate -0.6 0.3 0", "Shape \"sphere\" \"float radius\" 0.2\n") +
         emitter("Translate 0.5 0.4 0 Scale 1 0.5 1", "Shape \"sphere\" \"float radius\" 0.3 \"float zmax\" 0.1\n") +
         emitter("Translate 0.1 -0.6 0 Rotate 40 1 1 0", "Shape \"disk\" \"float radius\" 0.3\n") +
         emitter("Translate 0.9 -0.4 0 Rotate 70 1 0.3 0", "Shape \"cylinder\" \"float radius\" 0.1\n") +
         emitter("Translate -0.9 -0.5 0", "Shape \"bilinearmesh\" \"point3 P\" [0 0 0  0.4 0 0.1  0 0.3 0.2  0.35 0.4 0]\n") +
         emitter("Translate -0.3 -0.1 0",
                 "Shape \"trianglemesh\" \"point3 P\" [0 0 0  0.3 0 0.1  0 0.2 0  0.4 0.3 0] "
                 "\"integer indices\" [0 2 1 1 2 3]\n") +
         emitter("Translate 0 0 -9", "Shape \"sphere\" \"float radius\" 0.2\n");
}

std::string scene(const std::string& camera) {
  return "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 18\nPixelFilter \"gaussian\"\n"
         "LookAt 0.1 0.2 -3  0 0 0  0 1 0\n" +
         camera + "\nWorldBegin\n" + emitters();
}

bool holds(const ConvexPolygon& polygon, Point2 p) { return polygon.covers({p, p}); }

const std::string kPerspective = "Camera \"perspective\" \"float fov\" 34";
const std::string kOrthographic = "Camera \"orthographic\" \"float screenwindow\" [-1.2 1.2 -0.9 0.9]";

TEST_CASE("what a ray meets of an emitter is in its image, and most of the image is of the emitter") {
  for (const std::string& camera : {kPerspective, kOrthographic}) {
    const World world = test::world_of(scene(camera), {});
    const BuiltWorld& built = world.parts().built;
    Rng rng(5);
    // Met, and within the image, by shape. The polygon around a round one is 2 to 5 % larger; what is cut is held whole.
    std::array<double, 7> met{}, in_image{}, least{0.95, 0.4, 0.93, 0.75, 0.5, 0.98, 0};
    for (int i = 0; i < 40'000; ++i) {
      const Point2 film{24.0 * rng.uniform(), 18.0 * rng.uniform()};
      const auto seen = directly_visible(built, built.camera.ray_through(film));
      for (std::uint32_t shape = 0; shape < built.first_light.size(); ++shape) {
        for (std::uint32_t k = 0; k < primitives_of(*built.geometry.placed()[shape].shape); ++k) {
          const auto image = image_of(built, shape, k);
          if (shape == 6 && camera == kPerspective) REQUIRE_FALSE(image);  // behind the camera
          if (!image) continue;
          const bool meets = seen && seen->light == built.first_light[shape] + k, holds_it = holds(*image, film);
          if (meets) REQUIRE(holds_it);
          met[shape] += meets;
          in_image[shape] += holds_it;
        }
      }
    }
    for (std::size_t shape = 0; shape < 6; ++shape) {
      CAPTURE(shape);
      CHECK(in_image[shape] > 300);
      CHECK(met[shape] >= least[shape] * in_image[shape]);
    }
  }
}

TEST_CASE("a ray goes through the film where the camera sees its points") {
  for (const std::string& camera : {kPerspective, kOrthographic}) {
    const World world = test::world_of(scene(camera), {});
    const CameraRays& rays = world.parts().built.camera;
    Rng rng(6);
    for (int i = 0; i < 1000; ++i) {
      const Point2 film{24.0 * rng.uniform(), 18.0 * rng.uniform()};
      const Ray ray = rays.ray_through(film);
      const auto at = rays.image_of(Vec3d(ray.o) + Vec3d(ray.d) * (0.1 + rng.uniform()));
      REQUIRE(at);
      CHECK(at->x == doctest::Approx(film.x).epsilon(1e-5));
      CHECK(at->y == doctest::Approx(film.y).epsilon(1e-5));
      const Ray plain = rays.ray({static_cast<float>(film.x), static_cast<float>(film.y)}, {0.5f, 0.5f});
      CHECK(length(plain.d - ray.d) < 1e-6);
      CHECK(length(plain.o - ray.o) < 1e-6);
    }
  }
}

FilmEmitters search(const World& world, const RenderSettings& settings, const PixelBounds& pixels) {
  ThreadPool pool(1);
  return FilmEmitters({world.parts().built, settings, pixels, pool, [] {}});
}

RenderSettings with_points() {
  RenderSettings settings;
  settings.joint = JointStrategy::points;
  return settings;
}

TEST_CASE("pixels draw the emitters that end in them, in crops too; none where one fills all") {
  const std::string wall =
      "Translate 0 0 2 AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" true\nShape \"disk\" \"float radius\" "
      "9\n";
  const World world = test::world_of(scene(kPerspective) + wall, {});
  const BuiltWorld& built = world.parts().built;
  const FilterCells cells(built.filter);
  const PixelBounds whole{0, 0, 24, 18}, part{5, 3, 12, 18};
  const FilmEmitters all = search(world, with_points(), whole), some = search(world, with_points(), part);
  std::size_t drawing = 0;
  for (int y = 0; y < 18; ++y) {
    for (int x = 0; x < 24; ++x) {
      const PixelEmitters emitters = all.of(x, y);
      if (part.contains(x, y)) REQUIRE(some.of(x, y).emitters.size() == emitters.emitters.size());
      // The disk is behind all; with no other emitter in the filter's support a pixel looks even.
      bool others = false;
      for (std::uint32_t shape = 0; shape < 6; ++shape) {
        for (std::uint32_t k = 0; k < primitives_of(*built.geometry.placed()[shape].shape); ++k) {
          const auto image = image_of(built, shape, k);
          others |= image && cells.mass(image->moved({-x - 0.5, -y - 0.5})) > 0;
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
      const ConvexPolygon image = image_of(built, e.shape, e.primitive)->moved({-center.x, -center.y});
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

TEST_CASE("no emitters are drawn through a lens, by wide filters, and where settings or the film forbid it") {
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
  const std::string plain = scene(kPerspective);
  RenderSettings off = with_points(), exhaustive = with_points();
  off.joint = JointStrategy::off;
  exhaustive.lights = LightStrategy::exhaustive;
  CHECK(draws_any(plain, with_points()));
  CHECK(draws_any(scene(kOrthographic), with_points()));
  CHECK_FALSE(draws_any(plain, off));
  CHECK_FALSE(draws_any(scene(kPerspective + " \"float lensradius\" 0.1 \"float focaldistance\" 3"), with_points()));
  CHECK_FALSE(
      draws_any(replaced(plain, "\"gaussian\"", "\"gaussian\" \"float xradius\" 5 \"float yradius\" 5"), with_points()));
  CHECK_FALSE(draws_any(replaced(plain, "\"rgb\"", "\"rgb\" \"float maxcomponentvalue\" 9"), with_points()));
  CHECK_FALSE(draws_any(replaced(plain, kPerspective, "Camera \"spherical\""), with_points()));
}

}  // namespace
}  // namespace tyndall
