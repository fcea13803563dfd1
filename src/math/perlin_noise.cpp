#include "math/perlin_noise.h"

#include <array>
#include <cmath>

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

/// Dot product of the offset with one of 12 edge directions (4 of them twice) chosen by the lattice point.
float gradient(int x, int y, int z, Vec3 d) {
  const int h = permuted(permuted(permuted(x) + y) + z) & 15;
  const float u = h < 8 || h == 12 || h == 13 ? d.x : d.y;
  const float v = h < 4 || h == 12 || h == 13 ? d.y : d.z;
  return ((h & 1) ? -u : u) + ((h & 2) ? -v : v);
}

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
float mix(float t, float a, float b) { return (1 - t) * a + t * b; }

}  // namespace

float perlin_noise(Vec3 p) {
  // Beyond 2^24 a float has no fraction left; keep the conversion to int defined there.
  constexpr float kPeriod = 1 << 24;
  const float x = std::fmod(p.x, kPeriod), y = std::fmod(p.y, kPeriod), z = std::fmod(p.z, kPeriod);
  const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y)), iz = static_cast<int>(std::floor(z));
  const float dx = x - static_cast<float>(ix), dy = y - static_cast<float>(iy), dz = z - static_cast<float>(iz);

  float corner[8];
  for (int i = 0; i < 8; ++i) {
    const int a = i & 1, b = i >> 1 & 1, c = i >> 2;
    const Vec3 offset{dx - static_cast<float>(a), dy - static_cast<float>(b), dz - static_cast<float>(c)};
    corner[i] = gradient((ix & 255) + a, (iy & 255) + b, (iz & 255) + c, offset);
  }
  const float wx = fade(dx), wy = fade(dy), wz = fade(dz);
  const float y0 = mix(wy, mix(wx, corner[0], corner[1]), mix(wx, corner[2], corner[3]));
  const float y1 = mix(wy, mix(wx, corner[4], corner[5]), mix(wx, corner[6], corner[7]));
  return mix(wz, y0, y1);
}

}  // namespace tyndall
