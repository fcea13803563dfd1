#include "texture/noise_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/perlin_noise.h"
#include "math/smoothstep.h"

namespace tyndall {
namespace {

constexpr float kLacunarity = 1.99f;  // not 2, so that the lattices of octaves do not fall together

/// A point of texture space, and how far it moves for a pixel.
struct NoisePoint {
  Vec3 p;
  float squared_width = 0;

  NoisePoint operator*(float s) const { return {p * s, squared_width * s * s}; }
};

NoisePoint noise_point(const NoiseTexture& texture, const TextureQuery& query) {
  NoisePoint point{texture.to_texture.point(query.p)};
  if (const Footprint* f = query.footprint)
    point.squared_width =
        std::max(length_squared(texture.to_texture.vector(f->dpdx)), length_squared(texture.to_texture.vector(f->dpdy)));
  return point;
}

/// Octaves whose wavelength is at least two footprints [PBR book 3rd ed., eq. 10.6 and 10.6.3].
float octaves_seen(const NoisePoint& point, int octaves) {
  const auto most = static_cast<float>(octaves);
  return std::clamp(-1 - 0.5f * std::log2(point.squared_width), 0.0f, most);
}

/// Fractional Brownian motion: sum of omega^i noise(1.99^i p); the last octave fades in [PBR book 3rd ed., 10.6.3].
float fbm(const NoisePoint& point, float omega, int octaves) {
  const float seen = octaves_seen(point, octaves), whole = std::floor(seen);
  float sum = 0, lambda = 1, weight = 1;
  for (int i = 0; i < static_cast<int>(whole); ++i) {
    sum += weight * perlin_noise(point.p * lambda);
    lambda *= kLacunarity;
    weight *= omega;
  }
  return sum + weight * smoothstep(0.3f, 0.7f, seen - whole) * perlin_noise(point.p * lambda);
}

/// The same of |noise|, whose mean is not 0: dropped octaves leave 0.2 [PBR book 3rd ed., 10.6.3]. As in pbrt the octave
/// that fades counts once more among those.
float turbulence(const NoisePoint& point, float omega, int octaves) {
  constexpr float kMean = 0.2f;
  const float seen = octaves_seen(point, octaves), whole = std::floor(seen);
  float sum = 0, lambda = 1, weight = 1;
  for (int i = 0; i < static_cast<int>(whole); ++i) {
    sum += weight * std::abs(perlin_noise(point.p * lambda));
    lambda *= kLacunarity;
    weight *= omega;
  }
  const float fade = smoothstep(0.3f, 0.7f, seen - whole);
  sum += weight * ((1 - fade) * kMean + fade * std::abs(perlin_noise(point.p * lambda)));
  for (int i = static_cast<int>(whole); i < octaves; ++i) {
    sum += weight * kMean;
    weight *= omega;
  }
  return sum;
}

/// Waves that a slower noise, the wind, raises [PBR book 3rd ed., 10.6.4].
float windy(const NoisePoint& point) { return std::abs(fbm(point * 0.1f, 0.5f, 3)) * fbm(point, 0.5f, 6); }

/// Layers along y, bent by fbm and coloured by pieces of cubic Bezier curves [PBR book 3rd ed., 10.6.5].
Rgb marble(const NoiseTexture& texture, const NoisePoint& point) {
  constexpr std::array<std::array<float, 3>, 9> kColors{{{0.58f, 0.58f, 0.6f},
                                                         {0.58f, 0.58f, 0.6f},
                                                         {0.58f, 0.58f, 0.6f},
                                                         {0.5f, 0.5f, 0.5f},
                                                         {0.6f, 0.59f, 0.58f},
                                                         {0.58f, 0.58f, 0.6f},
                                                         {0.58f, 0.58f, 0.6f},
                                                         {0.2f, 0.2f, 0.33f},
                                                         {0.58f, 0.58f, 0.6f}}};
  constexpr int kPieces = static_cast<int>(kColors.size()) - 3;
  constexpr float kGain = 1.5f;
  const NoisePoint scaled = point * texture.scale;
  const float layer = scaled.p.y + texture.variation * fbm(scaled, texture.roughness, texture.octaves);
  const float along = (0.5f + 0.5f * std::sin(layer)) * kPieces;
  const int piece = std::clamp(static_cast<int>(std::floor(along)), 0, kPieces - 1);
  const float t = along - static_cast<float>(piece), r = 1 - t;
  const std::array<float, 4> weight{r * r * r, 3 * r * r * t, 3 * r * t * t, t * t * t};
  Rgb color;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& c = kColors[static_cast<std::size_t>(piece) + i];
    color += kGain * weight[i] * Rgb(c[0], c[1], c[2]);
  }
  return clamp(color, 0, 1);
}

}  // namespace

Rgb noise_texture(const NoiseTexture& texture, const TextureQuery& query) {
  const NoisePoint point = noise_point(texture, query);
  switch (texture.kind) {
    case NoiseTexture::Kind::fbm:
      return Rgb(fbm(point, texture.roughness, texture.octaves));
    case NoiseTexture::Kind::wrinkled:
      return Rgb(turbulence(point, texture.roughness, texture.octaves));
    case NoiseTexture::Kind::windy:
      return Rgb(windy(point));
    case NoiseTexture::Kind::marble:
      break;
  }
  return marble(texture, point);
}

}  // namespace tyndall
