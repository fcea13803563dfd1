/// Point and spot lights in media, by their image on the film.
///
/// Over the pixels around it the single scattering of such a light goes as 1/distance to its image, so the samples of the
/// filter have infinite variance. Film positions are therefore also drawn around the images of a pixel's lights, uniformly in
/// that distance.
#pragma once

#include <cstdint>
#include <vector>

#include "light/query.h"
#include "math/small_vector.h"
#include "tyndall/image.h"

namespace tyndall {

struct FilmPoint {
  LightId light = 0;
  Vec2 at;               ///< pixels of the full frame
  float brightness = 0;  ///< of its image, in any unit
  float g = 0;           ///< mean cosine of the media around it
};

/// Positions around a light's image.
class FilmReach {
 public:
  /// `finest`: distances on the film, in pixels, below which positions are not resolved.
  FilmReach(Vec2 filter_radius, float finest);
  FilmReach() = default;
  Vec2 draw(Vec2 at, Vec2 u) const;
  float pdf(Vec2 at, Vec2 x) const;  ///< 1/pixels^2

 private:
  float least_ = 0, most_ = 0;  ///< pixels
};

/// The brightest lights of one pixel, drawn in proportion to that, and positions around them.
class PixelPoints {
 public:
  static constexpr std::size_t kMost = 8;  ///< others are left to the filter's samples
  using List = SmallVector<FilmPoint, kMost>;

  PixelPoints() = default;
  PixelPoints(const FilmReach& reach, List points);
  bool empty() const { return points_.empty(); }

  struct Draw {
    LightId light;
    Vec2 x;     ///< pixels of the full frame
    float pdf;  ///< 1/pixels^2, of both; 0 where x rounds away
    float g;    ///< FilmPoint::g
  };
  Draw draw(float which, Vec2 around) const;  ///< numbers in [0, 1); not when empty
  float pdf(LightId light, Vec2 x) const;     ///< Draw::pdf

 private:
  float pdf(const FilmPoint& point, Vec2 x) const { return point.brightness * reach_.pdf(point.at, x); }

  FilmReach reach_;
  List points_;  ///< their brightness is the probability
};

/// All lights, by the pixel of their image.
class FilmPoints {
 public:
  /// Which pixels are rendered, and by which filter.
  struct View {
    PixelBounds pixels;
    Vec2 filter_radius;
    float finest;  ///< pixels below which positions are not resolved
    /// Whether the filter of one of the pixels covers that film position. Never for filters too wide.
    bool sees(Vec2 at) const;
  };
  FilmPoints() = default;
  FilmPoints(const View& view, std::vector<FilmPoint> points);
  /// Those that the filter of pixel (x, y) sees.
  PixelPoints of(int x, int y) const;

 private:
  FilmReach reach_;
  Vec2 radius_;
  PixelBounds cells_;                 ///< the pixels, and a rim around them
  std::vector<std::uint32_t> begin_;  ///< of each cell's lights, and the end of the last's; empty without lights
  std::vector<FilmPoint> points_;
};

}  // namespace tyndall
