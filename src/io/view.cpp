#include <array>

#include "tyndall/image_format.h"

namespace tyndall {
namespace {

float clamped(float x) { return x > 0 ? std::min(x, 1.0f) : 0.0f; }  // NaN too

/// [IEC 61966-2-1], of x in [0, 1].
float srgb_curve(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f; }

// ------------------------------------------------------------------------------------------------ filmic

/// [Hable 2010]: shoulder A, linear strength B and angle C, toe strength D, numerator E and denominator F.
float hable(float x) {
  constexpr float A = 0.15f, B = 0.50f, C = 0.10f, D = 0.20f, E = 0.02f, F = 0.30f;
  return (x * (A * x + C * B) + D * E) / (x * (A * x + B) + D * F) - E / F;
}

float filmic(float x) {
  constexpr float kBias = 2, kWhite = 11.2f;
  return hable(kBias * std::max(x, 0.0f)) / hable(kWhite);
}

// --------------------------------------------------------------------------------------------------- AgX

using Rows = std::array<std::array<float, 3>, 3>;

Rgb operator*(const Rows& m, Rgb c) {
  const auto row = [&](std::size_t i) { return m[i][0] * c.r + m[i][1] * c.g + m[i][2] * c.b; };
  return {row(0), row(1), row(2)};
}

constexpr Rows kInset{{{0.842479062253094f, 0.0784335999999992f, 0.0792237451477643f},
                       {0.0423282422610123f, 0.878468636469772f, 0.0791661274605434f},
                       {0.0423756549057051f, 0.0784336f, 0.879142973793104f}}};
constexpr Rows kOutset{{{1.19687900512017f, -0.0980208811401368f, -0.0990297440797205f},
                        {-0.0528968517574562f, 1.15190312990417f, -0.0989611768448433f},
                        {-0.0529716355144438f, -0.0980434501171241f, 1.15107367264116f}}};

/// The sigmoid of AgX over its logarithmic range, in [0, 1] [Wrensch 2023].
float agx_contrast(float x) {
  const float x2 = x * x, x4 = x2 * x2;
  return 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 + 0.1191f * x - 0.00232f;
}

/// Values for a display of gamma 2.2, which stands for sRGB's here as in the source.
Rgb agx(Rgb light) {
  constexpr float kLowest = -12.47393f, kHighest = 4.026069f;  // log2 of light
  Rgb c = kInset * Rgb(std::max(light.r, 0.0f), std::max(light.g, 0.0f), std::max(light.b, 0.0f));
  for (int i = 0; i < 3; ++i) {
    const float stops = std::clamp(std::log2(std::max(c[i], 1e-10f)), kLowest, kHighest);
    c[i] = agx_contrast((stops - kLowest) / (kHighest - kLowest));
  }
  return kOutset * c;
}

}  // namespace

Rgb displayed(Rgb light, DisplayView view) {
  for (int i = 0; i < 3; ++i)
    if (std::isnan(light[i])) light[i] = 0;
  if (view == DisplayView::agx) {
    const Rgb c = agx({std::min(light.r, 1e30f), std::min(light.g, 1e30f), std::min(light.b, 1e30f)});
    return {clamped(c.r), clamped(c.g), clamped(c.b)};
  }
  Rgb shown;
  for (int i = 0; i < 3; ++i)
    shown[i] = srgb_curve(clamped(view == DisplayView::filmic ? filmic(std::min(light[i], 1e10f)) : light[i]));
  return shown;
}

const std::vector<std::string_view>& view_names() {
  static const std::vector<std::string_view> kNames{"srgb", "filmic", "agx"};
  return kNames;
}

}  // namespace tyndall
