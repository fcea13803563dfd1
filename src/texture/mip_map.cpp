#include "texture/mip_map.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// The two things that are looked up, by one code.
struct ColorOf {
  using Value = Rgb;
  static Rgb bilinear(const TexelImage& image, Vec2 st, TexelImage::Wrap wrap) { return image.bilinear(st, wrap); }
  static Rgb texel(const TexelImage& image, int x, int y) { return image.texel(x, y); }
};
struct AlphaOf {
  using Value = float;
  static float bilinear(const TexelImage& image, Vec2 st, TexelImage::Wrap wrap) { return image.bilinear_alpha(st, wrap); }
  static float texel(const TexelImage& image, int x, int y) { return image.alpha(x, y); }
};

int levels(const MipMap& map) { return 1 + static_cast<int>(map.coarser.size()); }
const TexelImage& level(const MipMap& map, int i) { return i == 0 ? map.image : map.coarser[static_cast<std::size_t>(i - 1)]; }

/// The level whose texels have that width; the last one is one texel.
float level_of(const MipMap& map, float width) {
  return std::log2(std::max(width, 1e-8f)) + static_cast<float>(levels(map) - 1);
}

template <typename Of>
typename Of::Value trilinear_of(const MipMap& map, const MipLookup& at) {
  float widest = 0;
  for (const Vec2& step : at.steps) widest = std::max({widest, std::abs(step.x), std::abs(step.y)});
  const float exact = level_of(map, 2 * widest);
  if (!(exact > 0)) return Of::bilinear(map.image, at.st, at.wrap);
  if (exact >= static_cast<float>(levels(map) - 1)) return Of::texel(level(map, levels(map) - 1), 0, 0);
  const int below = static_cast<int>(exact);
  const float t = exact - static_cast<float>(below);
  if (below == 0) return Of::bilinear(map.image, at.st, at.wrap);  // pbrt blends from level 1 on
  return Of::bilinear(level(map, below), at.st, at.wrap) * (1 - t) + Of::bilinear(level(map, below + 1), at.st, at.wrap) * t;
}

/// The ellipse A x^2 + B x y + C y^2 < 1 that steps (x0,y0), (x1,y1) in texels span, a texel wider [Heckbert 1989].
struct Ellipse {
  float a, b, c;

  Ellipse(Vec2 s0, Vec2 s1) {
    a = s0.y * s0.y + s1.y * s1.y + 1;
    b = -2 * (s0.x * s0.y + s1.x * s1.y);
    c = s0.x * s0.x + s1.x * s1.x + 1;
    const float f = 1 / (a * c - b * b * 0.25f);
    a *= f, b *= f, c *= f;
  }
  float half_width() const { return 2 * std::sqrt(c / (4 * a * c - b * b)); }
  float half_height() const { return 2 * std::sqrt(a / (4 * a * c - b * b)); }
  float squared_radius(float x, float y) const { return a * x * x + b * x * y + c * y * y; }
};

/// exp(-2 r^2), brought to 0 at r = 1.
float gaussian(float squared_radius) { return std::exp(-2 * squared_radius) - std::exp(-2.0f); }

Rgb averaged_over_ellipse(const TexelImage& image, const MipLookup& at, Vec2 s0, Vec2 s1) {
  const auto width = static_cast<float>(image.width()), height = static_cast<float>(image.height());
  const Ellipse ellipse({s0.x * width, s0.y * height}, {s1.x * width, s1.y * height});
  const Vec2 st = TexelImage::tamed(at.st, at.wrap);
  const float x = st.x * width - 0.5f, y = st.y * height - 0.5f;
  const int x0 = static_cast<int>(std::ceil(x - ellipse.half_width())),
            x1 = static_cast<int>(std::floor(x + ellipse.half_width()));
  const int y0 = static_cast<int>(std::ceil(y - ellipse.half_height())),
            y1 = static_cast<int>(std::floor(y + ellipse.half_height()));
  Rgb sum;
  float weights = 0;
  for (int iy = y0; iy <= y1; ++iy) {
    for (int ix = x0; ix <= x1; ++ix) {
      const float r2 = ellipse.squared_radius(static_cast<float>(ix) - x, static_cast<float>(iy) - y);
      if (!(r2 < 1)) continue;
      const float weight = gaussian(r2);
      weights += weight;
      if (const auto place = image.place(ix, iy, at.wrap)) sum = sum + image.texel(place->x, place->y) * weight;
    }
  }
  return weights > 0 ? sum * (1 / weights) : image.bilinear(at.st, at.wrap);
}

