#include "session/rendered_pixels.h"

#include <algorithm>

#include "session/pixel_block.h"
#include "tyndall/error.h"

namespace tyndall {

PixelBounds rendered_pixels(const Scene& scene, const RenderSettings& settings) {
  const PixelBounds frame = frame_of(scene.film);
  const PixelBounds wanted = settings.crop.value_or(scene.film.crop);
  const PixelBounds crop{std::max(wanted.x0, frame.x0), std::max(wanted.y0, frame.y0), std::min(wanted.x1, frame.x1),
                         std::min(wanted.y1, frame.y1)};
  if (crop.width() <= 0 || crop.height() <= 0) {
    throw Error(Failure::usage, "the crop holds no pixel of the " + std::to_string(frame.x1) + "x" + std::to_string(frame.y1) +
                                    " frame; give x0,x1,y0,y1 inside it");
  }
  return crop;
}

}  // namespace tyndall
