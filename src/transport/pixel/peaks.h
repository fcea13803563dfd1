/// Places on surfaces that a light without extent stands close to, on the film.
///
/// At height h above a surface a point light's irradiance goes as h / (h^2 + rho^2)^(3/2) with the distance rho from its foot.
/// Where h is less than what a pixel sees, the filter's samples find that peak seldom, and brightly when they do: their
/// variance goes as 1 / h^2. Film positions are therefore also drawn in proportion to it.
#pragma once

#include <cstdint>
#include <vector>

#include "light/query.h"
#include "math/small_vector.h"
#include "tyndall/image.h"

namespace tyndall {

/// A light and the plane below it, as the camera sees it.
struct Peak {
  LightId light = 0;
  Vec2 at;               ///< image of the foot, pixels of the full frame
  Vec2 right, down;      ///< how far one moves on the plane, in coordinates of its own, for a step of one pixel
  float height = 0;      ///< of the light above the plane, in these coordinates; > 0
  float brightness = 0;  ///< in any unit

  Vec2 draw(Vec2 u) const;  ///< a film position
  float pdf(Vec2 x) const;  ///< 1/pixels^2, of draw()
  Vec2 reach() const;       ///< half the size of a box around the foot that holds all positions, pixels

 private:
  float radius() const;  ///< of those positions, on the plane
  float share() const;
};

/// The brightest of one pixel, drawn in proportion to that.
class PixelPeaks {
 public:
  static constexpr std::size_t kMost = 8;  ///< others are left to the filter's samples
  using List = SmallVector<Peak, kMost>;

  PixelPeaks() = default;
  explicit PixelPeaks(List peaks);
  bool empty() const { return peaks_.empty(); }

  struct Draw {
    LightId light;
    Vec2 x;     ///< pixels of the full frame
    float pdf;  ///< as of pdf()
  };
  Draw draw(float which, Vec2 u) const;    ///< numbers in [0, 1); not when empty
  float pdf(LightId light, Vec2 x) const;  ///< 1/pixels^2, of the light and, by any of its peaks, the position

 private:
  List peaks_;  ///< their brightness is the probability
};

/// Those of all pixels.
class FilmPeaks {
 public:
  FilmPeaks() = default;
  FilmPeaks(const PixelBounds& pixels, Vec2 filter_radius, std::vector<Peak> peaks);
  /// Of pixel (x, y), which must be one of the pixels: those that its filter sees a part of.
  PixelPeaks of(int x, int y) const;

 private:
  PixelBounds pixels_;
  Vec2 filter_radius_;
  std::vector<Peak> peaks_;
  std::vector<std::size_t> begin_;       ///< of each pixel in of_pixel_, and the end of the last's; empty without peaks
  std::vector<std::uint32_t> of_pixel_;  ///< into peaks_
};

}  // namespace tyndall
