/// Pictures whose pixels share their noise within blocks, as pictures of independent pixels.
#pragma once

#include "tyndall/image.h"

namespace tyndall::test {

/// Means of R, G and B over blocks of `side` x `side` pixels, of which the picture holds a whole number each way.
Image block_image(const Image& image, int side);

}  // namespace tyndall::test
