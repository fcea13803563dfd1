#include "denoise/features.h"

#include <algorithm>

#include "denoise/nl_means.h"
#include "math/simd.h"

namespace tyndall {
namespace {

constexpr Neighbourhood kSearch{5};
constexpr int kPatch = 3, kPool = 3, kTile = 32;
constexpr float kBandwidth = 0.5f;

/// Of each half, from the difference of the two.
std::vector<PaddedPlane> variances_of(const Feature& feature, ThreadPool& pool) {
  std::vector<PaddedPlane> variances;
  for (std::size_t c = 0; c < feature.halves[0].size(); ++c) {
    const PaddedPlane &a = feature.halves[0][c], &b = feature.halves[1][c];
    const PaddedPlane raw = make_plane(a.width(), a.height(), pool, [&](int x, int y) {
      const float difference = a.at(x, y) - b.at(x, y);
      return difference * difference * 0.5f;
    });
    variances.push_back(box_mean(raw, kPool, pool));
  }
  return variances;
}

Guide guide_of(const std::vector<PaddedPlane>& values, const std::vector<PaddedPlane>& variances) {
  Guide guide;
  for (const PaddedPlane& plane : values) guide.values.push_back(&plane);
  for (const PaddedPlane& plane : variances) guide.variances.push_back(&plane);
  return guide;
}

float weighted_mean(const PaddedPlane& plane, int x, int y, const std::vector<float>& weights) {
  float sum = 0, all = 0;
  const float* w = weights.data();
  for (int dy = -kSearch.radius; dy <= kSearch.radius; ++dy) {
    const float* values = plane.row(y + dy) + x - kSearch.radius;
    for (int i = 0; i < kSearch.side(); ++i, ++w) sum += *w * values[i], all += *w;
  }
  return sum / all;  // a pixel is like itself: its weight is 1
}

}  // namespace

Feature prefiltered(const Feature& feature, ThreadPool& pool) {
  const std::vector<PaddedPlane> variances = variances_of(feature, pool);
  const int width = variances[0].width(), height = variances[0].height();
  Feature result;
  for (auto& half : result.halves) half.assign(variances.size(), PaddedPlane(width, height));
  const int across = (width + kTile - 1) / kTile, down = (height + kTile - 1) / kTile;
  pool.for_each(static_cast<std::size_t>(across * down), 1, [&](std::size_t tile) {
    const int x0 = static_cast<int>(tile) % across * kTile, y0 = static_cast<int>(tile) / across * kTile;
    const CentreGrid pixels{x0, y0, 1, std::min(kTile, width - x0), std::min(kTile, height - y0)};
    PatchDistances distances(kSearch, kPatch);
    std::vector<float> weights(static_cast<std::size_t>(kSearch.padded()));
    for (std::size_t h = 0; h < 2; ++h) {
      distances.compute(guide_of(feature.halves[h], variances), pixels);
      for (int i = 0; i < pixels.count(); ++i) {
        distances.weights(i, kBandwidth, weights);
        const int x = pixels.x(i), y = pixels.y(i);
        for (std::size_t c = 0; c < variances.size(); ++c)
          result.halves[h][c].at(x, y) = weighted_mean(feature.halves[h][c], x, y, weights);
      }
    }
  });
  for (auto& half : result.halves) {
    for (PaddedPlane& plane : half) plane.extend();
  }
  return result;
}

}  // namespace tyndall
