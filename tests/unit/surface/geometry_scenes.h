/// Scenes, rays and oracles for the tests of Geometry.
#pragma once

#include <vector>

#include "math/rng.h"
#include "math/vec3d.h"
#include "surface/geometry.h"

namespace tyndall::test {

inline constexpr MaterialId kSolid = 0, kInterface = 1;

/// A scene with the two materials and one medium; shapes are added with `add`.
inline Scene empty_scene() {
  Scene scene;
  scene.textures.push_back({ConstantTexture{Rgb(0.5f)}, {}});
  scene.materials.push_back({DiffuseMaterial{0}, "solid", {}});
  scene.materials.push_back({InterfaceMaterial{}, "interface", {}});
  scene.media.push_back({HomogeneousMedium{}, {}, {}, "fog", {}});
  scene.boundaries.push_back({MediumId{0}, std::nullopt});
  return scene;
}

template <typename Kind>
Shape make_shape(Kind kind, const Transform& to_world = {}, MaterialId material = kSolid) {
  Shape shape;
  shape.kind = std::move(kind);
  shape.to_world = to_world;
  shape.material = material;
  shape.where = {"test.pbrt", 7, 1};
  if (material == kInterface) shape.boundary = 0;
  return shape;
}

/// The box [-1, 1]^3 as twelve triangles, wound so that normals point outside.
/// From -1 to 1, facing z.
inline TriangleMesh square_mesh() {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

inline TriangleMesh box_mesh() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back({i & 1 ? 1.f : -1.f, i & 2 ? 1.f : -1.f, i & 4 ? 1.f : -1.f});
  mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return mesh;
}

/// The same box as six planar patches, dpdu x dpdv outside.
inline BilinearMesh box_patches() {
  BilinearMesh mesh;
  mesh.positions = box_mesh().positions;
  mesh.indices = {0, 2, 1, 3, 4, 5, 6, 7, 0, 1, 4, 5, 2, 6, 3, 7, 0, 4, 2, 6, 1, 3, 5, 7};
  return mesh;
}

/// A closed ball of n x 2n quads as triangles, with a bumpy radius: many silhouettes, thin triangles at the poles.
inline TriangleMesh bumpy_ball(int n) {
  TriangleMesh mesh;
  for (int i = 1; i < n; ++i) {
    for (int j = 0; j < 2 * n; ++j) {
      const float theta = kPi * static_cast<float>(i) / static_cast<float>(n),
                  phi = kPi * static_cast<float>(j) / static_cast<float>(n);
      const float r = 1 + 0.3f * std::sin(5 * theta) * std::cos(4 * phi);
      mesh.positions.push_back({r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta)});
    }
  }
  const auto rings = static_cast<std::uint32_t>(n - 1), columns = static_cast<std::uint32_t>(2 * n);
  const auto top = static_cast<std::uint32_t>(mesh.positions.size()), bottom = top + 1;
  mesh.positions.push_back({0, 0, 1});
  mesh.positions.push_back({0, 0, -1});
  const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
  };
  for (std::uint32_t j = 0; j < columns; ++j) {
    const std::uint32_t next = (j + 1) % columns;
    face(top, j, next);
    for (std::uint32_t i = 0; i + 1 < rings; ++i) {
      face(i * columns + j, (i + 1) * columns + j, (i + 1) * columns + next);
      face(i * columns + j, (i + 1) * columns + next, i * columns + next);
    }
    face(bottom, (rings - 1) * columns + next, (rings - 1) * columns + j);
  }
  return mesh;
}

inline float between(Rng& rng, float low, float high) { return low + (high - low) * rng.uniform(); }

inline Vec3 random_point(Rng& rng, float size) {
  return {between(rng, -size, size), between(rng, -size, size), between(rng, -size, size)};
}

inline Vec3 random_direction(Rng& rng) {
  for (;;) {
    const Vec3 v = random_point(rng, 1);
    const float l = length(v);
    if (l > 0.1f && l < 1) return v / l;
  }
}

/// From a point well outside a ball of radius `size` toward a point inside it.
inline Ray random_ray(Rng& rng, float size, Vec3 center = {}) {
  const Vec3 origin = random_direction(rng) * (size * between(rng, 2, 5));
  const Vec3 target = random_point(rng, size * 0.7f);
  return {center + origin, normalize(target - origin)};
}

/// The transforms every shape is tried under: turned, stretched, mirrored, moved.
inline std::vector<Transform> trial_transforms() {
  return {Transform(), Transform::translate(3, -2, 5) * Transform::rotate(40, 1, 2, 3),
          Transform::rotate(70, 0, 1, 1) * Transform::scale(0.3, 2, 1.1) * Transform::rotate(20, 1, 0, 0),
          Transform::scale(-1, 1, 1) * Transform::translate(1, 0, 0),
          Transform::scale(1, -2, 0.5) * Transform::rotate(33, 3, 1, 0)};
}

/// Sum of the signs of the crossings.
inline int sum_of(const Crossings& crossings) {
  int sum = 0;
  for (const Crossing& c : crossings) sum += c.sign;
  return sum;
}

}  // namespace tyndall::test
