/// The CIE 1931 2-degree standard observer, and RGB spaces given by their chromaticities.
#pragma once

#include <array>

#include "tyndall/image.h"
#include "tyndall/math.h"

namespace tyndall {

inline constexpr int kLambdaMin = 360, kLambdaMax = 830;  ///< nm, the observer's range
inline constexpr int kLambdaCount = kLambdaMax - kLambdaMin + 1;
inline constexpr double kYIntegral = 106.856895;  ///< integral of ybar over the range, nm

struct Xyz {
  double x = 0, y = 0, z = 0;
};
constexpr Xyz operator+(Xyz a, Xyz b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Xyz operator*(double s, Xyz a) { return {s * a.x, s * a.y, s * a.z}; }

/// xbar, ybar, zbar at each whole nm of the range.
const std::array<Xyz, kLambdaCount>& color_matching_functions();

/// Row-major 3x3 matrix.
using Matrix3 = std::array<double, 9>;
inline constexpr Matrix3 kIdentity3{1, 0, 0, 0, 1, 0, 0, 0, 1};
Matrix3 operator*(const Matrix3& a, const Matrix3& b);
Matrix3 inverse(const Matrix3& m);  ///< the determinant must not be 0
Xyz operator*(const Matrix3& m, Xyz v);
std::array<float, 9> to_float(const Matrix3& m);

/// A chromaticity in double precision: matrices made from rounded whites would tint a grey scene.
struct Xy {
  double x = 0, y = 0;
};
inline constexpr Xy kD65{0.3127262, 0.3290225};  ///< of the illuminant's table and the observer above

/// The linear map from RGB to XYZ that takes (1,1,1) to the white with Y = 1.
Matrix3 xyz_from_rgb(Xy red, Xy green, Xy blue, Xy white);

const Matrix3& rec709_from_xyz();
Rgb to_rec709(Xyz c);

/// The Bradford transform from one white to another: what a perfect white looks like follows the light.
Matrix3 adapt_white(Xy from, Xy to);

/// From RGB of a file with these chromaticities to Rec.709; exactly the identity when they are Rec.709's own to
/// the precision that files carry. `adapted`: for reflectances, white stays white.
std::array<float, 9> rec709_from(const Chromaticities& c, bool adapted);

/// Row-major matrix times colour.
constexpr Rgb transformed(const std::array<float, 9>& m, Rgb c) {
  return {m[0] * c.r + m[1] * c.g + m[2] * c.b, m[3] * c.r + m[4] * c.g + m[5] * c.b, m[6] * c.r + m[7] * c.g + m[8] * c.b};
}

}  // namespace tyndall
