/// Parts of a picture that have no sample.
#pragma once

#include <span>

#include "tyndall/image.h"

namespace tyndall {

/// Pixels of `tiles` have 0 in SampleCount, which is added where it is missing, and in Replicate.SampleCount; the others have
/// `samples`, or what is there.
void mark_unrendered(Image& image, std::span<const PixelBounds> tiles, int samples);

}  // namespace tyndall
