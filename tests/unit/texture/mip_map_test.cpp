#include "texture/mip_map.h"

#include <doctest/doctest.h>

#include <cmath>

#include "texture/mapping.h"

using namespace tyndall;

namespace {

using Wrap = TexelImage::Wrap;

template <typename Value>
TexelImage image_of(int width, int height, const Value& value, bool with_alpha = false) {
  std::vector<Rgb> texels;
  std::vector<float> alpha;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      texels.push_back(Rgb(value(x, y)));
      if (with_alpha) alpha.push_back(1 - value(x, y));
    }
  }
  return {width, height, std::move(texels), std::move(alpha)};
}

struct Filtered {
  TexelImage image;
  std::vector<TexelImage> coarser = coarser_levels(image);
  Wrap wrap = Wrap::repeat;

  float trilinear(Vec2 st, Vec2 dx, Vec2 dy) const { return tyndall::trilinear({image, coarser}, {st, {dx, dy}, wrap}).g; }
  float elliptical(Vec2 st, Vec2 dx, Vec2 dy, float anisotropy = 8) const {
    return tyndall::elliptical({image, coarser}, {st, {dx, dy}, wrap}, anisotropy).g;
  }
};

float stripes(int x, int) { return x % 2 == 0 ? 0.0f : 1.0f; }
float noise(int x, int y) { return static_cast<float>((x * 7919 + y * 104729) % 101) / 101; }

}  // namespace

TEST_CASE("levels halve down to one texel, and each has the image's mean, whatever its size") {
  for (const auto& [width, height] : {std::pair{16, 16}, {13, 5}, {1, 9}, {1, 1}}) {
    const TexelImage image = image_of(width, height, noise, true);
    const auto levels = coarser_levels(image);
    CHECK(levels.size() == static_cast<std::size_t>(std::log2(std::max(width, height))));
    for (const TexelImage& level : levels) {
      CHECK(level.average().g == doctest::Approx(image.average().g));
      CHECK(level.has_alpha());
    }
    if (!levels.empty()) {
      CHECK(levels.back().width() * levels.back().height() == 1);
      CHECK(levels.back().alpha(0, 0) == doctest::Approx(1 - image.average().g));
    }
  }
}

TEST_CASE("trilinear: bilinear below a texel, the mean far above, in between a blend that changes without steps") {
  const Filtered f{image_of(32, 32, noise)};
  const Vec2 st{0.37f, 0.81f};
  CHECK(f.trilinear(st, {0, 0}, {0, 0}) == f.image.bilinear(st, Wrap::repeat).g);
  CHECK(f.trilinear(st, {0.01f, 0}, {0, -0.01f}) == f.image.bilinear(st, Wrap::repeat).g);
  CHECK(f.trilinear(st, {3, 0}, {0, 3}) == doctest::Approx(f.image.average().g));
  // A footprint of 2 * step texels; one of exactly 4 texels is level 2's.
  CHECK(f.trilinear(st, {4.0f / 64, 0}, {}) == doctest::Approx(f.coarser[1].bilinear(st, Wrap::repeat).g));
  const float middle = f.trilinear(st, {std::sqrt(32.0f) / 64, 0}, {});
  CHECK(middle == doctest::Approx((f.coarser[1].bilinear(st, Wrap::repeat).g + f.coarser[2].bilinear(st, Wrap::repeat).g) / 2));
}

TEST_CASE("elliptical: sharp across the short axis, even along the long one") {
  const Filtered f{image_of(64, 64, stripes)};
  const Vec2 on_bright{1.5f / 64, 0.5f}, on_dark{2.5f / 64, 0.5f};
  const float step = 8.0f / 64, fine = 0.1f / 64;
  CHECK(f.elliptical(on_bright, {fine, 0}, {0, step}, 100) > f.elliptical(on_dark, {fine, 0}, {0, step}, 100) + 0.5f);
  CHECK(f.elliptical(on_bright, {step, 0}, {0, fine}, 100) == doctest::Approx(0.5).epsilon(0.02));
  CHECK(f.elliptical(on_dark, {step, step}, {-step, step}) == doctest::Approx(0.5).epsilon(0.02));
  // Little anisotropy makes it wide in both directions.
  CHECK(f.elliptical(on_bright, {fine, 0}, {0, step}, 2) == doctest::Approx(0.5).epsilon(0.05));
  CHECK(f.elliptical(on_bright, {30, 0}, {0, 30}) == doctest::Approx(0.5));
}

