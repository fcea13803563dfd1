/// The colour spaces FLIP works in; white is that of linear Rec.709, D65.
#pragma once

#include <algorithm>
#include <cmath>

#include "tyndall/math.h"

namespace tyndall {

/// Three coordinates of a colour space that its function names.
struct Tristimulus {
  float x = 0, y = 0, z = 0;
};

/// CIE XYZ of linear Rec.709 relative to white, which is (1, 1, 1). IEC 61966-2-1's primaries, as exact fractions.
inline Tristimulus relative_xyz(Rgb c) {
  constexpr float kWhiteX = 0.950428545f, kWhiteZ = 1.088900371f;
  return {(10135552 / 24577794.f * c.r + 8788810 / 24577794.f * c.g + 4435075 / 24577794.f * c.b) / kWhiteX,
          2613072 / 12288897.f * c.r + 8788810 / 12288897.f * c.g + 887015 / 12288897.f * c.b,
          (1425312 / 73733382.f * c.r + 8788810 / 73733382.f * c.g + 70074185 / 73733382.f * c.b) / kWhiteZ};
}

/// The inverse of relative_xyz.
inline Rgb rgb_of_relative_xyz(Tristimulus c) {
  const float x = c.x * 0.950428545f, z = c.z * 1.088900371f;
  return {3.241003275f * x - 1.537398934f * c.y - 0.498615861f * z, -0.969224334f * x + 1.875930071f * c.y + 0.041554224f * z,
          0.055639423f * x - 0.204011202f * c.y + 1.057148933f * z};
}

/// Opponent space YCxCz, the linear form of L*a*b* [Flohr et al. 1993]: sharpness is seen in it.
inline Tristimulus ycxcz(Rgb c) {
  const Tristimulus t = relative_xyz(c);
  return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}
inline Rgb rgb_of_ycxcz(Tristimulus c) {
  const float y = (c.x + 16) / 116;
  return rgb_of_relative_xyz({y + c.y / 500, y, y - c.z / 200});
}

/// CIE L*a*b* with a* and b* scaled by L*/100: colours look paler in the dark [Hunt 1952].
inline Tristimulus hunt_lab(Rgb c) {
  const auto f = [](float t) {
    constexpr float kDelta = 6.0f / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29;
  };
  const Tristimulus t = relative_xyz(c);
  const float fx = f(t.x), fy = f(t.y), fz = f(t.z), lightness = 116 * fy - 16;
  return {lightness, 0.01f * lightness * 500 * (fx - fy), 0.01f * lightness * 200 * (fy - fz)};
}

/// HyAB, for large differences [Abasi et al. 2020]: city block in lightness, Euclidean in chroma.
inline float hyab(Tristimulus a, Tristimulus b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

}  // namespace tyndall
