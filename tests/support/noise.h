/// How noisy and how bright a picture is.
#pragma once

#include <string>

#include "tyndall/settings.h"

namespace tyndall::test {

/// Sums over the pixels of the channel R and of its variance: the standard error of `mean` is the root of `noise`.
struct Noise {
  double noise = 0, mean = 0;
};
/// Of one render of the scene `text` by `spp` samples a pixel.
Noise noise_of(const std::string& text, JointStrategy joint, int spp);

}  // namespace tyndall::test
