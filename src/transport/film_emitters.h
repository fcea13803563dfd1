/// Small emissive surfaces, by their footprint on the film.
///
/// An emitter smaller than a pixel is hit by few of the pixel's samples, and brightly: where it is directly visible that is
/// most of the noise.
#pragma once

#include <cstdint>
#include <vector>

#include "light/lights.h"
#include "transport/pixel_lights.h"
#include "tyndall/image.h"

namespace tyndall {

struct FilmEmitter {
  LightId light = 0;
  float brightness = 0;
};
/// The surfaces that may be aimed at for one pixel.
using PixelEmitters = PixelLights<FilmEmitter>;

/// All of them, by pixel.
class FilmEmitters {
 public:
  /// Pixels. Wider filters hit emitters often enough, and would list each hundreds of times.
  static constexpr float kWidestFilter = 4;
  /// The footprint of an emissive primitive, as a circle that encloses nearly all of it.
  struct Spot {
    LightId light = 0;
    Vec2 at;               ///< pixels of the full frame
    float radius = 0;      ///< pixels
    float brightness = 0;  ///< of the image as a whole, in any unit
  };
  /// Which footprints are worth aiming at.
  struct View {
    PixelBounds pixels;
    Vec2 filter_radius;
    /// Whether a pixel's filter may cover some of it, and it is so small that looks at pixel centers may miss it.
    bool wants(const Spot& spot) const;
    /// It is even missed by most samples.
    bool aims_at(const Spot& spot) const;
  };

  FilmEmitters() = default;
  /// Pixels whose filters the footprints would fill together have no aims: their samples hit them anyhow.
  FilmEmitters(const View& view, const std::vector<Spot>& spots);
  PixelEmitters of(int x, int y) const;
  /// What a pixel sees at which it does not aim: nothing; some that would fill it together; some too large.
  enum class Unaimed : char { none, crowd, large };
  Unaimed unaimed(int x, int y) const { return unaimed_.empty() ? Unaimed::none : unaimed_[pixels_.index(x, y)]; }

 private:
  void add_row(const View& view, int y, const std::vector<Spot>& spots, const std::vector<std::uint32_t>& seen);

  PixelBounds pixels_;
  std::vector<std::uint32_t> begin_;  ///< of each pixel's lights, and the end of the last's; empty without any
  std::vector<FilmEmitter> lights_;
  std::vector<Unaimed> unaimed_;  ///< likewise
};

}  // namespace tyndall
