#include "texture/textures.h"

#include <algorithm>
#include <cmath>

#include "math/cie.h"
#include "math/perlin_noise.h"
#include "texture/noise_texture.h"

namespace tyndall {
namespace {

bool is_odd(float x) {
  const float f = std::floor(x);
  return f - 2 * std::floor(f * 0.5f) != 0;
}

/// The pattern's value at a point. pbrt-v4 filters it over the pixel; many samples a pixel converge to the same.
TextureId checker(const CheckerboardTexture& texture, const TextureQuery& query) {
  bool odd;
  if (texture.dimension == 3) {
    const Vec3 q = texture.mapping.to_texture.point(query.p);
    odd = (is_odd(q.x) != is_odd(q.y)) != is_odd(q.z);
  } else {
    const Vec2 st = map_to_texture(texture.mapping, query);
    odd = is_odd(st.x) != is_odd(st.y);
  }
  return odd ? texture.second : texture.first;
}

float flat_noise(float s, float t) { return perlin_noise({s, t, 0.5f}); }

/// In the cells where noise is positive a disc of radius 0.35 stands, moved by noise within its cell [PBR book 3rd
/// ed., 10.6.2].
TextureId dots(const DotsTexture& texture, const TextureQuery& query) {
  constexpr float kRadius = 0.35f, kMaxShift = 0.5f - kRadius;
  const Vec2 st = map_to_texture(texture.mapping, query);
  const float s = std::floor(st.x + 0.5f), t = std::floor(st.y + 0.5f);
  if (!(flat_noise(s + 0.5f, t + 0.5f) > 0)) return texture.outside;
  const float x = st.x - (s + kMaxShift * flat_noise(s + 1.5f, t + 2.8f));
  const float y = st.y - (t + kMaxShift * flat_noise(s + 4.5f, t + 9.8f));
  return x * x + y * y < kRadius * kRadius ? texture.inside : texture.outside;
}

Rgb bilerp(const BilerpTexture& t, const TextureQuery& query) {
  const auto [u, v] = map_to_texture(t.mapping, query);
  return (1 - u) * ((1 - v) * t.v00 + v * t.v01) + u * ((1 - v) * t.v10 + v * t.v11);
}

Vec2 image_coordinates(const ImageTexture& texture, const TextureQuery& query) {
  const Vec2 st = map_to_texture(texture.mapping, query);
  return {st.x, 1 - st.y};  // v points up, rows go down
}

MipLookup mip_lookup(const ImageTexture& texture, const TextureQuery& query) {
  MipLookup at{image_coordinates(texture, query), steps_of_texture(texture.mapping, query), texture.wrap};
  for (Vec2& step : at.steps) step.y = -step.y;
  return at;
}

Rgb lookup(const MipMap& map, const ImageTexture& texture, const TextureQuery& query) {
  switch (texture.filter) {
    case ImageTexture::Filter::point:
      return map.image.nearest(image_coordinates(texture, query), texture.wrap);
    case ImageTexture::Filter::bilinear:
      break;
    case ImageTexture::Filter::trilinear:
      return trilinear(map, mip_lookup(texture, query));
    case ImageTexture::Filter::elliptical:
      return elliptical(map, mip_lookup(texture, query), texture.max_anisotropy);
  }
  return map.image.bilinear(image_coordinates(texture, query), texture.wrap);
}

/// As pbrt-v4: these two filters know the first channel alone, the others the alpha, or the mean of the colour.
float lookup_number(const MipMap& map, const ImageTexture& texture, const TextureQuery& query) {
  using Filter = ImageTexture::Filter;
  if (texture.filter == Filter::point || texture.filter == Filter::elliptical) return lookup(map, texture, query).r;
  if (!map.image.has_alpha()) return mean(lookup(map, texture, query));
  if (texture.filter == Filter::trilinear) return trilinear_alpha(map, mip_lookup(texture, query));
  return map.image.bilinear_alpha(image_coordinates(texture, query), texture.wrap);
}

}  // namespace

struct Textures::RgbEvaluator {
  const Textures& textures;
  const TextureQuery& query;

  Rgb operator()(const ConstantTexture& t) const { return t.value; }
  Rgb operator()(const ScaleTexture& t) const { return textures.eval(t.texture, query) * textures.eval_float(t.scale, query); }
  Rgb operator()(const MixTexture& t) const {
    const float amount = textures.eval_float(t.amount, query);
    return (1 - amount) * textures.eval(t.first, query) + amount * textures.eval(t.second, query);
  }
  Rgb operator()(const ImageNode& node) const {
    const ImageTexture& t = node.texture;
    Rgb c = t.scale * lookup(textures.mip_map(node), t, query);
    c = positive_part(t.invert ? Rgb(1.0f) - c : c);
    return t.to_rec709 == TexelImage::kIdentity ? c : positive_part(transformed(t.to_rec709, c));
  }
  Rgb operator()(const CheckerboardTexture& t) const { return textures.eval(checker(t, query), query); }
  Rgb operator()(const DotsTexture& t) const { return textures.eval(dots(t, query), query); }
  Rgb operator()(const BilerpTexture& t) const { return bilerp(t, query); }
  Rgb operator()(const DirectionMixTexture& t) const {
    const float amount = abs_dot(query.n, t.direction);
    return amount * textures.eval(t.first, query) + (1 - amount) * textures.eval(t.second, query);
  }
  Rgb operator()(const NoiseTexture& t) const { return noise_texture(t, query); }
};

struct Textures::FloatEvaluator {
  const Textures& textures;
  const TextureQuery& query;

  float operator()(const ConstantTexture& t) const { return mean(t.value); }
  float operator()(const ScaleTexture& t) const {
    return textures.eval_float(t.texture, query) * textures.eval_float(t.scale, query);
  }
  float operator()(const MixTexture& t) const {
    const float amount = textures.eval_float(t.amount, query);
    return (1 - amount) * textures.eval_float(t.first, query) + amount * textures.eval_float(t.second, query);
  }
  float operator()(const ImageNode& node) const {
    const ImageTexture& t = node.texture;
    const float value = t.scale * lookup_number(textures.mip_map(node), t, query);
    return t.invert ? std::max(0.0f, 1 - value) : value;
  }
  float operator()(const CheckerboardTexture& t) const { return textures.eval_float(checker(t, query), query); }
  float operator()(const DotsTexture& t) const { return textures.eval_float(dots(t, query), query); }
  float operator()(const BilerpTexture& t) const { return mean(bilerp(t, query)); }
  float operator()(const DirectionMixTexture& t) const {
    const float amount = abs_dot(query.n, t.direction);
    return amount * textures.eval_float(t.first, query) + (1 - amount) * textures.eval_float(t.second, query);
  }
  float operator()(const NoiseTexture& t) const { return mean(noise_texture(t, query)); }
};

Rgb Textures::eval(TextureId id, const TextureQuery& query) const { return std::visit(RgbEvaluator{*this, query}, nodes_[id]); }

float Textures::eval_float(TextureId id, const TextureQuery& query) const {
  return std::visit(FloatEvaluator{*this, query}, nodes_[id]);
}

std::optional<Rgb> Textures::constant(TextureId id) const {
  if (const auto* t = std::get_if<ConstantTexture>(&nodes_[id])) return t->value;
  return {};
}

std::size_t Textures::memory_bytes() const {
  std::size_t sum = 0;
  for (const auto& image : images_) sum += image->memory_bytes();
  for (const auto& levels : coarser_)
    for (const TexelImage& level : levels) sum += level.memory_bytes();
  return sum;
}

}  // namespace tyndall
