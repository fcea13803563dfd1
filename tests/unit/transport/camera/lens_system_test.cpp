#include "transport/camera/lens_system.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/rng.h"
#include "transport/camera/camera_ray.h"

using namespace tyndall;

namespace {

/// A double convex lens with the stop on its film side. 1/f = (n - 1) (2/R - (n - 1) d / (n R^2)).
constexpr double kFocalLength = 1 / (0.5 * (2 / 0.05 - 0.5 * 0.0025 / (1.5 * 0.05 * 0.05)));
Lenses simple_lens(float stop_radius = 0.002f) {
  Lenses lenses;
  lenses.elements = {{0.05f, 0.0025f, 1.5f, 0.01f}, {-0.05f, 1e-5f, 1, 0.01f}, {0, 0.05f, 0, stop_radius}};
  lenses.focus_distance = 1;
  lenses.film_diagonal = 0.02f;
  return lenses;
}

Lenses triplet() {
  Lenses lenses;
  lenses.elements = {{0.02125f, 0.0032f, 1.62f, 0.009f}, {-0.15865f, 0.006f, 1, 0.009f}, {-0.02025f, 0.001f, 1.62f, 0.007f},
                     {0.0193f, 0.0045f, 1, 0.006f},      {0, 0.0015f, 0, 0.0055f},       {0.14125f, 0.0029f, 1.62f, 0.007f},
                     {-0.01728f, 0.042f, 1, 0.0075f}};
  lenses.focus_distance = 2;
  lenses.film_diagonal = 0.043f;
  return lenses;
}

}  // namespace

TEST_CASE("a film point is seen sharp at the distance of focus, upside down and as large as 1/s + 1/s' = 1/f says") {
  const Lenses lenses = simple_lens();
  const LensSystem system(lenses);
  // s + s' = 1, s s' = f: s' = (1 - sqrt(1 - 4 f)) / 2.
  const double image = (1 - std::sqrt(1 - 4 * kFocalLength)) / 2;
  CHECK(system.image_distance() == doctest::Approx(image).epsilon(2e-3));
  Rng rng(1);
  for (const Vec2 film : {Vec2{0, 0}, Vec2{0.003f, -0.002f}}) {
    for (int i = 0; i < 200; ++i) {
      const auto sample = system.sample(film, {rng.uniform(), rng.uniform()});
      if (!sample) continue;
      const double t = (lenses.focus_distance - sample->ray.o.z) / sample->ray.d.z;
      const Vec3d p = sample->ray.o + sample->ray.d * t;
      const double magnified = -(lenses.focus_distance - image) / image;
      CHECK(p.x == doctest::Approx(magnified * film.x).epsilon(0.02).scale(0.05));
      CHECK(p.y == doctest::Approx(magnified * film.y).epsilon(0.02).scale(0.05));
    }
  }
}

TEST_CASE("under even light the film's middle gets pi sin^2 of what the stop spans") {
  for (const float radius : {0.001f, 0.004f}) {
    const LensSystem system(simple_lens(radius));
    double sum = 0;
    constexpr int kSide = 512;
    for (int i = 0; i < kSide * kSide; ++i) {
      const auto sample = system.sample({0, 0}, {(i % kSide + 0.5f) / kSide, (i / kSide + 0.5f) / kSide});
      if (sample) sum += sample->weight;
    }
    // The stop is the last surface. Integral of cos^4 / z^2 over a disc: pi a^2 / (a^2 + z^2).
    const double z = system.rear_z(), a = radius;
    CHECK(sum / (kSide * kSide) == doctest::Approx(kPi * a * a / (a * a + z * z)).epsilon(0.002));
  }
}

TEST_CASE("all light that comes through passes the pupil's bounds, wherever it falls on the film") {
  for (const Lenses& lenses : {simple_lens(), triplet()}) {
    const LensSystem system(lenses);
    const double rear = lenses.elements.back().aperture_radius;
    Rng rng(2);
    for (const double r : {0.0, 0.3, 0.6, 0.9}) {
      const Vec2 film{static_cast<float>(r * 0.6 * lenses.film_diagonal / 2),
                      static_cast<float>(r * 0.8 * lenses.film_diagonal / 2)};
      constexpr int kRays = 400'000;
      double within = 0, around = 0;  // integrals over the pupil's bounds and over all of the plane
      for (int i = 0; i < kRays; ++i) {
        const auto sample = system.sample(film, {rng.uniform(), rng.uniform()});
        if (sample) within += sample->weight;
        const Vec3d at{rear * (2 * rng.uniform_wide() - 1), rear * (2 * rng.uniform_wide() - 1), system.rear_z()};
        const Vec3d d = normalize(at - Vec3d{film.x, film.y, 0});
        if (const auto all = system.to_scene({{film.x, film.y, 0}, d}))
          around += all->weight * std::pow(d.z, 4) * 4 * rear * rear / (system.rear_z() * system.rear_z());
      }
      CAPTURE(r);
      CHECK(within / kRays == doctest::Approx(around / kRays).epsilon(0.02));
    }
  }
}

