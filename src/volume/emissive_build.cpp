// Finds the bricks of a medium that emit, and gathers them into larger ones while there are too many.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "volume/emissive_data.h"
#include "volume/medium_data.h"

namespace tyndall {
namespace {

class BrickFinder {
 public:
  BrickFinder(const ParticipatingMedium& medium, std::size_t most) : medium_(medium), data_(medium.data()), most_(most) {}

  EmissiveBrickData find();

 private:
  static constexpr std::size_t kBlocks = EmissiveBrickData::kBlocksInBrick;
  static constexpr double kUniform = 0.1;  // of the points, wherever they are in the brick: readings miss thin sheets
  static constexpr std::size_t kMostPlaces = std::size_t{1} << 24;
  using Blocks = std::array<double, kBlocks>;  // sums over the cells of each block of mean(sigma_a Le)

  struct Extent {
    Cell lo, size;
    std::size_t places() const {
      return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
    }
  };

  void find_in(std::uint32_t node, int level, const Index3& corner);
  void read(const Index3& corner);
  double emission_in(const Index3& cell) const;
  void merge();
  Extent extent() const;
  void place(EmissiveBrickData& bricks, const Extent& box) const;
  void add(EmissiveBrickData& bricks, const Cell& place, const Blocks& blocks) const;

  const ParticipatingMedium& medium_;
  const MediumData& data_;
  std::size_t most_;
  Transform to_world_;                // from the grid's local coordinates
  int cells_ = BrickStore::kSide;     // a side of a brick
  std::map<Cell, Blocks> found_;      // by corner / cells_
};

/// mean(sigma_a Le) in the middle of what the medium's box leaves of the cell, times the share that is left.
double BrickFinder::emission_in(const Index3& cell) const {
  Vec3 middle;
  double left = 1;
  for (int i = 0; i < 3; ++i) {
    const auto corner = static_cast<double>(cell[static_cast<std::size_t>(i)]);
    const double lo = std::max(corner, data_.clip.lo[i]), hi = std::min(corner + 1, data_.clip.hi[i]);
    if (!(lo < hi)) return 0;
    middle[i] = static_cast<float>(0.5 * (lo + hi));
    left *= hi - lo;
  }
  const Coefficients c = medium_.at(to_world_.point(middle));
  const double e = left * double{mean(c.sigma_a * c.Le)};
  return std::isfinite(e) && e > 0 ? e : 0;
}

/// The brick of 8^3 cells at `corner`: its emission is read in the middle of each cell.
void BrickFinder::read(const Index3& corner) {
  Blocks blocks{};
  double total = 0;
  for (int z = 0; z < 8; ++z)
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const double e = emission_in({corner[0] + x, corner[1] + y, corner[2] + z});
        blocks[static_cast<std::size_t>((z / 2 * 4 + y / 2) * 4 + x / 2)] += e;
        total += e;
      }
  if (!(total > 0)) return;
  found_.emplace(Cell{static_cast<int>(corner[0] / 8), static_cast<int>(corner[1] / 8), static_cast<int>(corner[2] / 8)}, blocks);
}

void BrickFinder::find_in(std::uint32_t node, int level, const Index3& corner) {
  const BrickGrid& grid = data_.density.grid;
  if (node == BrickGrid::kNone) return;
  if (level == 0) return read(corner);
  const std::int64_t side = BrickGrid::extent(level - 1);
  for (int i = 0; i < 64; ++i) {
    const Index3 child{corner[0] + i % 4 * side, corner[1] + i / 4 % 4 * side, corner[2] + i / 16 * side};
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k)
      inside = inside && double(child[k]) < data_.clip.hi.v[k] && double(child[k] + side) > data_.clip.lo.v[k];
    // A leaf of a higher level has one density everywhere, and still an emission that varies.
    if (inside) find_in(grid.node(node).is_leaf() ? node : grid.child(node, level, child), level - 1, child);
  }
}

