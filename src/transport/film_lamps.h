/// Lamps that stand in media, where the camera sees them on the film.
///
/// Over the pixels around it the light of such a lamp goes as 1/distance to its image: whatever the samples of a pixel, what
/// they gather of it has no bound. So film positions are also drawn around a pixel's lamps, uniformly in that distance.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "light/lights.h"
#include "transport/pixel_lights.h"
#include "tyndall/image.h"

namespace tyndall {

struct FilmLamp {
  LightId light = 0;
  Vec2 at;               ///< pixels of the full frame
  float brightness = 0;  ///< of its image, in any unit
  float g = 0;           ///< mean cosine of the media around it
};

/// Positions around a lamp's image.
class FilmReach {
 public:
  /// `finest`: pixels below which positions mean nothing.
  FilmReach(Vec2 filter_radius, float finest);
  FilmReach() = default;
  Vec2 draw(Vec2 at, Vec2 u) const;
  float pdf(Vec2 at, Vec2 x) const;  ///< 1/pixels^2

 private:
  float least_ = 0, most_ = 0;  ///< pixels
};

/// The lamps that may be drawn for one pixel, and positions around them.
class PixelLamps {
 public:
  using Lamps = PixelLights<FilmLamp>;

  PixelLamps(const FilmReach& reach, Lamps::List lamps) : reach_(reach), lamps_(std::move(lamps)) {}
  bool empty() const { return lamps_.empty(); }

  struct Draw {
    LightId light;
    Vec2 x;     ///< pixels of the full frame
    float pdf;  ///< 1/pixels^2, of both; 0 where x rounds away
    float g;    ///< FilmLamp::g
  };
  Draw draw(float which, Vec2 around) const;
  float pdf(LightId light, Vec2 x) const;  ///< Draw::pdf

 private:
  FilmReach reach_;
  Lamps lamps_;
};

/// All lamps, by the pixel they are in.
class FilmLamps {
 public:
  /// What pixels are asked about, and how.
  struct View {
    PixelBounds pixels;
    Vec2 filter_radius;
    float finest;  ///< pixels below which positions mean nothing
    /// Whether the filter of one of the pixels may see that film position. Never, for filters too wide to look for lamps.
    bool sees(Vec2 at) const;
  };
  FilmLamps() = default;
  FilmLamps(const View& view, std::vector<FilmLamp> lamps);
  /// Those that the filter of pixel (x, y) sees.
  PixelLamps of(int x, int y) const;

 private:
  FilmReach reach_;
  Vec2 radius_;
  PixelBounds cells_;                 ///< the pixels, and a rim around them
  std::vector<std::uint32_t> begin_;  ///< of each cell's lamps, and the end of the last's; empty without lamps
  std::vector<FilmLamp> lamps_;
};

}  // namespace tyndall
