/// Trilinear interpolation of the 9x9x9 voxels of a brick: the innermost loop of all tracking.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "math/simd_math.h"
#include "volume/affine.h"

#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>
#define TYNDALL_TRILINEAR_AVX2
#endif

namespace tyndall {

inline constexpr int kBrickCells = 8, kBrickVoxels = 9;  ///< along an edge

/// o + t d, three numbers each and one to fill.
struct Line {
  double o[4] = {}, d[4] = {};
  GridVec at(double t) const { return {{o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]}}; }
};

/// Where whole grids of less than 2^31 cells an axis, none negative, can be read.
struct CellBounds {
  double lo[4] = {}, hi[4] = {};  // coordinates, included; the last number is [0, 0]
  std::int32_t last[4] = {};      // cells; the upper face belongs to them
};

#ifdef TYNDALL_TRILINEAR_AVX2

/// A point of a brick, clamped to [0, 8]^3: the number of the voxel at the lower corner of its cell, the place inside.
class BrickPoint {
 public:
  BrickPoint(float x, float y, float z) : BrickPoint(_mm_setr_ps(x, y, z, 0)) {}
  BrickPoint(const Line& line, double t)
      : BrickPoint(_mm256_cvtpd_ps(_mm256_fmadd_pd(_mm256_set1_pd(t), _mm256_loadu_pd(line.d), _mm256_loadu_pd(line.o)))) {}

  /// Of the brick that holds the point at t of a line through a whole grid. The cell goes to `cell`. Outside of the bounds
  /// `inside` becomes false and nothing else is of use.
  BrickPoint(const Line& line, double t, const CellBounds& bounds, std::uint32_t (&cell)[3], bool& inside) {
    const __m256d p = _mm256_fmadd_pd(_mm256_set1_pd(t), _mm256_loadu_pd(line.d), _mm256_loadu_pd(line.o));
    const __m256d within = _mm256_and_pd(_mm256_cmp_pd(p, _mm256_loadu_pd(bounds.lo), _CMP_GE_OQ),
                                         _mm256_cmp_pd(p, _mm256_loadu_pd(bounds.hi), _CMP_LE_OQ));
    inside = _mm256_movemask_pd(within) == 15;
    const __m128i at = _mm_min_epi32(_mm256_cvttpd_epi32(p), _mm_loadu_si128(reinterpret_cast<const __m128i*>(bounds.last)));
    fraction_ = _mm256_cvtpd_ps(_mm256_sub_pd(p, _mm256_cvtepi32_pd(at)));
    const auto xy = static_cast<std::uint64_t>(_mm_cvtsi128_si64(at));
    cell[0] = static_cast<std::uint32_t>(xy);
    cell[1] = static_cast<std::uint32_t>(xy >> 32);
    cell[2] = static_cast<std::uint32_t>(_mm_extract_epi32(at, 2));
    corner_ = (cell[2] & 7u) * kZ + (cell[1] & 7u) * kY + (cell[0] & 7u);
  }

  float interpolate(const std::uint16_t* voxels) const {
    const auto pair = [v = voxels + corner_](int at) {
      int two;
      std::memcpy(&two, v + at, sizeof two);
      return two;
    };
    const __m128i pairs = _mm_setr_epi32(pair(0), pair(kY), pair(kZ), pair(kZ + kY));
    const __m256 all = _mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(pairs));
    return interpolate(_mm256_castps256_ps128(all), _mm256_extractf128_ps(all, 1));
  }
  float interpolate(const float* voxels) const {
    const auto row = [v = voxels + corner_](int at) {
      return _mm_loadl_pi(_mm_setzero_ps(), reinterpret_cast<const __m64*>(v + at));
    };
    return interpolate(_mm_movelh_ps(row(0), row(kY)), _mm_movelh_ps(row(kZ), row(kZ + kY)));
  }

 private:
  static constexpr int kY = kBrickVoxels, kZ = kBrickVoxels * kBrickVoxels;

  /// max and min give their second operand where the first is NaN: what comes out is a cell in any case.
  explicit BrickPoint(__m128 p) {
    p = _mm_min_ps(_mm_max_ps(p, _mm_setzero_ps()), _mm_set1_ps(kBrickCells));
    const __m128i cell = _mm_min_epi32(_mm_cvttps_epi32(p), _mm_set1_epi32(kBrickCells - 1));
    fraction_ = _mm_sub_ps(p, _mm_cvtepi32_ps(cell));
    const auto xy = static_cast<std::uint64_t>(_mm_cvtsi128_si64(cell));
    corner_ = static_cast<std::uint64_t>(_mm_extract_epi32(cell, 2)) * kZ + (xy >> 32) * kY + (xy & 0xffff);
  }
  /// Voxels (x0 y0, x1 y0, x0 y1, x1 y1) of the lower and of the upper layer.
  float interpolate(__m128 lower, __m128 upper) const {
    const __m128 z = _mm_fmadd_ps(_mm_permute_ps(fraction_, 0xaa), _mm_sub_ps(upper, lower), lower);
    const __m128 y = _mm_fmadd_ps(_mm_permute_ps(fraction_, 0x55), _mm_sub_ps(_mm_movehl_ps(z, z), z), z);
    return _mm_cvtss_f32(_mm_fmadd_ss(fraction_, _mm_sub_ss(_mm_movehdup_ps(y), y), y));
  }

  std::uint64_t corner_;
  __m128 fraction_;
};

#else

