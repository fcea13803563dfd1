#include "denoise/collaborative.h"

#include <algorithm>

#include "math/simd.h"

namespace tyndall {
namespace {

constexpr Neighbourhood kWindow{9};
constexpr int kPatch = 3;
constexpr int kStep = 3;                 ///< pixels between fits: each pixel is in the windows of forty
constexpr int kCentres = 16;             ///< a side of a tile
constexpr int kTile = kStep * kCentres;  ///< pixels
constexpr float kLeastWeight = 1e-4f;    ///< of a pixel's own value: where nothing is like it, it stays
constexpr std::size_t kFits = 2 * kBandwidths.size();

/// Sums for one fit of each window: weight * prediction of three channels, weight, weight * leverage.
constexpr std::size_t kSums = 5;

/// A tile's sums, its neighbours' pixels within a window's radius included.
class TileSums {
 public:
  static constexpr int kReach = kTile + 2 * kWindow.radius;  ///< pixels that the windows cover
  static constexpr int kSide = (kReach + 7) / 8 * 8;         ///< with room for whole vectors

  TileSums() : values_(kFits * kSums * kPlane) {}
  void clear() { std::fill(values_.begin(), values_.end(), 0.0f); }
  /// (x, y) from the corner of what the windows cover.
  float* at(std::size_t plane, int x, int y) { return values_.data() + plane * kPlane + y * kSide + x; }

 private:
  static constexpr std::size_t kPlane = static_cast<std::size_t>(kSide) * kSide;
  std::vector<float> values_;
};

/// All fits of a tile.
class TileFits {
 public:
  TileFits(const Halves& halves, const FeatureHalves& features)
      : halves_(halves),
        distances_{PatchDistances(kWindow, kPatch), PatchDistances(kWindow, kPatch)},
        explanations_{Explanation(kWindow, features[0]), Explanation(kWindow, features[1])},
        targets_{WindowColumns(kWindow, 3), WindowColumns(kWindow, 3)},
        fitted_(kWindow, 3),
        regression_(kWindow, 3 + features[0].size()),
        weights_(static_cast<std::size_t>(kWindow.padded())) {}

  void run(const CentreGrid& centres, TileSums& sums) {
    for (std::size_t h = 0; h < 2; ++h) distances_[h].compute(guide_of(h), centres);
    for (int centre = 0; centre < centres.count(); ++centre) {
      const int x = centres.x(centre), y = centres.y(centre);
      for (std::size_t h = 0; h < 2; ++h) {
        explanations_[h].move_to(x, y);
        for (std::size_t c = 0; c < 3; ++c) targets_[h].load(c, halves_.values[h][c], x, y);
        for (std::size_t k = 0; k < kBandwidths.size(); ++k) {
          distances_[h].weights(centre, kBandwidths[k], weights_);
          const float leverage = regression_.fit(explanations_[h].columns(), targets_[h], weights_, fitted_);
          splat(leverage, {x % kTile, y % kTile}, h * kBandwidths.size() + k, sums);
        }
      }
    }
  }

 private:
  Guide guide_of(std::size_t half) const {
    Guide guide;
    guide.scale = 1 / halves_.share[half];
    for (std::size_t c = 0; c < 3; ++c) {
      guide.values.push_back(&halves_.values[half][c]);
      guide.variances.push_back(&halves_.variance[c]);
    }
    return guide;
  }

  /// `corner`: of the window, in the tile's sums. Rows are added in whole vectors, with weight 0 beyond the window.
  void splat(float leverage, std::array<int, 2> corner, std::size_t fit, TileSums& sums) const {
    const int side = kWindow.side();
    const auto add = [&](std::size_t sum, int i, int j, Float8 v) {
      float* to = sums.at(fit * kSums + sum, corner[0] + i, corner[1] + j);
      store8(to, load8(to) + v);
    };
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; i += 8) {
        const int row = j * side + i;
        const Float8 lane([](auto n) { return static_cast<float>(n); });
        const Float8 w = choose(lane < static_cast<float>(side - i), load8(weights_.data() + row), Float8(0.0f));
        for (std::size_t c = 0; c < 3; ++c) add(c, i, j, w * load8(fitted_[c] + row));
        add(3, i, j, w);
        add(4, i, j, w * w * leverage);
      }
    }
  }

