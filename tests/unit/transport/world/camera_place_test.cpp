/// Cameras exactly on a boundary of media: what their rays go through, by slabs and chords.
#include <doctest/doctest.h>

#include <algorithm>

#include "math/rng.h"
#include "session/world_parts.h"
#include "support/scene_text.h"
#include "support/sphere_scene.h"
#include "transport/media/span.h"

namespace tyndall {
namespace {

using test::block;
using test::homogeneous;

constexpr float kHalf = 1;  // of the box's sides, and the sphere's radius

float within_box(const Ray& ray, Vec3 center) {
  float t0 = 0, t1 = kInfinity;
  for (int k = 0; k < 3; ++k) {
    const float a = (center[k] - kHalf - ray.o[k]) / ray.d[k], b = (center[k] + kHalf - ray.o[k]) / ray.d[k];
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return std::max(t1 - t0, 0.0f);
}

float within_sphere(const Ray& ray, Vec3 center) {
  const Vec3 to_center = center - ray.o;
  const float middle = dot(to_center, ray.d), foot2 = length_squared(to_center) - middle * middle;
  if (foot2 >= kHalf * kHalf) return 0;
  const float half = std::sqrt(kHalf * kHalf - foot2);
  return std::max(middle + half, 0.0f) - std::max(middle - half, 0.0f);
}

struct Boundary {
  const char* name;
  std::string text;  ///< around the origin
  float (*within)(const Ray&, Vec3 center);
};

std::vector<Boundary> boundaries() {
  const Bounds3 box{{-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf}};
  return {
      {"box", test::medium_box("m", "", box), within_box},
      {"box of quads", test::medium_box_of_quads("m", "", box), within_box},
      {"sphere", "MediumInterface \"m\" \"\"\nMaterial \"interface\"\nShape \"sphere\" \"float radius\" 1\n", within_sphere}};
}

/// Rays from all over the film; the part of them that goes as far through the medium as it should.
double right_share(const std::string& camera, const Boundary& boundary, Vec3 center) {
  const World world = test::world_of("Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 64\n" +
                                         homogeneous("m", {.sigma_a = Rgb(1)}) + camera + "WorldBegin\n" +
                                         block("Translate " + test::number(center.x) + " " + test::number(center.y) + " " +
                                               test::number(center.z) + "\n" + boundary.text),
                                     {});
  const BuiltWorld& built = world.parts().built;
  Rng rng(4);
  constexpr int kRays = 4096;
  int right = 0;
  for (int i = 0; i < kRays; ++i) {
    const float x = 64 * rng.uniform(), y = 64 * rng.uniform();
    const Ray ray = built.camera.ray({x, y}, {rng.uniform(), rng.uniform()});
    const Trace trace = built.geometry.trace(ray, 0, kInfinity);
    SpanWalk walk(built.media_context(), built.media_at_start(ray.o), trace.crossings, trace.t_end);
    float found = 0;
    while (const auto part = walk.next()) found += part->t1 - part->t0;
    const Ray given{world.parts().to_user.point(ray.o), ray.d};
    right += std::abs(found * world.parts().unit - boundary.within(given, center)) < 1e-3f && walk.parity_errors() == 0 ? 1 : 0;
  }
  return static_cast<double>(right) / kRays;
}

std::string look_from(Vec3 at, Vec3 to) {
  std::string text = "LookAt";
  for (const Vec3 p : {at, at + to, Vec3{0.3f, 0.2f, 0.1f}})
    for (int k = 0; k < 3; ++k) text += " " + test::number(p[k]);
  return text + "\n";
}

TEST_CASE("a camera on a boundary of a medium sees what is before it") {
  const std::string pinhole = "Camera \"perspective\" \"float fov\" 45\n",
                    film = "Camera \"orthographic\" \"float screenwindow\" [-0.3 0.3 -0.3 0.3]\n",
                    lens = "Camera \"perspective\" \"float fov\" 45 \"float lensradius\" 0.1 \"float focaldistance\" 2\n",
                    around = "Camera \"spherical\"\n";
  for (const Boundary& boundary : boundaries()) {
    for (const Vec3 center : {Vec3{0, 0, 0}, Vec3{0, 0, 1}, Vec3{100, -200, 300}}) {
      for (const std::string& camera : {pinhole, film, lens, around}) {
        for (const Vec3 to : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0, 1, 0}, Vec3{1, 0, 0.5f}}) {
          const std::string place = look_from(center - Vec3{0, 0, kHalf}, to);
          for (const char* medium : {"", "MediumInterface \"\" \"m\"\n"}) {
            CAPTURE(std::string(boundary.name));
            CAPTURE(center.x);
            CAPTURE(camera);
            CAPTURE(place);
            CAPTURE(std::string(medium));
            const bool inward = dot(to, {0, 0, 1}) >= 0;
            if (*medium && !inward && camera != around) continue;  // its fog is all that it sees
            CHECK(right_share(place + medium + camera, boundary, center) > 0.99);
          }
        }
      }
    }
  }
}

TEST_CASE("a film that lies on a boundary beside its middle sees what is before it") {
  for (const Boundary& boundary : boundaries()) {
    if (boundary.within != within_box) continue;
    CHECK(right_share("LookAt 1.2 0 -1  1.2 0 0  0 1 0\nCamera \"orthographic\" \"float screenwindow\" [-0.5 0.5 -0.5 0.5]\n",
                      boundary, {}) > 0.99);
  }
}

}  // namespace
}  // namespace tyndall
