#include "volume/emissive_bricks.h"

#include <algorithm>
#include <cmath>

#include "volume/emissive_data.h"

namespace tyndall {
namespace {

constexpr int kBlocks = EmissiveBrickData::kBlocks;

/// int t^2 dt, without the cancellation of a difference of cubes.
double squares(double t0, double t1) { return (t1 - t0) * (t0 * t0 + t0 * t1 + t1 * t1) / 3; }

LocalLine in_bricks(LocalLine line) {
  for (int i = 0; i < 3; ++i) {
    line.o[i] /= kBlocks;
    line.d[i] /= kBlocks;
  }
  return line;
}

LocalLine in_brick(LocalLine line, const Cell& place) {
  for (std::size_t i = 0; i < 3; ++i) line.o.v[i] -= place[i] * kBlocks;
  return line;
}

}  // namespace

EmissiveBricks::EmissiveBricks(const ParticipatingMedium& medium, std::size_t most)
    : data_(std::make_unique<const EmissiveBrickData>(find_emissive_bricks(medium, most))) {}
EmissiveBricks::EmissiveBricks(EmissiveBricks&&) noexcept = default;
EmissiveBricks& EmissiveBricks::operator=(EmissiveBricks&&) noexcept = default;
EmissiveBricks::~EmissiveBricks() = default;

std::size_t EmissiveBricks::size() const { return data_->places.size(); }
float EmissiveBricks::intensity(std::uint32_t brick) const { return data_->intensities[brick]; }

std::size_t EmissiveBricks::memory_bytes() const {
  return data_->index.capacity() * sizeof(std::uint32_t) + data_->places.capacity() * sizeof(Cell) +
         (data_->intensities.capacity() + data_->cumulative.capacity()) * sizeof(float);
}

Bounds3 EmissiveBricks::box(std::uint32_t brick) const {
  const Cell& c = data_->places[brick];
  const Vec3 lo = Vec3{static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])} * float{kBlocks};
  return data_->to_world.bounds({lo, lo + Vec3{kBlocks, kBlocks, kBlocks}});
}

Vec3 EmissiveBricks::sample(std::uint32_t brick, Vec3 u) const {
  const float* begin = data_->cumulative.data() + brick * EmissiveBrickData::kBlocksInBrick;
  const float* found = std::upper_bound(begin, begin + EmissiveBrickData::kBlocksInBrick - 1, u.x);
  const float below = found == begin ? 0.0f : found[-1];
  const float rest = std::clamp((u.x - below) / (*found - below), 0.0f, kOneMinusEpsilon);
  const auto block = static_cast<int>(found - begin);
  const Cell& c = data_->places[brick];
  const auto along = [&](std::size_t axis, int offset, float part) {
    return static_cast<float>(c[axis] * kBlocks + offset) + part;
  };
  return data_->to_world.point(
      {along(0, block % kBlocks, rest), along(1, block / kBlocks % kBlocks, u.y), along(2, block / (kBlocks * kBlocks), u.z)});
}

double EmissiveBricks::pdf(std::uint32_t brick, Vec3 p) const {
  const GridVec local = data_->to_local.point(p);
  Cell block;
  for (std::size_t i = 0; i < 3; ++i) {
    const double from = local.v[i] - data_->places[brick][i] * kBlocks;
    if (!(from >= 0 && from < kBlocks)) return 0;
    block[i] = static_cast<int>(from);
  }
  return data_->density(brick, EmissiveBrickData::block_index(block[0], block[1], block[2]));
}

BricksOnRay EmissiveBricks::along(const Ray& ray) const {
  BricksOnRay found;
  if (empty()) return found;
  const EmissiveBrickData& data = *data_;
  const LocalLine line{data.to_local.point(ray.o), data.to_local.vector(ray.d)};
  const LocalLine by_bricks = in_bricks(line);
  const auto [begin, end] = clip_to_cells(by_bricks, data.size, 0, kInfinity);
  if (!(begin < end && end < kInfinity)) return found;
  walk_cells(by_bricks, data.size, begin, end, [&](const Cell& place, double t0, double t1) {
    const std::uint32_t brick = data.index[data.index_of(place)];
    if (brick == EmissiveBrickData::kNone) return;
    BrickOnRay sum{brick, 0, 0};
    walk_cells(in_brick(line, place), {kBlocks, kBlocks, kBlocks}, t0, t1, [&](const Cell& block, double a, double b) {
      const double density = data.density(brick, EmissiveBrickData::block_index(block[0], block[1], block[2]));
      sum.column += density * (b - a);
      sum.direction += density * squares(a, b);
    });
    if (sum.direction > 0) found.push_back(sum);
  });
  return found;
}

}  // namespace tyndall