class BrickPoint {
 public:
  BrickPoint(float x, float y, float z) : BrickPoint(Axis(x), Axis(y), Axis(z)) {}
  BrickPoint(const Line& line, double t)
      : BrickPoint(static_cast<float>(line.o[0] + t * line.d[0]), static_cast<float>(line.o[1] + t * line.d[1]),
                   static_cast<float>(line.o[2] + t * line.d[2])) {}

  BrickPoint(const Line& line, double t, const CellBounds& bounds, std::uint32_t (&cell)[3], bool& inside)
      : corner_(0), fx_(0), fy_(0), fz_(0) {
    inside = true;
    float fraction[3];
    for (int i = 0; i < 3; ++i) {
      const double p = line.o[i] + t * line.d[i];
      inside = inside && p >= bounds.lo[i] && p <= bounds.hi[i];
      if (!inside) return;
      const std::int32_t at = std::min(static_cast<std::int32_t>(p), bounds.last[i]);
      fraction[i] = static_cast<float>(p - at);
      cell[i] = static_cast<std::uint32_t>(at);
    }
    corner_ = static_cast<int>(((cell[2] & 7u) * kBrickVoxels + (cell[1] & 7u)) * kBrickVoxels + (cell[0] & 7u));
    fx_ = fraction[0], fy_ = fraction[1], fz_ = fraction[2];
  }

  template <typename Stored>
  float interpolate(const Stored* voxels) const {
    constexpr int kY = kBrickVoxels, kZ = kBrickVoxels * kBrickVoxels;
    const auto at = [v = voxels + corner_](int i) { return static_cast<float>(v[i]); };
    const float lower[4] = {at(0), at(1), at(kY), at(kY + 1)};
    const float upper[4] = {at(kZ), at(kZ + 1), at(kZ + kY), at(kZ + kY + 1)};
    float z[4];
    for (int i = 0; i < 4; ++i) z[i] = lower[i] + fz_ * (upper[i] - lower[i]);
    const float x0 = z[0] + fy_ * (z[2] - z[0]), x1 = z[1] + fy_ * (z[3] - z[1]);
    return x0 + fx_ * (x1 - x0);
  }

 private:
  struct Axis {
    int cell;
    float fraction;
    explicit Axis(float x) {
      const float clamped = x > 0 ? (x < kBrickCells ? x : float{kBrickCells}) : 0.0f;
      const int i = static_cast<int>(clamped);
      cell = i < kBrickCells ? i : kBrickCells - 1;
      fraction = clamped - static_cast<float>(cell);
    }
  };
  BrickPoint(Axis x, Axis y, Axis z)
      : corner_((z.cell * kBrickVoxels + y.cell) * kBrickVoxels + x.cell), fx_(x.fraction), fy_(y.fraction), fz_(z.fraction) {}

  int corner_;
  float fx_, fy_, fz_;
};

#endif

/// Eight points of a brick that are evenly spaced along a line, each moved into [0, 8]^3.
class BrickPoints {
 public:
  static constexpr int kCount = 8;

  /// At t, t + step ...
  BrickPoints(const Line& line, double t, double step) {
    const auto axis = [&](int i, Float8& fraction) {
      const auto first = static_cast<float>(line.o[i] + t * line.d[i]), apart = static_cast<float>(step * line.d[i]);
      const Float8 p = min(Float8(kBrickCells), max(Float8(0.0f), first + apart * count_to_8()));
      const Int8 whole = std::experimental::static_simd_cast<Int8>(p);
      const Int8 cell = min(Int8(kBrickCells - 1), max(Int8(0), whole));  // of NaN as well
      fraction = p - std::experimental::static_simd_cast<Float8>(cell);
      return cell;
    };
    corner_ = axis(0, x_) + kBrickVoxels * (axis(1, y_) + kBrickVoxels * axis(2, z_));
  }

  /// Interpolated voxels.
  template <typename Stored>
  Float8 interpolate(const Stored* voxels) const {
    constexpr int kY = kBrickVoxels, kZ = kBrickVoxels * kBrickVoxels;
    const auto between = [](Float8 a, Float8 b, Float8 share) { return a + share * (b - a); };
    const auto edge = [&](int at) {
      Float8 lower, upper;
      fetch_pairs(voxels + at, lower, upper);
      return between(lower, upper, x_);
    };
    return between(between(edge(0), edge(kY), y_), between(edge(kZ), edge(kZ + kY), y_), z_);
  }

 private:
  /// The voxels at each point's corner, and the next ones along x.
  template <typename Stored>
  void fetch_pairs(const Stored* voxels, Float8& lower, Float8& upper) const {
    lower = Float8([&](int k) { return static_cast<float>(voxels[corner_[static_cast<std::size_t>(k)]]); });
    upper = Float8([&](int k) { return static_cast<float>(voxels[corner_[static_cast<std::size_t>(k)] + 1]); });
  }
#ifdef TYNDALL_TRILINEAR_AVX2
  void fetch_pairs(const std::uint16_t* voxels, Float8& lower, Float8& upper) const {
    const __m256i pairs = _mm256_i32gather_epi32(reinterpret_cast<const int*>(voxels), static_cast<__m256i>(corner_), 2);
    lower = Float8(_mm256_cvtepi32_ps(_mm256_and_si256(pairs, _mm256_set1_epi32(0xffff))));
    upper = Float8(_mm256_cvtepi32_ps(_mm256_srli_epi32(pairs, 16)));
  }
#endif

  Int8 corner_;
  Float8 x_, y_, z_;  // places inside their cells
};

}  // namespace tyndall
