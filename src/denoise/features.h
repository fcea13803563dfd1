/// What explains a picture beside its light: surfaces and media as the camera sees them.
#pragma once

#include <vector>

#include "denoise/plane.h"

namespace tyndall {

/// One to three channels that belong together, in two halves.
struct Feature {
  std::array<std::vector<PaddedPlane>, 2> halves;
};

/// Noise taken away by non-local means, each half with weights of its own, so that neither knows of the other's noise.
Feature prefiltered(const Feature& feature, ThreadPool& pool);

}  // namespace tyndall
