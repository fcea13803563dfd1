/// Pieces of pbrt scene text for tests, put together with +.
///
///     const std::string scene = view({.eye = {0, 0, 1}, .look = {0, 0, 0}}) + environment(1) +
///         homogeneous("m", {.sigma_a = Rgb(1)}) + medium_box("m", "", {{-1, -1, -1}, {1, 1, 0}});
#pragma once

#include <string>
#include <vector>

#include "tyndall/math.h"

namespace tyndall::test {

/// Film, integrator and camera, up to WorldBegin. A box filter of one pixel, so that pixels are independent.
struct View {
  Vec3 eye{}, look{};
  /// Half the side of the orthographic window. The default is so narrow that all pixels see one and the same ray:
  /// every pixel is then an independent estimate of the same radiance.
  float half_width = 1e-5f;
  float fov_degrees = 0;  ///< above 0: a perspective camera instead
  int resolution = 16;
  int max_depth = 1000;
  /// Of the pixels: its name and parameters.
  std::string filter = "\"box\" \"float xradius\" 0.5 \"float yradius\" 0.5";
  std::string before_camera{};  ///< media to declare
  std::string medium{};         ///< the camera's; empty: none declared
};
std::string view(const View& v);

/// A homogeneous medium's coefficients, or what a grid's density 1 stands for.
struct Coefficients {
  Rgb sigma_a{}, sigma_s{};
  float g = 0;
  Rgb Le{};             ///< emission sigma_a * Le
  std::string phase{};  ///< in place of g: the parameters of a phase function
};

/// Parameters of a phase function of each kind that media have besides HG.
inline const std::vector<std::string> kOtherPhases{"\"string phase\" \"rayleigh\"",
                                                   "\"string phase\" \"draine\" \"float g\" 0.6 \"float alpha\" 4",
                                                   "\"string phase\" \"mie\" \"float diameter\" 8"};
std::string homogeneous(const std::string& name, const Coefficients& c);

/// A uniform grid over `bounds` with nx * ny * nz densities, x fastest.
struct Grid {
  Bounds3 bounds;
  int nx = 1, ny = 1, nz = 1;
  std::vector<float> density;
};
std::string uniform_grid(const std::string& name, const Coefficients& c, const Grid& grid);
/// A .vdb or .nvdb file.
std::string vdb(const std::string& name, const Coefficients& c, const std::string& path);

/// The faces of a box as one mesh, normals outward.
std::string box_mesh(const Bounds3& box);
/// A box_mesh of interface material: the boundary from `inside` to `outside` ("": none).
std::string medium_box(const std::string& inside, const std::string& outside, const Bounds3& box);
/// The same boundary as six separate quads within one attribute block.
std::string medium_box_of_quads(const std::string& inside, const std::string& outside, const Bounds3& box);

/// Constant environment of radiance L.
std::string environment(float L);
std::string point_light(Vec3 from, float I);
/// Parallel light along `direction` with irradiance E on a plane facing it.
std::string distant_light(Vec3 direction, float E);

/// A square z = `height` of half-side `half`, seen from both sides, of diffuse `reflectance`.
std::string diffuse_plane(float height, float half, float reflectance);
/// A square of half-side `half` around `center` facing -z, of radiance L.
std::string emitting_square(Vec3 center, float half, float L);

std::string number(double v);                ///< the shortest text that reads back as the same float
std::string block(const std::string& text);  ///< AttributeBegin ... AttributeEnd

}  // namespace tyndall::test