  const Halves& halves_;
  std::array<PatchDistances, 2> distances_;
  std::array<Explanation, 2> explanations_;
  std::array<WindowColumns, 2> targets_;
  WindowColumns fitted_;
  Regression regression_;
  std::vector<float> weights_;
};

/// Where the tiles of a picture lie.
class Tiles {
 public:
  Tiles(int width, int height) : width_(width), height_(height), across_((width + kTile - 1) / kTile) {}

  std::size_t count() const { return static_cast<std::size_t>(across_ * ((height_ + kTile - 1) / kTile)); }
  int x(std::size_t tile) const { return static_cast<int>(tile) % across_ * kTile; }
  int y(std::size_t tile) const { return static_cast<int>(tile) / across_ * kTile; }
  /// Centres stand in the middle of kStep pixels, or at the first of a last few.
  CentreGrid centres(std::size_t tile) const {
    const int across = std::min(kTile, width_ - x(tile)), down = std::min(kTile, height_ - y(tile));
    const int first_x = std::min(kStep / 2, across - 1), first_y = std::min(kStep / 2, down - 1);
    return {x(tile) + first_x, y(tile) + first_y, kStep, (across - first_x + kStep - 1) / kStep,
            (down - first_y + kStep - 1) / kStep};
  }

 private:
  int width_, height_, across_;
};

/// Adds sum number `plane` of tiles, in their order, to the picture's.
void add_tiles(const Tiles& tiles, std::size_t first, std::span<TileSums> sums, std::size_t plane, PaddedPlane& picture) {
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const int x0 = tiles.x(first + i) - kWindow.radius, y0 = tiles.y(first + i) - kWindow.radius;
    const int from_x = std::max(x0, 0), to_x = std::min(x0 + TileSums::kReach, picture.width());
    for (int y = std::max(y0, 0); y < std::min(y0 + TileSums::kReach, picture.height()); ++y) {
      const float* from = sums[i].at(plane, from_x - x0, y - y0);
      float* to = picture.row(y) + from_x;
      for (int x = 0; x < to_x - from_x; ++x) to[x] += from[x];
    }
  }
}

/// Divides the sums by their weights. Where nothing was like a pixel, it stays as it is.
void normalise(const ColorPlanes& half, Filtered& filtered, const PaddedPlane& weight, ThreadPool& pool) {
  pool.for_each(static_cast<std::size_t>(weight.height()), 16, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < weight.width(); ++x) {
      const float all = 1 / (weight.at(x, y) + kLeastWeight);
      for (std::size_t c = 0; c < 3; ++c) {
        float& value = filtered.values[c].at(x, y);
        value = (value + kLeastWeight * half[c].at(x, y)) * all;
      }
      filtered.leverage.at(x, y) = std::min(1.0f, (filtered.leverage.at(x, y) + kLeastWeight) * all);
    }
  });
  for (PaddedPlane& plane : filtered.values) plane.extend();
}

}  // namespace

FilteredHalves regress(const Halves& halves, const FeatureHalves& features, ThreadPool& pool) {
  const int width = halves.width(), height = halves.height();
  const Tiles tiles(width, height);
  std::vector<PaddedPlane> picture(kFits * kSums, PaddedPlane(width, height));
  constexpr std::size_t kBatch = 64;
  std::vector<TileSums> sums(std::min(kBatch, tiles.count()));
  for (std::size_t first = 0; first < tiles.count(); first += kBatch) {
    const std::span batch = std::span(sums).first(std::min(kBatch, tiles.count() - first));
    pool.for_each(batch.size(), 1, [&](std::size_t i) {
      batch[i].clear();
      TileFits(halves, features).run(tiles.centres(first + i), batch[i]);
    });
    pool.for_each(picture.size(), 1, [&](std::size_t p) { add_tiles(tiles, first, batch, p, picture[p]); });
  }
  FilteredHalves filtered;
  for (std::size_t fit = 0; fit < kFits; ++fit) {
    const std::size_t h = fit / kBandwidths.size();
    Filtered& result = filtered[h][fit % kBandwidths.size()];
    for (std::size_t c = 0; c < 3; ++c) result.values[c] = std::move(picture[fit * kSums + c]);
    result.leverage = std::move(picture[fit * kSums + 4]);
    normalise(halves.values[h], result, picture[fit * kSums + 3], pool);
  }
  return filtered;
}

}  // namespace tyndall
