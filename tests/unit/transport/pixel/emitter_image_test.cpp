/// Images of emitters, against rays.
#include "transport/pixel/emitter_image.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>

#include "math/rng.h"
#include "math/warp.h"
#include "session/world_parts.h"
#include "support/chi_squared.h"
#include "support/emitter_scene.h"
#include "support/sphere_scene.h"
#include "transport/pixel/directly_visible.h"

namespace tyndall {
namespace {

using test::kOrthographic;
using test::kPerspective;

/// Most emitters are between 2 and 3.5 from the camera, and what is in focus among them.
const std::string kLens = " \"float lensradius\" 0.1 \"float focaldistance\" ";

/// Rays by emitter: those that meet it, that its image holds, and that do both.
struct Rays {
  std::array<double, 7> met{}, held{}, both{};
};
Rays follow(const BuiltWorld& built, int count) {
  Rng rng(5);
  Rays rays;
  for (int i = 0; i < count; ++i) {
    const Point2 film{24.0 * rng.uniform(), 18.0 * rng.uniform()};
    const Vec2 u{rng.uniform(), rng.uniform()}, lens = square_to_concentric_disk(u);
    const auto seen = directly_visible(built, built.camera.ray_through(film, {lens.x, lens.y}));
    for (std::uint32_t shape = 0; shape < built.first_light.size(); ++shape) {
      for (std::uint32_t k = 0; k < primitives_of(*built.geometry.placed()[shape].shape); ++k) {
        const auto image = EmitterImage::of(built, shape, k);
        if (!image) continue;
        const bool meets = seen && seen->light == built.first_light[shape] + k, holds = image->holds(film, {lens.x, lens.y});
        rays.met[shape] += meets;
        rays.held[shape] += holds;
        rays.both[shape] += meets && holds;
      }
    }
  }
  return rays;
}

TEST_CASE("what a ray meets of an emitter is in its image, and most of the image is of the emitter") {
  for (const std::string& camera : {kPerspective, kOrthographic}) {
    const World world = test::world_of(test::emitter_scene(camera), {});
    const BuiltWorld& built = world.parts().built;
    if (camera == kPerspective) REQUIRE_FALSE(EmitterImage::of(built, 6, 0));  // behind the camera
    // The polygon around a round one is 2 to 5 % larger; what is cut is held whole.
    constexpr std::array<double, 6> kLeast{0.95, 0.4, 0.93, 0.75, 0.5, 0.98};
    const Rays rays = follow(built, 40'000);
    for (std::size_t shape = 0; shape < kLeast.size(); ++shape) {
      CAPTURE(shape);
      CHECK(rays.held[shape] > 300);
      CHECK(rays.both[shape] == rays.met[shape]);
      CHECK(rays.met[shape] >= kLeast[shape] * rays.held[shape]);
    }
  }
}

// In focus are planes before and behind them all, and one that goes through four of the six: of these the cylinder alone, which
// no part of the lens may be told for, is held by nearly all of it.
TEST_CASE("through a lens emitters' images hold what rays meet of them, and little else") {
  for (const std::string& camera : {kPerspective, kOrthographic}) {
    for (const std::string focus : {"1.5", "3", "6"}) {
      CAPTURE(camera);
      CAPTURE(focus);
      const World world = test::world_of(test::emitter_scene(camera + kLens + focus), {});
      constexpr std::array<double, 6> kLeast{0.9, 0.35, 0.85, 0.3, 0.45, 0.9}, kLeastInFocus{0.75, 0.3, 0.6, 0.2, 0.3, 0.5};
      const Rays rays = follow(world.parts().built, 20'000);
      for (std::size_t shape = 0; shape < kLeast.size(); ++shape) {
        CAPTURE(shape);
        CHECK(rays.held[shape] > 150);
        CHECK(rays.both[shape] >= 0.999 * rays.met[shape]);  // what is not held the filter finds
        CHECK(rays.met[shape] >= (focus == "3" ? kLeastInFocus : kLeast)[shape] * rays.held[shape]);
      }
    }
  }
}

TEST_CASE("a ray goes through film and lens where the camera sees its points") {
  for (const std::string& camera : {kPerspective, kOrthographic, kPerspective + kLens + "3", kOrthographic + kLens + "2"}) {
    CAPTURE(camera);
    const World world = test::world_of(test::emitter_scene(camera), {});
    const CameraRays& rays = world.parts().built.camera;
    Rng rng(6);
    for (int i = 0; i < 1000; ++i) {
      const Point2 film{24.0 * rng.uniform(), 18.0 * rng.uniform()};
      const Vec2 u{rng.uniform(), rng.uniform()}, lens = square_to_concentric_disk(u);
      const Ray ray = rays.ray_through(film, {lens.x, lens.y});
      const auto image = rays.blurred_image_of(Vec3d(ray.o) + Vec3d(ray.d) * (0.5 + rng.uniform()));
      REQUIRE(image);
      CHECK(image->at.x + image->by.x * double{lens.x} == doctest::Approx(film.x).epsilon(1e-5));
      CHECK(image->at.y + image->by.y * double{lens.y} == doctest::Approx(film.y).epsilon(1e-5));
      const Ray plain = rays.ray({static_cast<float>(film.x), static_cast<float>(film.y)}, u);
      CHECK(length(plain.d - ray.d) < 1e-6);
      CHECK(length(plain.o - ray.o) < 1e-6);
      if (rays.is_sharp()) continue;
      const Vec3d to_focus = rays.focus_of(film) - Vec3d(ray.o);
      CHECK(length(to_focus - Vec3d(ray.d) * dot(to_focus, Vec3d(ray.d))) < 1e-5);
    }
  }
}

TEST_CASE("places on a part of the lens are uniform in it, and its share is how much of the lens it is") {
  const auto corner = [](double angle, double radius) {
    return Point2{radius * std::cos(angle) + 0.4, radius * std::sin(angle)};
  };
  for (const double radius : {0.3, 0.9, 5.0}) {
    CAPTURE(radius);
    const std::array<Point2, 5> corners{corner(0.1, radius), corner(1.3, radius), corner(2.8, radius), corner(4, radius),
                                        corner(5.2, radius)};
    const LensPart part(ConvexPolygon::hull(corners));
    constexpr int kSide = 10, kDraws = 100'000, kGrid = 1000;
    std::vector<double> counts(kSide * kSide + 1), pmf(kSide * kSide + 1);  // the last: not on the lens
    const auto cell = [](Point2 p) {
      return static_cast<std::size_t>((p.y + 1) / 2 * kSide) * kSide + static_cast<std::size_t>((p.x + 1) / 2 * kSide);
    };
    const auto on_lens = [](Point2 p) { return p.x * p.x + p.y * p.y <= 1; };
    double sum = 0;
    for (int i = 0; i < kGrid * kGrid; ++i) {
      const Point2 p{2 * (i % kGrid + 0.5) / kGrid - 1, 2 * (i / kGrid + 0.5) / kGrid - 1};
      const double of_part = on_lens(p) && part.holds(p) ? 4.0 / kGrid / kGrid / (kPi * part.share()) : 0;
      pmf[cell(p)] += of_part;
      sum += of_part;
    }
    CHECK(sum > 0.97);  // the polygon about the lens is 1.024 times as large
    CHECK(sum < 1.001);
    pmf.back() = std::max(1 - sum, 0.0);
    Rng rng(9);
    for (int i = 0; i < kDraws; ++i) {
      const Vec2 u{rng.uniform(), rng.uniform()};
      const auto p = part.sample(u);
      if (p) REQUIRE(on_lens(*p));
      ++counts[p ? cell(*p) : kSide * kSide];
    }
    CHECK(test::count_p_value(counts, pmf, kDraws) > 1e-3);
  }
  CHECK(LensPart().share() == 1);
  CHECK_FALSE(LensPart(ConvexPolygon()).sample({0.5f, 0.5f}));
}

}  // namespace
}  // namespace tyndall
