/// Pictures compared bit for bit.
#pragma once

#include "tyndall/image.h"

namespace tyndall::test {

/// Whether R, G and B of `part` are what `whole`, which holds all of its pixels, has in the same places of the frame.
inline bool same_pixels(const Image& part, const Image& whole) {
  const int x0 = part.data.x0 - whole.data.x0, y0 = part.data.y0 - whole.data.y0;
  bool same = true;
  for (int y = 0; y < part.height(); ++y) {
    for (int x = 0; x < part.width(); ++x) same = same && part.rgb(x, y) == whole.rgb(x + x0, y + y0);
  }
  return same;
}

}  // namespace tyndall::test
