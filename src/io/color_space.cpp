#include "io/color.h"
#include "math/cie.h"

namespace tyndall {
namespace {

struct Definition {
  ColorSpaceId id;
  std::string_view name;
  Xy red, green, blue, white;
};
constexpr Xy kAcesWhite{0.3216786, 0.3376712};  // of illum-acesD60 and the observer in math/cie.h
constexpr Definition kDefinitions[] = {
    {ColorSpaceId::srgb, "srgb", {0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65},
    {ColorSpaceId::rec2020, "rec2020", {0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kD65},
    {ColorSpaceId::aces2065_1, "aces2065-1", {0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.0770}, kAcesWhite},
    {ColorSpaceId::dci_p3, "dci-p3", {0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kD65},
};

Vec2 to_vec2(Xy c) { return {static_cast<float>(c.x), static_cast<float>(c.y)}; }

ColorSpace make(const Definition& d) {
  ColorSpace space{d.id, to_float(kIdentity3), to_float(kIdentity3), {}, to_float(kIdentity3)};
  if (d.id == ColorSpaceId::srgb) return space;
  const Matrix3 to_xyz = xyz_from_rgb(d.red, d.green, d.blue, d.white);
  const Matrix3 to_709 = rec709_from_xyz() * to_xyz;
  space.to_rec709 = to_float(to_709);
  space.from_rec709 = to_float(inverse(to_709));
  space.reflectance_to_rec709 = to_float(rec709_from_xyz() * adapt_white(d.white, kD65) * to_xyz);
  const Vec2 white = d.id == ColorSpaceId::aces2065_1 ? Vec2{0.32168f, 0.33767f} : Chromaticities{}.white;  // as files say
  space.chromaticities = {to_vec2(d.red), to_vec2(d.green), to_vec2(d.blue), white};
  return space;
}

}  // namespace

const ColorSpace* find_color_space(std::string_view name) {
  static const std::array<ColorSpace, 4> kSpaces{make(kDefinitions[0]), make(kDefinitions[1]), make(kDefinitions[2]),
                                                 make(kDefinitions[3])};
  for (std::size_t i = 0; i < kSpaces.size(); ++i)
    if (kDefinitions[i].name == name) return &kSpaces[i];
  return nullptr;
}

}  // namespace tyndall
