#include "texture/texel_image.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/cie.h"
#include "tyndall/error.h"
#include "tyndall/frames.h"
#include "tyndall/io.h"

namespace tyndall {
namespace {

constexpr int kOutside = -1;

int wrapped(int i, int n, TexelImage::Wrap wrap) {
  if (i >= 0 && i < n) return i;
  if (wrap == TexelImage::Wrap::black) return kOutside;
  if (wrap == TexelImage::Wrap::clamp) return i < 0 ? 0 : n - 1;
  if (wrap == TexelImage::Wrap::octahedral) return i;  // folded() needs both axes
  return i < 0 ? i + n : i - n;
}

using Texel = TexelPlace;

/// Beyond an edge of the octahedral square one comes in again through the same edge, mirrored about its middle. Columns and
/// rows below 0 are turned as pbrt-v4 turns them: -1 becomes 1.
Texel folded(int x, int y, int width, int height) {
  if (x < 0 || x >= width) {
    x = x < 0 ? -x : 2 * width - 1 - x;
    y = height - 1 - y;
  }
  if (y < 0 || y >= height) {
    x = width - 1 - x;
    y = y < 0 ? -y : 2 * height - 1 - y;
  }
  return {std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1)};
}

/// Coordinate brought to where one period is at most a texel away, so that it fits an int; NaN and infinity to 0.
float tamed(float s, TexelImage::Wrap wrap) {
  if (!std::isfinite(s)) return 0;
  return wrap == TexelImage::Wrap::repeat ? s - std::floor(s) : std::clamp(s, -1.0f, 2.0f);
}

/// The two texels along one axis between whose centres a coordinate lies, and its fraction toward the second.
struct Taps {
  int first, second;
  float t;
};

Taps taps(float s, int n, TexelImage::Wrap wrap) {
  const float x = tamed(s, wrap) * static_cast<float>(n) - 0.5f;
  const float below = std::floor(x);
  const int i = static_cast<int>(below);
  return {wrapped(i, n, wrap), wrapped(i + 1, n, wrap), x - below};
}

int holder(float s, int n, TexelImage::Wrap wrap) {
  return wrapped(static_cast<int>(std::floor(tamed(s, wrap) * static_cast<float>(n))), n, wrap);
}

/// The texel that holds st; nothing where black is.
std::optional<Texel> holder(Vec2 st, int width, int height, TexelImage::Wrap wrap) {
  const int x = holder(st.x, width, wrap), y = holder(st.y, height, wrap);
  if (wrap == TexelImage::Wrap::octahedral) return folded(x, y, width, height);
  if (x == kOutside || y == kOutside) return std::nullopt;
  return Texel{x, y};
}

/// Weighted sum of the four texels around st; `get(x, y)` is called for those inside.
template <class Value, class Get>
Value interpolated(Vec2 st, int width, int height, TexelImage::Wrap wrap, const Get& get) {
  const Taps h = taps(st.x, width, wrap), v = taps(st.y, height, wrap);
  Value sum{};
  const auto add = [&](int x, int y, float weight) {
    if (wrap == TexelImage::Wrap::octahedral) {
      const Texel texel = folded(x, y, width, height);
      x = texel.x, y = texel.y;
    }
    if (x != kOutside && y != kOutside) sum = sum + get(x, y) * weight;
  };
  add(h.first, v.first, (1 - h.t) * (1 - v.t));
  add(h.second, v.first, h.t * (1 - v.t));
  add(h.first, v.second, (1 - h.t) * v.t);
  add(h.second, v.second, h.t * v.t);
  return sum;
}

/// The three planes to read; all the same for a grey image.
std::array<const Channel*, 3> color_planes(const Image& image, const std::string& path) {
  const std::array<const Channel*, 3> rgb{image.find("R"), image.find("G"), image.find("B")};
  if (rgb[0] && rgb[1] && rgb[2]) return rgb;
  const Channel* grey = image.find("Y");
  if (!grey && image.channels.size() == 1) grey = &image.channels.front();
  if (!grey)
    throw Error(Failure::scene, path + ": has neither channels R, G, B nor Y; give an image that has one of these sets");
  return {grey, grey, grey};
}

void require_finite(const std::array<const Channel*, 3>& planes, int width, const std::string& path) {
  for (const Channel* plane : planes) {
    const auto& v = plane->values;
    const auto bad = [](float x) { return !std::isfinite(x); };
    const auto first = std::find_if(v.begin(), v.end(), bad);
    if (first == v.end()) continue;
    const auto at = static_cast<std::size_t>(first - v.begin()), w = static_cast<std::size_t>(width);
    throw Error(Failure::scene, path + ": " + std::to_string(std::count_if(first, v.end(), bad)) + " values of channel " +
                                    plane->name + " are NaN or infinite, the first at pixel " + std::to_string(at % w) + ", " +
                                    std::to_string(at / w) + "; repair the image");
  }
}

}  // namespace

