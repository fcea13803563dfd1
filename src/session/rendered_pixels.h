/// The pixels that a render is asked for.
#pragma once

#include "tyndall/scene.h"
#include "tyndall/settings.h"

namespace tyndall {

/// --crop, else that of the Film, within the frame. Throws Error (usage) when no pixel is in it.
PixelBounds rendered_pixels(const Scene& scene, const RenderSettings& settings);

}  // namespace tyndall
