#include "example/plume.h"

#include <cmath>

#include "math/hash.h"
#include "math/parallel.h"
#include "math/smoothstep.h"

namespace tyndall {
namespace {

float smooth(float t) { return t * t * t * (t * (6 * t - 15) + 10); }

/// Gradient noise over the integer lattice [Perlin 1985], in about [-1, 1]; gradients by hash, so it never repeats.
float noise(Vec3 p, std::uint64_t seed) {
  const Vec3 cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)}, f = p - cell;
  const auto corner = [&](int i) {
    const Vec3 offset{static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2)};
    const auto at = [&](int k) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(cell[k] + offset[k])); };
    const std::uint64_t h =
        mix_bits(at(0) * 0x9e3779b97f4a7c15ull + at(1) * 0xc2b2ae3d27d4eb4full + at(2) * 0x165667b19e3779f9ull + seed);
    const auto component = [&](int shift) { return static_cast<float>(h >> shift & 0xffff) * 0x1p-15f - 1; };
    return dot(Vec3{component(0), component(16), component(32)}, f - offset);
  };
  const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
  const float u = smooth(f.x), v = smooth(f.y), w = smooth(f.z);
  const auto plane = [&](int z) { return mix(mix(corner(z), corner(z + 1), u), mix(corner(z + 2), corner(z + 3), u), v); };
  return mix(plane(0), plane(4), w);
}

/// Sum of octaves; with `billow` of their magnitudes, which makes round puffs with creases between them.
float octaves(Vec3 p, int count, bool billow, std::uint64_t seed) {
  float sum = 0, weight = 0.5f;
  for (int i = 0; i < count; ++i, weight *= 0.5f, p = p * 2.03f) {
    const float n = noise(p, seed + static_cast<std::uint64_t>(i));
    sum += weight * (billow ? 2 * std::abs(n) - 0.45f : n);
  }
  return sum;
}

float density(Vec3 p, std::uint64_t seed) {
  const float radius = plume_radius(p.y), from_axis = length(p - plume_axis(p.y));
  if (p.y < 0 || p.y > kPlumeHeight + 0.4f || from_axis > 1.75f * radius + 0.1f) return 0;
  // Warped by slow turbulence, then puffs whose size grows with the plume.
  const Vec3 slow = p * 1.3f;
  const Vec3 warped = p + Vec3{octaves(slow, 2, false, seed + 16), octaves(slow, 2, false, seed + 32) * 0.6f,
                               octaves(slow, 2, false, seed + 48)} *
                              (0.55f * radius);
  const Vec3 puff_space = warped * (1.0f / (0.3f + 0.22f * p.y));
  const float puffs = octaves(puff_space, 5, true, seed);
  const float cap = p.y > kPlumeHeight - 0.9f ? (p.y - (kPlumeHeight - 0.9f)) / 0.9f : 0;
  const float depth = 1 - length(warped - plume_axis(p.y)) / radius - cap * cap + 0.75f * puffs;  // > 0: inside
  const float thinning = 1 / (1 + 0.35f * p.y);
  return smoothstep(0, 0.35f, depth) * thinning * smoothstep(0, 0.12f, p.y);
}

}  // namespace

Vec3 plume_axis(float y) { return {0.16f * std::sin(1.5f * y) * y * 0.4f, y, 0.12f * std::sin(1.1f * y + 1) * y * 0.3f}; }

float plume_radius(float y) {
  const float stem = 0.2f + 0.11f * y, head = 0.62f * std::exp(-(y - 3.5f) * (y - 3.5f) / 0.8f);
  return stem + head;
}

FogGrid smoke_plume(std::uint64_t seed) {
  FogGrid grid{.nx = 128, .ny = 176, .nz = 128, .voxel_size = 0.0275f, .origin = {-1.75f, 0, -1.75f}};
  grid.values.resize(static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny) * static_cast<std::size_t>(grid.nz));
  const auto nx = static_cast<std::size_t>(grid.nx), ny = static_cast<std::size_t>(grid.ny);
  ThreadPool(0).for_each(ny * static_cast<std::size_t>(grid.nz), 8, [&](std::size_t row) {
    const Vec3 start = grid.origin + Vec3{0, static_cast<float>(row % ny), static_cast<float>(row / ny)} * grid.voxel_size;
    for (std::size_t x = 0; x < nx; ++x) {
      const float d = density(start + Vec3{static_cast<float>(x) * grid.voxel_size, 0, 0}, hash(seed));
      grid.values[row * nx + x] = std::round(d * 512) / 512;  // few digits: half the size once compressed
    }
  });
  return grid;
}

}  // namespace tyndall