/// Bricks of twice the side: the blocks of eight become one.
void BrickFinder::merge() {
  std::map<Cell, Blocks> merged;
  for (const auto& [place, blocks] : found_) {
    Blocks& into = merged.try_emplace({place[0] >> 1, place[1] >> 1, place[2] >> 1}, Blocks{}).first->second;
    const int half[3] = {(place[0] & 1) * 2, (place[1] & 1) * 2, (place[2] & 1) * 2};
    for (int i = 0; i < 64; ++i)
      into[static_cast<std::size_t>(((half[2] + i / 32) * 4 + half[1] + i / 8 % 2) * 4 + half[0] + i % 4 / 2)] += blocks[static_cast<std::size_t>(i)];
  }
  found_ = std::move(merged);
  cells_ *= 2;
}

BrickFinder::Extent BrickFinder::extent() const {
  Extent box{found_.begin()->first, {}};
  Cell hi = box.lo;
  for (const auto& entry : found_)
    for (std::size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], entry.first[k]);
      hi[k] = std::max(hi[k], entry.first[k]);
    }
  for (std::size_t k = 0; k < 3; ++k) box.size[k] = hi[k] - box.lo[k] + 1;
  return box;
}

void BrickFinder::add(EmissiveBrickData& bricks, const Cell& place, const Blocks& blocks) const {
  double total = 0;
  for (const double e : blocks) total += e;
  const int a_block = cells_ / EmissiveBrickData::kBlocks;
  bricks.places.push_back(place);
  bricks.intensities.push_back(static_cast<float>(total * bricks.block_volume / (double(a_block) * a_block * a_block)));
  double sum = 0;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    sum += (1 - kUniform) * blocks[i] / total + kUniform / kBlocks;
    bricks.cumulative.push_back(i + 1 < kBlocks ? static_cast<float>(std::min(sum, 1.0)) : 1.0f);
  }
}

void BrickFinder::place(EmissiveBrickData& bricks, const Extent& box) const {
  const double side = cells_ / EmissiveBrickData::kBlocks;
  const Transform local_of_block = Transform::translate(double(box.lo[0]) * cells_, double(box.lo[1]) * cells_, double(box.lo[2]) * cells_) *
                                   Transform::scale(side, side, side);
  bricks.to_world = to_world_ * local_of_block;
  bricks.to_local = Affine::of(bricks.to_world.inverse());
  const auto& m = bricks.to_world.matrix();
  bricks.block_volume = std::abs(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                                  m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]));
  bricks.size = box.size;
  bricks.index.assign(box.places(), EmissiveBrickData::kNone);
  for (const auto& [corner, blocks] : found_) {
    const Cell at{corner[0] - box.lo[0], corner[1] - box.lo[1], corner[2] - box.lo[2]};
    bricks.index[bricks.index_of(at)] = static_cast<std::uint32_t>(bricks.places.size());
    add(bricks, at, blocks);
  }
}

EmissiveBrickData BrickFinder::find() {
  EmissiveBrickData bricks;
  const BrickGrid& grid = data_.density.grid;
  if (!medium_.emissive() || data_.kind != MediumData::Kind::grid || grid.empty()) return bricks;
  Transform::Matrix rows = Transform().matrix();
  for (std::size_t i = 0; i < 3; ++i) rows[i] = data_.density.to_local.rows[i];
  to_world_ = Transform(rows).inverse();
  find_in(grid.root(), grid.root_level(), {0, 0, 0});
  if (found_.empty()) return bricks;
  while (found_.size() > std::max<std::size_t>(most_, 1) || extent().places() > kMostPlaces) merge();
  place(bricks, extent());
  return bricks;
}

}  // namespace

EmissiveBrickData find_emissive_bricks(const ParticipatingMedium& medium, std::size_t most) {
  return BrickFinder(medium, most).find();
}

}  // namespace tyndall
