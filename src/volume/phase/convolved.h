/// Phase functions blurred: what they make of light that does not come from one direction.
#pragma once

#include "math/simd.h"
#include "volume/phase/phase.h"

namespace tyndall {

/// Value, 1/sr, of a phase function convolved with eight lobes of Henyey and Greenstein's form and mean cosine `h`, in [0, 1),
/// at `below` = 1 - cosine of the angle from the forward direction. Exact for all kinds but for rounding, and within 0.1 % for
/// those with a part of Draine's: lobes of that form convolve to another one, whose mean cosine is the product [Goudsmit and
/// Saunderson 1940].
Float8 convolved(const Phase& phase, Float8 h, float below);

/// At least as large as any value, 1/sr, at 1 - cosine >= `below`.
float most_beyond(const Phase& phase, float below);

}  // namespace tyndall
