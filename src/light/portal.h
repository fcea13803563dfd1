/// Light from infinity that enters through a rectangle, a portal [Bitterli et al. 2015]: black in every direction that does
/// not lead through it, as in pbrt-v4.
///
/// To the light tree it is a flat one-sided light that stands where the portal does.
#pragma once

#include <optional>
#include <vector>

#include "light/bounds.h"
#include "light/environment.h"
#include "light/light_place.h"
#include "math/vec3d.h"
#include "math/windowed_distribution.h"
#include "tyndall/scene.h"

namespace tyndall {

class Portal {
 public:
  /// `light` has a portal. Throws Error at `where` when its map cannot be read or the portal is no rectangle.
  Portal(const InfiniteLight& light, const Location& where, KeptFiles* kept = nullptr);

  Rgb radiance(Vec3 p, Vec3 w) const;  ///< arriving at `p` from unit direction `w`
  /// In proportion to the luminance of what is seen through the portal from `p`, as far as it is constant in the texels.
  std::optional<Environment::Sample> sample(Vec3 p, Vec2 u) const;
  float pdf(Vec3 p, Vec3 w) const;  ///< 1/sr

  double power() const { return power_; }  ///< W that enters, mean of the channels
  LightBounds bounds() const;
  LightPlace place() const;
  std::size_t memory_bytes() const { return texels_.capacity() * sizeof(Rgb) + distribution_.memory_bytes(); }

 private:
  struct Angles {
    double u, v;
  };
  void resample(const Environment& map);
  std::array<Vec3, 4> corners() const;
  Vec3d local(Vec3 w) const { return {dot(x_, Vec3d(w)), dot(y_, Vec3d(w)), dot(z_, Vec3d(w))}; }
  static std::optional<Angles> angles_of(Vec3d local);
  static Vec3d direction(double u, double v);
  /// What is seen through the portal; nothing from behind it.
  std::optional<Window> window(Vec3 p) const;
  Rgb texel(Angles at) const;

  Vec3d corner_;
  Vec3d x_, y_, z_;  ///< unit: along two edges, and out toward the light
  double width_, height_;
  int size_ = 1;             ///< texels along a side
  std::vector<Rgb> texels_;  ///< radiance on a grid that is even in the angles of x and of y to z
  WindowedDistribution distribution_;
  double power_ = 0;
};

}  // namespace tyndall