TEST_CASE("elliptical: a texel's own Gaussian where the footprint is a point's, bilinear where it has no width") {
  const Filtered f{image_of(8, 8, [](int x, int y) { return x == 3 && y == 4 ? 1.0f : 0.0f; })};
  const auto at = [&](float x, float y) { return f.elliptical({(x + 0.5f) / 8, (y + 0.5f) / 8}, {1e-5f, 0}, {0, 1e-5f}); };
  CHECK(at(3, 4) == doctest::Approx(1));  // neighbours are just out of reach
  CHECK(at(3.5f, 4) == doctest::Approx(0.5));
  const double w0 = std::exp(-2 * 0.0625) - std::exp(-2.0), w1 = std::exp(-2 * 0.5625) - std::exp(-2.0);
  CHECK(at(3.25f, 4) == doctest::Approx(w0 / (w0 + w1)));
  const Vec2 st{0.4f, 0.6f};
  CHECK(f.elliptical(st, {0.1f, 0}, {}) == f.image.bilinear(st, Wrap::repeat).g);
}

TEST_CASE("filters go over edges as the wrap mode says") {
  const auto left = [](int x, int) { return x < 4 ? 1.0f : 0.0f; };
  Filtered f{image_of(8, 8, left)};
  const Vec2 st{0, 0.5f}, step{0.125f, 0};
  CHECK(f.elliptical(st, step, {0, 0.125f}) == doctest::Approx(0.5).epsilon(0.01));
  f.wrap = Wrap::clamp;
  CHECK(f.elliptical(st, step, {0, 0.125f}) == doctest::Approx(1));
  f.wrap = Wrap::black;
  CHECK(f.elliptical(st, step, {0, 0.125f}) == doctest::Approx(0.5).epsilon(0.01));
  CHECK(f.trilinear({-1e30f, 7e20f}, {1e9f, 0}, {}) == doctest::Approx(0.5));
  const float nan = std::nanf("");
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::black, Wrap::octahedral}) {
    f.wrap = wrap;
    for (const Vec2 odd : {Vec2{nan, 0}, Vec2{1e30f, 1e-30f}, Vec2{-kInfinity, 0}, Vec2{1e-30f, 0}, Vec2{1e38f, 1e38f}}) {
      CHECK(std::isfinite(f.elliptical(odd, odd, {0.1f, 0.2f})));
      CHECK(std::isfinite(f.elliptical({0.3f, 0.9f}, odd, {0.1f, 0.2f})));
      CHECK(std::isfinite(f.elliptical({0.3f, 0.9f}, odd, {1e-37f, 1e-37f})));
      CHECK(std::isfinite(f.trilinear(odd, odd, {0.1f, 0.2f})));
    }
  }
}

TEST_CASE("steps of the texture follow the mapping, over the seam of its angles too") {
  Footprint footprint;
  footprint.dpdx = {0, 0.01f, 0};
  footprint.duvdx = {0.1f, 0.2f};
  footprint.duvdy = {0.3f, 0};
  TextureMapping mapping;
  mapping.scale = {2, -1};
  const auto uv = steps_of_texture(mapping, {{0.5f, 0.5f}, {1, 0, 0}, {}, &footprint});
  CHECK(uv[0].x == doctest::Approx(0.2));
  CHECK(uv[0].y == doctest::Approx(-0.2));
  CHECK(uv[1].x == doctest::Approx(0.6));
  for (const auto kind : {TextureMapping::Kind::spherical, TextureMapping::Kind::cylindrical}) {
    mapping.kind = kind;
    for (const Vec3 p : {Vec3{1, -0.005f, 0}, Vec3{-1, -0.005f, 0}}) {
      const auto steps = steps_of_texture(mapping, {{}, p, {}, &footprint});
      const Vec2 d = steps[0];
      CHECK(std::abs(kind == TextureMapping::Kind::spherical ? d.y : d.x) == doctest::Approx(0.01 / (2 * kPi)).epsilon(0.01));
    }
  }
  CHECK(steps_of_texture(mapping, {})[0].x == 0);
}
