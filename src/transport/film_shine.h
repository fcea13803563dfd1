/// Small shining surfaces, where the camera sees them on the film.
///
/// A lamp of less than a pixel is met by few of the pixel's samples, and brightly: where bulbs are in the picture that is most
/// of its noise.
#pragma once

#include <cstdint>
#include <vector>

#include "light/lights.h"
#include "transport/pixel_lights.h"
#include "tyndall/image.h"

namespace tyndall {

struct ShiningLight {
  LightId light = 0;
  float brightness = 0;
};
/// The surfaces that may be aimed at for one pixel.
using PixelShine = PixelLights<ShiningLight>;

/// All of them, by pixel.
class FilmShine {
 public:
  /// Pixels. Whoever filters more widely meets lamps, and would list each hundreds of times.
  static constexpr float kWidestFilter = 4;
  /// The image of a shining primitive, as a circle that holds about all of it.
  struct Spot {
    LightId light = 0;
    Vec2 at;               ///< pixels of the full frame
    float radius = 0;      ///< pixels
    float brightness = 0;  ///< in any unit, of the image and not of its area
  };
  /// Which spots are worth it.
  struct View {
    PixelBounds pixels;
    Vec2 filter_radius;
    /// Whether a pixel's filter may see some of it, and it is small enough to be missed by most samples.
    bool wants(const Spot& spot) const;
  };

  FilmShine() = default;
  /// Pixels whose filters spots would fill together have none: their samples meet them anyhow.
  FilmShine(const View& view, const std::vector<Spot>& spots);
  PixelShine of(int x, int y) const;

 private:
  void add_row(const View& view, int y, const std::vector<Spot>& spots, const std::vector<std::uint32_t>& seen);

  PixelBounds pixels_;
  std::vector<std::uint32_t> begin_;  ///< of each pixel's lights, and the end of the last's; empty without spots
  std::vector<ShiningLight> lights_;
};

}  // namespace tyndall
