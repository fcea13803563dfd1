/// Light from infinitely far away in all directions: constant, or by a map.
///
/// Maps are looked up by the nearest texel, as pbrt does, so that the sampled density follows the radiance exactly.
/// In light space: square maps are pbrt's equal-area octahedral ones; in latitude-longitude maps (twice as wide as
/// high) +z is the top row, and the columns run once around from +x through +y.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "light/far_lights.h"
#include "math/distribution.h"
#include "texture/texel_image.h"
#include "tyndall/scene.h"

namespace tyndall {

class Environment {
 public:
  /// Throws Error at `where` when the map cannot be read or has neither shape.
  Environment(const InfiniteLight& light, const Location& where, KeptFiles* kept = nullptr);

  Rgb radiance(Vec3 w) const;  ///< arriving from unit direction `w`
  /// The same with square maps interpolated between texels, as pbrt resamples them for portals.
  Rgb interpolated(Vec3 w) const;
  int resolution() const { return layout_ == Layout::constant ? 1 : image_->height(); }  ///< texels from pole to pole

  struct Sample {
    Vec3 wi;
    float pdf;  ///< 1/sr
    Rgb L;
  };
  /// In proportion to what exceeds the mean luminance, since scattered rays, weighted by MIS, find the rest [Karlik et al.
  /// 2019]: nothing for a constant environment.
  std::optional<Sample> sample(Vec2 u) const;
  float pdf(Vec3 w) const;  ///< 1/sr

  Rgb mean_radiance() const { return mean_; }  ///< over all directions
  bool even() const { return !has_excess_; }   ///< nothing exceeds the mean: sample() gives nothing
  std::vector<FarCone> cones() const;          ///< one an octant
  std::optional<FarCone> peak() const;         ///< the sun of a map: narrow, with a good part of all its light
  std::size_t memory_bytes() const;

 private:
  enum class Layout { constant, equal_area, latitude_longitude };
  struct Texel {
    std::uint32_t x, y;
  };

  void load(const InfiniteLight& light, const Location& where, KeptFiles* kept);
  void build_distribution();
  Rgb texel(Texel t) const { return image_->texel(static_cast<int>(t.x), static_cast<int>(t.y)); }
  float weight(std::uint32_t x, std::uint32_t y) const;  ///< luminance of a texel
  float excess(std::uint32_t x, std::uint32_t y) const;  ///< over the mean, at least 0
  double texel_solid_angle(std::uint32_t y) const;
  double cos_row(std::uint32_t y) const;  ///< cosine at the upper edge of a latitude-longitude row
  Vec3 direction(Vec2 st) const;          ///< in light space; st.y linear in the cosine within a row
  /// Of a latitude-longitude map: what all directions of a column have in common, and all of a row.
  struct Meridian {
    double cos, sin;
  };
  struct Parallel {
    double sine, z;
  };
  static Meridian meridian(float s);
  Parallel parallel(float t) const;
  static Vec3 toward(const Meridian& m, const Parallel& p) { return to_vec3({p.sine * m.cos, p.sine * m.sin, p.z}); }
  /// body(texel, a direction in light space, its solid angle there) for `pieces` x `pieces` parts of each texel, row by row.
  template <typename Body>
  void for_each_texel(int pieces, const Body& body) const;
  Vec2 square(Vec3 w) const;  ///< st of a direction in light space, up to where it lies within its texel
  Texel texel_of(Vec2 st) const;
  Vec3 to_light(Vec3 w) const;  ///< not normalised
  Vec3 to_world(Vec3 w) const;
  float stretch(Vec3 w) const;  ///< solid angle in light space per that in the world

  Layout layout_ = Layout::constant;
  Transform to_world_;
  std::array<Vec3, 3> rows_;  ///< of the world-to-light map
  float determinant_ = 1;     ///< of that, absolute
  bool rotation_ = true;      ///< that map keeps angles and lengths
  Rgb L_;                     ///< factor of the texels
  Rgb mean_;
  std::shared_ptr<const TexelImage> image_;  ///< of a constant environment: empty
  PiecewiseConstant2D excess_;
  float mean_weight_ = 0;
  bool has_excess_ = false;  ///< something exceeds the mean
};

template <typename Body>
void Environment::for_each_texel(int pieces, const Body& body) const {
  const float fine = 1.0f / static_cast<float>(pieces);
  const auto place = [&](int i, int size) { return (static_cast<float>(i) + 0.5f) * fine / static_cast<float>(size); };
  const bool square_map = layout_ == Layout::equal_area;
  std::vector<Meridian> meridians;
  for (int x = 0; x < image_->width() * pieces && !square_map; ++x) meridians.push_back(meridian(place(x, image_->width())));
  for (int y = 0; y < image_->height() * pieces; ++y) {
    const float t = place(y, image_->height());
    const Parallel row = square_map ? Parallel{} : parallel(t);
    const double part = texel_solid_angle(texel_of({0, t}).y) / (double(pieces) * pieces);
    for (int x = 0; x < image_->width() * pieces; ++x) {
      const Vec2 st{place(x, image_->width()), t};
      body(texel_of(st), square_map ? direction(st) : toward(meridians[static_cast<std::size_t>(x)], row), part);
    }
  }
}

}  // namespace tyndall