/// Which texels of a row of `from` a texel of a row of `to` covers: `from` >= `to`.
struct Cover {
  int first, last;
  float first_part, last_part;
};
Cover cover(int i, int from, int to) {
  const double begin = static_cast<double>(i) * from / to, end = static_cast<double>(i + 1) * from / to;
  const int first = static_cast<int>(begin), last = std::min(static_cast<int>(std::ceil(end)) - 1, from - 1);
  if (first == last) return {first, last, static_cast<float>(end - begin), 0};
  return {first, last, static_cast<float>(first + 1 - begin), static_cast<float>(end - last)};
}
float part(const Cover& c, int k) { return k == c.first ? c.first_part : k == c.last ? c.last_part : 1.0f; }

TexelImage halved(const TexelImage& image) {
  const int width = std::max(1, image.width() / 2), height = std::max(1, image.height() / 2);
  std::vector<Rgb> texels;
  std::vector<float> alpha;
  for (int y = 0; y < height; ++y) {
    const Cover v = cover(y, image.height(), height);
    for (int x = 0; x < width; ++x) {
      const Cover h = cover(x, image.width(), width);
      Rgb sum;
      float opacity = 0, area = 0;
      for (int iy = v.first; iy <= v.last; ++iy) {
        for (int ix = h.first; ix <= h.last; ++ix) {
          const float weight = part(v, iy) * part(h, ix);
          sum = sum + image.texel(ix, iy) * weight;
          opacity += image.alpha(ix, iy) * weight;
          area += weight;
        }
      }
      texels.push_back(sum * (1 / area));
      if (image.has_alpha()) alpha.push_back(opacity / area);
    }
  }
  return {width, height, std::move(texels), std::move(alpha)};
}

}  // namespace

std::vector<TexelImage> coarser_levels(const TexelImage& image) {
  std::vector<TexelImage> levels;
  for (const TexelImage* last = &image; last->width() > 1 || last->height() > 1; last = &levels.back())
    levels.push_back(halved(*last));
  return levels;
}

Rgb trilinear(const MipMap& map, const MipLookup& at) { return trilinear_of<ColorOf>(map, at); }
float trilinear_alpha(const MipMap& map, const MipLookup& at) { return trilinear_of<AlphaOf>(map, at); }

Rgb elliptical(const MipMap& map, const MipLookup& at, float max_anisotropy) {
  Vec2 s0 = at.steps[0], s1 = at.steps[1];
  const auto length_of = [](Vec2 v) { return std::hypot(v.x, v.y); };
  if (length_of(s0) < length_of(s1)) std::swap(s0, s1);
  float shorter = length_of(s1);
  if (!(shorter > 0) || !std::isfinite(length_of(s0))) return map.image.bilinear(at.st, at.wrap);
  if (const float longer = length_of(s0); shorter * max_anisotropy < longer) {
    const float scale = longer / (shorter * max_anisotropy);
    s1 = {s1.x * scale, s1.y * scale};
    shorter *= scale;
  }
  const float exact = std::clamp(level_of(map, shorter), 0.0f, static_cast<float>(levels(map)));
  const int below = static_cast<int>(exact);
  const auto in_level = [&](int i) {
    return i >= levels(map) ? level(map, levels(map) - 1).texel(0, 0) : averaged_over_ellipse(level(map, i), at, s0, s1);
  };
  if (below >= levels(map)) return in_level(below);
  const float t = exact - static_cast<float>(below);
  return t == 0 ? in_level(below) : in_level(below) * (1 - t) + in_level(below + 1) * t;
}

}  // namespace tyndall
