#include "math/perlin_noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/simd_math.h"

namespace tyndall {
namespace {

/// Ken Perlin's permutation of 0..255.
constexpr std::array<unsigned char, 256> kPermutation{
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,  69,  142, 8,   99,
    37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,  94,  252, 219, 203, 117, 35,  11,  32,
    57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136, 171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166,
    77,  146, 158, 231, 83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143, 54,
    65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196, 135, 130, 116, 188, 159, 86,
    164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124, 123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212,
    207, 206, 59,  227, 47,  16,  58,  17,  182, 189, 28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,
    221, 153, 101, 155, 167, 43,  172, 9,   129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104,
    218, 246, 97,  228, 251, 34,  242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107,
    49,  192, 214, 31,  181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,
    222, 114, 67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

int permuted(int i) { return kPermutation[static_cast<std::size_t>(i & 255)]; }

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

template <typename T>
T mix(float t, T a, T b) {
  return (1 - t) * a + t * b;
}
/// The last half of numbers for t = 1, the first for 0.
template <typename Simd>
auto mix_halves(float t, const Simd& values) {
  constexpr int kHalf = Simd::size() / 2;
  const auto [first, last] = std::experimental::split<kHalf, kHalf>(values);
  return mix(t, first, last);
}

/// Beyond 2^24 a float has no fraction left; keep the conversion to int defined there.
float within_ints(float x) {
  constexpr float kPeriod = 1 << 24;
  return std::abs(x) < kPeriod ? x : std::fmod(x, kPeriod);
}

}  // namespace

// Corner k is the farther one along x if k & 4, along y if k & 2, along z if k & 1.

/// A gradient is one of 12 edge directions, 4 of them twice: two of three coordinates, each with a sign.
NoiseCell::NoiseCell(Vec3 p)
    : corner_{std::floor(within_ints(p.x)), std::floor(within_ints(p.y)), std::floor(within_ints(p.z))} {
  const int x = static_cast<int>(corner_.x), y = static_cast<int>(corner_.y), z = static_cast<int>(corner_.z);
  const int of_x[2] = {permuted(x) + y, permuted(x + 1) + y};
  const int of_xy[4] = {permuted(of_x[0]) + z, permuted(of_x[0] + 1) + z, permuted(of_x[1]) + z, permuted(of_x[1] + 1) + z};
  const Int8 hash([&](int k) { return permuted(of_xy[k >> 1] + (k & 1)); });

  const Float8 edge = std::experimental::static_simd_cast<Float8>(hash & 15);
  const Mask8 x_and_y = abs(edge - 12.5f) < 1.0f;
  first_is_x_ = x_and_y || edge < 8.0f;
  second_is_y_ = x_and_y || edge < 4.0f;
  first_sign_ = 1.0f - std::experimental::static_simd_cast<Float8>((hash & 1) << 1);
  second_sign_ = 1.0f - std::experimental::static_simd_cast<Float8>(hash & 2);
}

bool NoiseCell::holds(Vec3 p) const {
  const Vec3 d = p - corner_;
  return std::min({d.x, d.y, d.z}) >= 0 && std::max({d.x, d.y, d.z}) < 1;
}

float NoiseCell::at(Vec3 p) const {
  const Vec3 d{within_ints(p.x) - corner_.x, within_ints(p.y) - corner_.y, within_ints(p.z) - corner_.z};
  const Float8 x([&](int k) { return k & 4 ? d.x - 1 : d.x; }), y([&](int k) { return k & 2 ? d.y - 1 : d.y; }),
      z([&](int k) { return k & 1 ? d.z - 1 : d.z; });
  const Float8 heights = first_sign_ * choose(first_is_x_, x, y) + second_sign_ * choose(second_is_y_, y, z);
  return mix_halves(fade(d.z), mix_halves(fade(d.y), mix_halves(fade(d.x), heights)))[0];
}

}  // namespace tyndall