TexelImage::TexelImage(int width, int height, std::vector<Rgb> texels, std::vector<float> alpha)
    : width_(width), height_(height), texels_(std::move(texels)), alpha_(std::move(alpha)) {}

TexelImage TexelImage::from(const Image& image, const std::string& path) {
  const auto planes = color_planes(image, path);
  require_finite(planes, image.width(), path);
  std::vector<Rgb> texels(planes[0]->values.size());
  for (std::size_t i = 0; i < texels.size(); ++i)
    for (int c = 0; c < 3; ++c) texels[i][c] = planes[static_cast<std::size_t>(c)]->values[i];

  std::vector<float> alpha;
  // pbrt-v4 has none of grey images.
  const Channel* a = planes[0] != planes[1] ? image.find("A") : nullptr;
  if (a && std::any_of(a->values.begin(), a->values.end(), [](float x) { return x != 1.0f; })) alpha = a->values;
  return {image.width(), image.height(), std::move(texels), std::move(alpha)};
}

TexelImage TexelImage::load(const std::string& path, const std::string& encoding, const std::array<float, 9>& to_rec709) {
  const Image image = read_image(path, encoding);
  TexelImage result = from(image, path);
  for (Rgb& texel : result.texels_) texel = positive_part(texel);
  const auto matrix = image.chromaticities ? rec709_from(*image.chromaticities, false) : to_rec709;
  if (matrix != kIdentity)
    for (Rgb& texel : result.texels_) texel = transformed(matrix, texel);
  return result;
}

std::shared_ptr<const TexelImage> TexelImage::load(KeptFiles* kept, const std::string& path,
                                                   const std::array<float, 9>& to_rec709) {
  const std::string details(reinterpret_cast<const char*>(to_rec709.data()), sizeof to_rec709);
  return get_kept<TexelImage>(kept, {path, "light", details}, [&] { return load(path, "", to_rec709); });
}

std::optional<TexelPlace> TexelImage::place(int x, int y, Wrap wrap) const {
  const auto inside = [](int i, int n) { return i >= 0 && i < n; };
  if (inside(x, width_) && inside(y, height_)) return TexelPlace{x, y};
  const auto period = [](int i, int n) { return (i % n + n) % n; };
  switch (wrap) {
    case Wrap::black:
      return std::nullopt;
    case Wrap::clamp:
      return TexelPlace{std::clamp(x, 0, width_ - 1), std::clamp(y, 0, height_ - 1)};
    case Wrap::octahedral:
      return folded(x, y, width_, height_);
    case Wrap::repeat:
      break;
  }
  return TexelPlace{period(x, width_), period(y, height_)};
}

Vec2 TexelImage::tamed(Vec2 st, Wrap wrap) { return {tyndall::tamed(st.x, wrap), tyndall::tamed(st.y, wrap)}; }

Rgb TexelImage::nearest(Vec2 st, Wrap wrap) const {
  const auto held = holder(st, width_, height_, wrap);
  return held ? texel(held->x, held->y) : Rgb();
}

Rgb TexelImage::bilinear(Vec2 st, Wrap wrap) const {
  return interpolated<Rgb>(st, width_, height_, wrap, [this](int x, int y) { return texel(x, y); });
}

float TexelImage::bilinear_alpha(Vec2 st, Wrap wrap) const {
  return interpolated<float>(st, width_, height_, wrap, [this](int x, int y) { return alpha(x, y); });
}

Rgb TexelImage::average() const {
  double sum[3] = {};
  for (const Rgb& t : texels_)
    for (int c = 0; c < 3; ++c) sum[c] += t[c];
  const double n = std::max<double>(1, static_cast<double>(texels_.size()));
  return {static_cast<float>(sum[0] / n), static_cast<float>(sum[1] / n), static_cast<float>(sum[2] / n)};
}

}  // namespace tyndall
