#include "denoise/energy.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tyndall {
namespace {

constexpr int kBlock = 64;                        ///< pixels a side
constexpr double kErrors = 1.5, kUnseen = 0.007;  ///< standard errors; of the light
constexpr int kPasses = 4;                        ///< each changes the neighbours of a block as well

/// What must be added to `light` to be as near to what was rendered as its noise, or what nobody sees, leaves open.
double missing(double light, double rendered, double variance) {
  const double deviation = rendered - light, slack = std::max(kErrors * std::sqrt(variance), kUnseen * std::abs(rendered));
  return std::copysign(std::max(std::abs(deviation) - slack, 0.0), deviation);
}

}  // namespace

Energy::Energy(const Halves& halves)
    : width_(halves.width()),
      height_(halves.height()),
      across_((width_ + kBlock - 1) / kBlock),
      down_((height_ + kBlock - 1) / kBlock) {
  for (std::size_t c = 0; c < 3; ++c) {
    blocks_[c].resize(static_cast<std::size_t>(across_ * down_));
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        Block& block = blocks_[c][block_of(x, y)];
        block.light += halves.mean(c, x, y);
        block.variance += halves.raw_variance(c, x, y);
      }
    }
  }
}

std::size_t Energy::block_of(int x, int y) const { return static_cast<std::size_t>(y / kBlock * across_ + x / kBlock); }

std::vector<double> Energy::sums_of(const PaddedPlane& plane) const {
  std::vector<double> sums(static_cast<std::size_t>(across_ * down_));
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) sums[block_of(x, y)] += plane.at(x, y);
  return sums;
}

void Energy::restore(ColorPlanes& estimate, const ColorPlanes& variance, ThreadPool& pool) const {
  for (std::size_t c = 0; c < 3; ++c) {
    for (int pass = 0; pass < kPasses; ++pass) {
      const PaddedPlane room = make_plane(width_, height_, pool, [&](int x, int y) {
        return std::min(std::abs(estimate[c].at(x, y)), std::sqrt(variance[c].at(x, y)));
      });
      const std::vector<double> rooms = sums_of(room);
      const std::vector<double> lights = missing_light(sums_of(estimate[c]), rooms, blocks_[c], pass + 1 < kPasses);
      add(estimate[c], room, {lights, rooms}, pool);
    }
  }
}

/// What the picture as a whole lacks, as there is room for it, and with `blocks_too` what each block lacks then.
std::vector<double> Energy::missing_light(std::vector<double> lights, const std::vector<double>& rooms,
                                          const std::vector<Block>& blocks, bool blocks_too) {
  Block whole;
  for (const Block& block : blocks) whole.light += block.light, whole.variance += block.variance;
  const double light = std::accumulate(lights.begin(), lights.end(), 0.0),
               room = std::accumulate(rooms.begin(), rooms.end(), 0.0);
  const double overall = room > 0 ? missing(light, whole.light, whole.variance) / room : 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const double added = overall * rooms[i];
    lights[i] = added + (blocks_too ? missing(lights[i] + added, blocks[i].light, blocks[i].variance) : 0);
  }
  return lights;
}

/// Both are bilinear between the blocks' centres: a block without room has no say in its neighbours'.
void Energy::add(PaddedPlane& estimate, const PaddedPlane& room, const Change& change, ThreadPool& pool) const {
  pool.for_each(static_cast<std::size_t>(height_), 16, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width_; ++x) {
      const double there = bilinear(change.rooms, x, y);
      const double share = there > 0 ? std::clamp(bilinear(change.lights, x, y) / there, -1.0, 1.0) : 0.0;
      estimate.at(x, y) += static_cast<float>(share) * room.at(x, y);
    }
  });
}

double Energy::bilinear(const std::vector<double>& blocks, int x, int y) const {
  const auto at = [&](int i, int j) {
    return blocks[static_cast<std::size_t>(std::clamp(j, 0, down_ - 1) * across_ + std::clamp(i, 0, across_ - 1))];
  };
  const double from_left = (x + 0.5) / kBlock - 0.5, from_top = (y + 0.5) / kBlock - 0.5;
  const int i = static_cast<int>(std::floor(from_left)), j = static_cast<int>(std::floor(from_top));
  const double upper = std::lerp(at(i, j), at(i + 1, j), from_left - i);
  const double lower = std::lerp(at(i, j + 1), at(i + 1, j + 1), from_left - i);
  return std::lerp(upper, lower, from_top - j);
}

}  // namespace tyndall