TEST_CASE("each shape of the stop is as bright as the circle") {
  using Stop = Lenses::Stop;
  for (const Stop stop : {Stop::circle, Stop::gaussian, Stop::square, Stop::pentagon, Stop::star}) {
    constexpr int kSide = 800;
    double sum = 0, squares = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const double t = stop_transmission(stop, 2 * (i % kSide + 0.5) / kSide - 1, 2 * (i / kSide + 0.5) / kSide - 1);
      sum += t;
      squares += t * t;
    }
    CHECK(sum / (kSide * kSide) == doctest::Approx(kPi / 4).epsilon(0.003));
    if (stop != Stop::circle) CHECK(squares > 1.2 * sum);  // and narrower
  }
}

TEST_CASE("lenses that make no picture are refused") {
  Lenses lenses = simple_lens();
  lenses.focus_distance = 0.15f;
  CHECK_THROWS_WITH_AS(LensSystem{lenses}, doctest::Contains("focusdistance is too short"), Error);
  lenses = simple_lens();
  std::swap(lenses.elements[0].radius, lenses.elements[1].radius);
  CHECK_THROWS_WITH_AS(LensSystem{lenses}, doctest::Contains("spread light"), Error);
  lenses = simple_lens();
  lenses.elements[2].thickness = 0;
  lenses.elements[1].thickness = 0.2f;
  CHECK_THROWS_AS(LensSystem{lenses}, Error);
  lenses = simple_lens(0);
  CHECK_THROWS_WITH_AS(LensSystem{lenses}, doctest::Contains("lets nothing pass"), Error);
  lenses = simple_lens();
  lenses.film_diagonal = 0;
  CHECK_THROWS_WITH_AS(LensSystem{lenses}, doctest::Contains("must be above 0"), Error);
  lenses.elements.clear();
  CHECK_THROWS_WITH_AS(LensSystem{lenses}, doctest::Contains("no lenses"), Error);
}

TEST_CASE("focused at infinity the film stands in the focal plane") {
  Lenses lenses = simple_lens();
  lenses.focus_distance = 1e30f;
  CHECK(LensSystem(lenses).image_distance() == doctest::Approx(kFocalLength).epsilon(1e-3));
}

TEST_CASE("any table of lenses is refused or gives finite rays") {
  Rng rng(3);
  int focused = 0;
  for (int i = 0; i < 60; ++i) {
    Lenses lenses;
    const auto between = [&](float a, float b) { return a + (b - a) * rng.uniform(); };
    const int count = 1 + static_cast<int>(rng.next() % 5);
    for (int k = 0; k < count; ++k) {
      const float sign = rng.uniform() < 0.5f ? -1.0f : 1.0f;
      const float radius = rng.uniform() < 0.2f ? 0.0f : sign * std::pow(10.0f, between(-3, 2));
      lenses.elements.push_back(
          {radius, between(0, 0.05f), rng.uniform() < 0.3f ? 0.0f : between(1, 3), std::pow(10.0f, between(-5, 0))});
    }
    lenses.focus_distance = std::pow(10.0f, between(-2, 4));
    try {
      const LensSystem system(lenses);
      ++focused;
      for (int k = 0; k < 100; ++k) {
        const auto sample = system.sample({between(-0.02f, 0.02f), between(-0.02f, 0.02f)}, {rng.uniform(), rng.uniform()});
        if (!sample) continue;
        REQUIRE(std::isfinite(sample->weight));
        REQUIRE(sample->weight >= 0);
        REQUIRE(length(sample->ray.d) == doctest::Approx(1));
        REQUIRE(std::isfinite(length(sample->ray.o)));
      }
    } catch (const Error&) {
    }
  }
  CHECK(focused > 3);
}

TEST_CASE("a realistic camera sees as a perspective one of its focal length, and is none for techniques that need a pinhole") {
  Film film;
  film.width = 60;
  film.height = 40;
  Camera camera;
  camera.kind = Camera::Kind::realistic;
  camera.lenses = simple_lens(0.0005f);
  camera.to_world = Transform::translate(1, 2, 3);
  const CameraRays rays(camera, film);
  CHECK(rays.is_realistic());
  CHECK_FALSE(rays.is_pinhole());
  CHECK_FALSE(rays.has_projection());
  const auto seen = rays.sample({0, 0}, {0.5f, 0.5f});  // the picture's upper left
  REQUIRE(seen);
  CHECK(seen->weight > 0);
  const double half_width = 0.01 * 60 / std::hypot(60, 40), image = (1 - std::sqrt(1 - 4 * kFocalLength)) / 2;
  CHECK(seen->ray.d.x / seen->ray.d.z == doctest::Approx(-half_width / image).epsilon(0.02));
  CHECK(seen->ray.d.y / seen->ray.d.z == doctest::Approx(half_width * 2 / 3 / image).epsilon(0.02));
  // Footprints go by the same slope.
  const auto [dx, dy] = rays.pixel_steps(rays.center() + Vec3{0, 0, 10}, {0, 0, -1});
  CHECK(dx.x == doctest::Approx(10 * 2 * half_width / 60 / image).epsilon(0.01));
  CHECK(dy.y == doctest::Approx(-10 * 2 * half_width / 60 / image).epsilon(0.01));
}
