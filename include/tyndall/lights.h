/// The lights of a scene as plain data, as scene.h has all else: directives, defaults and units of the pbrt-v4 format.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tyndall/error.h"
#include "tyndall/math.h"

namespace tyndall {

struct Image;

struct PointLight {
  Vec3 position;  ///< world space
  Rgb I;          ///< W/sr
};
struct SpotLight {
  Transform to_world;                ///< light at the origin, emitting along +z
  Rgb I;                             ///< on the axis
  float cone_angle_degrees = 30;     ///< half angle where it reaches 0
  float falloff_start_degrees = 25;  ///< half angle where it begins to fall, pbrt's smoothstep
};
struct DistantLight {
  Vec3 direction;  ///< world space, from the light toward the scene
  Rgb E;           ///< irradiance on a surface facing it
};
struct InfiniteLight {
  Transform to_world;
  Rgb L{1.0f};       ///< radiance, or the map's factor
  std::string path;  ///< environment map; empty: constant. Square: equal-area octahedral; 2:1: latitude-longitude
  std::array<float, 9> to_rec709{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::optional<float> illuminance;  ///< when set, scale so that an upward surface receives this much (pbrt)
  /// World-space corners of a rectangle, in order around it: only what comes through it arrives, from the side of
  /// (p3 - p0) x (p1 - p0) (pbrt).
  std::optional<std::array<Vec3, 4>> portal;
};
/// A point whose intensity depends on direction.
struct GoniometricLight {
  Transform to_world;  ///< light at the origin
  Rgb I{1.0f};         ///< W/sr where the map is 1; of a photometric file, a factor
  /// A square equal-area map of the mean of its channels, whose z is the light's y and the other way round (pbrt); or .ies:
  /// LM-63, up along the light's +y, horizontal angle 0 along +x and 90 along +z.
  std::string path;
  std::optional<float> power;  ///< when set, scale so that it emits this much times I
};
/// A point that projects an image along +z, its right to +x and its top to +y.
struct ProjectionLight {
  Transform to_world;          ///< light at the origin
  Rgb I{1.0f};                 ///< W/sr where the image is 1
  std::string path;            ///< image
  float fov_degrees = 90;      ///< of its shorter side
  std::optional<float> power;  ///< when set, scale so that it emits this much times I
};
struct Light {
  std::variant<PointLight, SpotLight, DistantLight, InfiniteLight, GoniometricLight, ProjectionLight> kind;
  Location where;
  std::string group{};  ///< light group (is_light_group_name); empty: none
};
/// Diffuse emission of a shape.
struct AreaLight {
  Rgb L;             ///< radiance
  std::string path;  ///< emission image over uv, multiplied by L; empty: constant
  std::array<float, 9> to_rec709{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::optional<float> power;  ///< when set, L is scaled so that each triangle, patch or quadric emits this much (pbrt)
  bool two_sided = false;
  std::string group{};  ///< light group, as of a Light
};

/// Light without a group is kept under this name where some has one.
inline constexpr std::string_view kUngrouped = "default";
/// What the channels of a group begin with: "LightGroup.key.", before "R", "G" and "B".
std::string light_group_channel(std::string_view name);
/// Whether channels of an image can be named by it: 1 to 64 letters, digits, - and _.
bool is_light_group_name(std::string_view name);
/// Names of the groups whose channels R, G and B an image holds, in their order there.
std::vector<std::string> light_groups_in(const Image& image);

}  // namespace tyndall
