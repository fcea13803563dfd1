/// The fields of the structs of scene.h as tuples, so that code which must see every one of them cannot miss one: a
/// struct that gains a field no longer compiles here until its number is put right, and then the field is seen.
#pragma once

#include <tuple>
#include <type_traits>

#include "tyndall/scene.h"

namespace tyndall {

/// How many fields a struct has; -1: not listed.
template <typename Struct>
inline constexpr int kFieldCount = -1;

// Values.
template <> inline constexpr int kFieldCount<Vec2> = 2;
template <> inline constexpr int kFieldCount<Vec3> = 3;
template <> inline constexpr int kFieldCount<Rgb> = 3;
template <> inline constexpr int kFieldCount<Bounds3> = 2;
template <> inline constexpr int kFieldCount<PixelBounds> = 4;
template <> inline constexpr int kFieldCount<Chromaticities> = 4;
// Textures.
template <> inline constexpr int kFieldCount<TextureMapping> = 6;
template <> inline constexpr int kFieldCount<ConstantTexture> = 1;
template <> inline constexpr int kFieldCount<ScaleTexture> = 2;
template <> inline constexpr int kFieldCount<MixTexture> = 3;
template <> inline constexpr int kFieldCount<ImageTexture> = 8;
template <> inline constexpr int kFieldCount<CheckerboardTexture> = 4;
template <> inline constexpr int kFieldCount<Texture> = 2;
// Materials.
template <> inline constexpr int kFieldCount<Roughness> = 3;
template <> inline constexpr int kFieldCount<ConductorOptics> = 3;
template <> inline constexpr int kFieldCount<DiffuseMaterial> = 1;
template <> inline constexpr int kFieldCount<ConductorMaterial> = 2;
template <> inline constexpr int kFieldCount<DielectricMaterial> = 2;
template <> inline constexpr int kFieldCount<ThinDielectricMaterial> = 1;
template <> inline constexpr int kFieldCount<DiffuseTransmissionMaterial> = 3;
template <> inline constexpr int kFieldCount<Coating> = 7;
template <> inline constexpr int kFieldCount<CoatedDiffuseMaterial> = 2;
template <> inline constexpr int kFieldCount<CoatedConductorMaterial> = 3;
template <> inline constexpr int kFieldCount<MixMaterial> = 3;
template <> inline constexpr int kFieldCount<InterfaceMaterial> = 0;
template <> inline constexpr int kFieldCount<Material> = 3;
// Media.
template <> inline constexpr int kFieldCount<MediumOptics> = 3;
template <> inline constexpr int kFieldCount<HomogeneousMedium> = 1;
template <> inline constexpr int kFieldCount<UniformGridMedium> = 9;
template <> inline constexpr int kFieldCount<RgbGridMedium> = 8;
template <> inline constexpr int kFieldCount<CloudMedium> = 4;
template <> inline constexpr int kFieldCount<VdbMedium> = 10;
template <> inline constexpr int kFieldCount<Medium> = 5;
template <> inline constexpr int kFieldCount<Boundary> = 2;
// Lights.
template <> inline constexpr int kFieldCount<PointLight> = 2;
template <> inline constexpr int kFieldCount<SpotLight> = 4;
template <> inline constexpr int kFieldCount<DistantLight> = 2;
template <> inline constexpr int kFieldCount<InfiniteLight> = 5;
template <> inline constexpr int kFieldCount<Light> = 2;
template <> inline constexpr int kFieldCount<AreaLight> = 5;
// Shapes.
template <> inline constexpr int kFieldCount<TriangleMesh> = 4;
template <> inline constexpr int kFieldCount<BilinearMesh> = 4;
template <> inline constexpr int kFieldCount<Sphere> = 4;
template <> inline constexpr int kFieldCount<Disk> = 4;
template <> inline constexpr int kFieldCount<Cylinder> = 4;
template <> inline constexpr int kFieldCount<Shape> = 8;
template <> inline constexpr int kFieldCount<Object> = 2;
template <> inline constexpr int kFieldCount<Instance> = 2;
// Camera, film, whole.
template <> inline constexpr int kFieldCount<Camera> = 8;
template <> inline constexpr int kFieldCount<Film> = 9;
template <> inline constexpr int kFieldCount<PixelFilter> = 6;
template <> inline constexpr int kFieldCount<Scene> = 13;

/// References to all fields of `s`, in order.
template <typename Struct>
auto fields(Struct& s) {
  constexpr int n = kFieldCount<std::remove_const_t<Struct>>;
  static_assert(n >= 0 && n <= 13, "list the struct in kFieldCount; above 13 fields, add a case below");
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
