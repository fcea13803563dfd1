/// How the intensity of a light without extent depends on direction: by a map, a projected image or a photometric table.
///
/// Everything here is in the space of the light, for an intensity of 1.
#pragma once

#include <functional>
#include <variant>
#include <vector>

#include "light/bounds.h"
#include "math/vec3d.h"
#include "texture/texel_image.h"
#include "tyndall/io.h"

namespace tyndall {

/// A piece of the sphere of directions over which the intensity hardly changes.
struct ProfilePart {
  Vec3 w;        ///< a direction in it
  float reach;   ///< angle around `w` that encloses it
  double omega;  ///< its solid angle
  float value;   ///< mean of the channels
  bool lit;      ///< not 0 everywhere
};
using PartVisitor = std::function<void(const ProfilePart&)>;

/// pbrt's goniometric light: a grey equal-area map, read at the nearest texel. The map's z is the light's y and the other way
/// round.
class GoniometricMap {
 public:
  explicit GoniometricMap(const TexelImage& image);  ///< square
  Rgb at(Vec3 w) const;                              ///< unit `w`
  Rgb flux() const { return Rgb(4 * kPi * mean_); }
  void visit(const PartVisitor& visitor) const;
  std::size_t memory_bytes() const { return texels_.capacity() * sizeof(float); }

 private:
  int size_;
  std::vector<float> texels_;
  float mean_;
};

/// pbrt's projection light: an image seen through a lens of a field of view along its shorter side, read at the nearest texel.
/// It is projected along +z; its right is +x and its top +y.
class ProjectedImage {
 public:
  ProjectedImage(TexelImage image, float fov_degrees);
  Rgb at(Vec3 w) const;
  Rgb flux() const;
  void visit(const PartVisitor& visitor) const;
  std::size_t memory_bytes() const { return image_.memory_bytes(); }

 private:
  Vec3d direction(double s, double t) const;  ///< of image coordinates, not normalised
  double solid_angle(double s0, double s1, double t0, double t1) const;

  TexelImage image_;
  double half_x_, half_y_;  ///< tangents of half the angles
};

/// A photometric web of type C [LM-63], interpolated linearly in both angles. 0 degrees, down, is -y; the horizontal angle
/// turns from +x to +z. Nothing outside of the vertical angles.
class PhotometricTable {
 public:
  explicit PhotometricTable(const PhotometricWeb& web);
  Rgb at(Vec3 w) const;
  Rgb flux() const;  ///< exactly, of what is interpolated
  void visit(const PartVisitor& visitor) const;
  std::size_t memory_bytes() const { return intensity_.capacity() * sizeof(float); }

 private:
  struct Plane {
    double phi;  ///< radians, increasing from below 0 to beyond 2 pi
    std::size_t row;
  };
  double between(const Plane& a, const Plane& b, double theta, double phi) const;
  double on_plane(std::size_t row, double theta) const;
  double plane_flux(std::size_t row) const;

  std::vector<double> theta_;
  std::vector<Plane> planes_;
  std::vector<float> intensity_;  ///< W/sr, row by row
};

/// What the light tree is told: emission within `theta_e` of a cone of normals, about like its cosine beyond it.
struct ProfileLobe {
  DirectionCone normals;
  float theta_e;
  DirectionCone beam;  ///< all directions that it emits into
  double measure;      ///< solid angle weighted with that cosine
};

class IntensityProfile {
 public:
  using Kind = std::variant<GoniometricMap, ProjectedImage, PhotometricTable>;
  explicit IntensityProfile(Kind kind);

  Rgb at(Vec3 w) const;
  Rgb flux() const { return flux_; }  ///< integral over all directions
  const ProfileLobe& lobe() const { return lobe_; }
  std::size_t memory_bytes() const;

 private:
  Kind kind_;
  Rgb flux_;
  ProfileLobe lobe_;
};

}  // namespace tyndall
