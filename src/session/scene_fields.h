/// The fields of the structs of scene.h as tuples, so that code which must see every one of them cannot miss one: a
/// struct that gains a field no longer compiles here until its number is put right, and then the field is seen.
#pragma once

#include <tuple>
#include <type_traits>

#include "tyndall/scene.h"

namespace tyndall {

template <typename T, typename... Ts>
inline constexpr bool kOneOf = (std::is_same_v<T, Ts> || ...);

/// How many fields a struct has; -1: not listed. `fields` does not compile when it is wrong.
template <typename T>
constexpr int field_count() {
  if (kOneOf<T, InterfaceMaterial>) return 0;
  if (kOneOf<T, ConstantTexture, DiffuseMaterial, ThinDielectricMaterial, HomogeneousMedium>) return 1;
  if (kOneOf<T, Vec2, Bounds3, ScaleTexture, Texture, ConductorMaterial, CoatedDiffuseMaterial>) return 2;
  if (kOneOf<T, Boundary, PointLight, DistantLight, Object, Instance>) return 2;
  if (kOneOf<T, Vec3, Rgb, MixTexture, Roughness, ConductorOptics, DiffuseTransmissionMaterial, MixMaterial, Light>) return 3;
  if (kOneOf<T, CoatedConductorMaterial, DielectricMaterial, DotsTexture, DirectionMixTexture, MediumOptics>) return 3;
  if (kOneOf<T, PixelBounds, Chromaticities, CheckerboardTexture, LensElement, CloudMedium, SpotLight, GoniometricLight>)
    return 4;
  if (kOneOf<T, TriangleMesh, BilinearMesh, Sphere, Disk, Cylinder>) return 4;
  if (kOneOf<T, ProjectionLight, BilerpTexture, Lenses>) return 5;
  if (kOneOf<T, TextureMapping, PixelFilter, InfiniteLight, NoiseTexture, Material, Medium, AreaLight>) return 6;
  if (kOneOf<T, Coating>) return 7;
  if (kOneOf<T, RgbGridMedium>) return 8;
  if (kOneOf<T, Film, Camera, Shape>) return 9;
  if (kOneOf<T, ImageTexture>) return 10;
  if (kOneOf<T, UniformGridMedium, VdbMedium>) return 11;
  if (kOneOf<T, Scene>) return 13;
  return -1;
}

/// References to all fields of `s`, in order.
template <typename Struct>
auto fields(Struct& s) {
  constexpr int n = field_count<std::remove_const_t<Struct>>();
  static_assert(n >= 0 && n <= 13, "list the struct in field_count; above 13 fields, add a case below");
  if constexpr (n == 0) {
    static_assert(std::is_empty_v<Struct>);
    return std::tuple<>();
  } else if constexpr (n == 1) {
    auto& [a] = s;
    return std::tie(a);
  } else if constexpr (n == 2) {
    auto& [a, b] = s;
    return std::tie(a, b);
  } else if constexpr (n == 3) {
    auto& [a, b, c] = s;
    return std::tie(a, b, c);
  } else if constexpr (n == 4) {
    auto& [a, b, c, d] = s;
    return std::tie(a, b, c, d);
  } else if constexpr (n == 5) {
    auto& [a, b, c, d, e] = s;
    return std::tie(a, b, c, d, e);
  } else if constexpr (n == 6) {
    auto& [a, b, c, d, e, f] = s;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (n == 7) {
    auto& [a, b, c, d, e, f, g] = s;
    return std::tie(a, b, c, d, e, f, g);
  } else if constexpr (n == 8) {
    auto& [a, b, c, d, e, f, g, h] = s;
    return std::tie(a, b, c, d, e, f, g, h);
  } else if constexpr (n == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = s;
    return std::tie(a, b, c, d, e, f, g, h, i);
  } else if constexpr (n == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = s;
    return std::tie(a, b, c, d, e, f, g, h, i, j);
  } else if constexpr (n == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = s;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (n == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = s;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l);
  } else {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = s;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m);
  }
}

}  // namespace tyndall
