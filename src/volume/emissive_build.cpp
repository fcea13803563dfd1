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
  BrickFinder(const ParticipatingMedium& medium, std::size_t most)
      : medium_(medium), data_(medium.data()), most_(std::max<std::size_t>(most, 1)) {}

  EmissiveBrickData find();

 private:
  static constexpr std::size_t kBlocks = EmissiveBrickData::kBlocksInBrick;
  static constexpr double kUniform = 0.1;  // of the points, wherever they are in the brick: reads miss thin sheets
  static constexpr double kMostPlaces = 1 << 24;
  using Blocks = std::array<double, kBlocks>;  // sums over the cells of each block of mean(sigma_a Le)

  struct Extent {
    Cell lo, size;
    double places() const { return double(size[0]) * size[1] * size[2]; }
  };

  Box3d where_it_emits() const;
  Box3d reach_of(const PlacedGrid& grid) const;
  void find_in(std::uint32_t node, int level, const Index3& corner);
  void read(const Index3& corner, std::int64_t side);
  void fill(const Index3& corner, std::int64_t side);
  double emission_in(const Box3d& box) const;
  void add(const Cell& place, const Blocks& blocks);
  void merge_if_too_many();
  void merge();
  Extent extent() const;
  void place(EmissiveBrickData& bricks, const Extent& box) const;
  void append(EmissiveBrickData& bricks, const Cell& place, const Blocks& blocks) const;

  const ParticipatingMedium& medium_;
  const MediumData& data_;
  std::size_t most_;
  Transform to_world_;                      // from the grid's local coordinates
  Box3d emitting_;                          // local coordinates beyond which nothing is emitted
  std::int64_t cells_ = BrickStore::kSide;  // a side of a brick: a power of 2
  std::map<Cell, Blocks> found_;            // by corner / cells_
};

Transform transform_of(const Affine& map) {
  Transform::Matrix rows = Transform().matrix();
  for (std::size_t i = 0; i < 3; ++i) rows[i] = map.rows[i];
  return Transform(rows);
}

Box3d overlap(const Box3d& a, const Box3d& b) {
  Box3d both;
  for (int i = 0; i < 3; ++i) {
    both.lo[i] = std::max(a.lo[i], b.lo[i]);
    both.hi[i] = std::min(a.hi[i], b.hi[i]);
  }
  return both;
}

Box3d cube(const Index3& corner, std::int64_t side) {
  Box3d box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.lo.v[i] = static_cast<double>(corner[i]);
    box.hi.v[i] = static_cast<double>(corner[i] + side);
  }
  return box;
}

double volume(const Box3d& box) {
  double v = 1;
  for (int i = 0; i < 3; ++i) v *= std::max(0.0, box.hi[i] - box.lo[i]);
  return v;
}

/// A box around all of `grid` that is not 0, in local coordinates of the density.
Box3d BrickFinder::reach_of(const PlacedGrid& grid) const {
  if (grid.grid.empty()) return {{{0, 0, 0}}, {{-1, -1, -1}}};
  const Transform::Matrix m = (to_world_.inverse() * transform_of(grid.to_local).inverse()).matrix();
  Box3d box;
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr double kSlack = 1;  // cells, for rounding
    box.lo.v[i] = m[i][3] - kSlack;
    box.hi.v[i] = m[i][3] + kSlack;
    for (std::size_t j = 0; j < 3; ++j) {
      const double a = m[i][j] * grid.grid.support().lo.v[j], b = m[i][j] * grid.grid.support().hi.v[j];
      box.lo.v[i] += std::min(a, b);
      box.hi.v[i] += std::max(a, b);
    }
  }
  return box;
}

Box3d BrickFinder::where_it_emits() const {
  const EmissionField& e = data_.emission;
  Box3d box = data_.clip;
  if (e.scale) box = overlap(box, reach_of(*e.scale));
  const float kelvin_around = -e.temperature_offset * e.temperature_scale;
  const bool dark_around = e.kind == EmissionField::Kind::rgb_grid ||
                           (e.kind == EmissionField::Kind::blackbody && kelvin_around < BlackbodyTable::kMin);
  if (e.values && dark_around) box = overlap(box, reach_of(*e.values));
  return box;
}

/// mean(sigma_a Le) in the middle of the part of the box within emitting_, times its volume, in cells.
double BrickFinder::emission_in(const Box3d& box) const {
  const Box3d left = overlap(box, emitting_);
  const double size = volume(left);
  if (!(size > 0)) return 0;
  GridVec middle;
  for (int i = 0; i < 3; ++i) middle[i] = 0.5 * (left.lo[i] + left.hi[i]);
  float values[kMaxChannels];
  data_.density.grid.lookup(middle, values);
  Rgb sigma_a, sigma_s;
  data_.scale_by(values, sigma_a, sigma_s);
  if (is_black(sigma_a)) return 0;
  const Vec3 local{static_cast<float>(middle[0]), static_cast<float>(middle[1]), static_cast<float>(middle[2])};
  const double e = size * double{mean(sigma_a * data_.emission.at(to_world_.point(local)))};
  return std::isfinite(e) && e > 0 ? e : 0;
}

void BrickFinder::add(const Cell& place, const Blocks& blocks) {
  if (!std::any_of(blocks.begin(), blocks.end(), [](double e) { return e > 0; })) return;
  Blocks& into = found_.try_emplace(place, Blocks{}).first->second;
  for (std::size_t i = 0; i < kBlocks; ++i) into[i] += blocks[i];
}

/// `side` cells at `corner`, at most those of a brick, of which 8^3 equal parts are read in their middles.
void BrickFinder::read(const Index3& corner, std::int64_t side) {
  const std::int64_t step = side / 8, block = cells_ / EmissiveBrickData::kBlocks;
  Cell place;
  for (std::size_t k = 0; k < 3; ++k) place[k] = static_cast<int>(corner[k] / cells_);
  Blocks blocks{};
  for (int i = 0; i < 512; ++i) {
    const Index3 part{corner[0] + i % 8 * step, corner[1] + i / 8 % 8 * step, corner[2] + i / 64 * step};
    const auto in_brick = [&](std::size_t k) { return static_cast<int>(part[k] % cells_ / block); };
    blocks[EmissiveBrickData::block_index(in_brick(0), in_brick(1), in_brick(2))] += emission_in(cube(part, step));
  }
  add(place, blocks);
  merge_if_too_many();
}

/// `side` cells at `corner` with one emission: read once.
void BrickFinder::fill(const Index3& corner, std::int64_t side) {
  const Box3d all = overlap(cube(corner, side), emitting_);
  const double emission = emission_in(all) / volume(all);
  if (!(emission > 0)) return;
  const auto too_many = [&] { return std::pow(std::max(1.0, double(side) / double(cells_)), 3) > double(most_); };
  while (too_many()) merge();
  const int count = static_cast<int>(std::max<std::int64_t>(1, side / cells_));
  const std::int64_t block = cells_ / EmissiveBrickData::kBlocks;
  for (int i = 0; i < count * count * count; ++i) {
    const Cell place{static_cast<int>(corner[0] / cells_) + i % count, static_cast<int>(corner[1] / cells_) + i / count % count,
                     static_cast<int>(corner[2] / cells_) + i / (count * count)};
    Blocks blocks;
    for (int b = 0; b < static_cast<int>(kBlocks); ++b) {
      const Index3 at{place[0] * cells_ + b % 4 * block, place[1] * cells_ + b / 4 % 4 * block,
                      place[2] * cells_ + b / 16 * block};
      blocks[static_cast<std::size_t>(b)] = emission * volume(overlap(cube(at, block), all));
    }
    add(place, blocks);
  }
  merge_if_too_many();
}

/// A leaf of a higher level has one density everywhere, and still an emission that may vary.
void BrickFinder::find_in(std::uint32_t node, int level, const Index3& corner) {
  const BrickGrid& grid = data_.density.grid;
  const std::int64_t side = BrickGrid::extent(level);
  if (node == BrickGrid::kNone || !(volume(overlap(cube(corner, side), emitting_)) > 0)) return;
  const bool leaf = grid.node(node).is_leaf();
  const EmissionField& e = data_.emission;
  if (level > 0 && leaf && e.kind == EmissionField::Kind::constant && !e.scale) return fill(corner, side);
  if (level == 0 || (leaf && side <= cells_)) return read(corner, side);
  const std::int64_t part = BrickGrid::extent(level - 1);
  for (int i = 0; i < 64; ++i) {
    const Index3 child{corner[0] + i % 4 * part, corner[1] + i / 4 % 4 * part, corner[2] + i / 16 * part};
    find_in(leaf ? node : grid.child(node, level, child), level - 1, child);
  }
}

void BrickFinder::merge_if_too_many() {
  while (found_.size() > most_) merge();
}

/// Bricks of twice the side: the blocks of eight become one.
void BrickFinder::merge() {
  std::map<Cell, Blocks> merged;
  for (const auto& [place, blocks] : found_) {
    Blocks& into = merged.try_emplace({place[0] >> 1, place[1] >> 1, place[2] >> 1}, Blocks{}).first->second;
    const int half[3] = {(place[0] & 1) * 2, (place[1] & 1) * 2, (place[2] & 1) * 2};
    for (int i = 0; i < 64; ++i)
      into[static_cast<std::size_t>(((half[2] + i / 32) * 4 + half[1] + i / 8 % 2) * 4 + half[0] + i % 4 / 2)] +=
          blocks[static_cast<std::size_t>(i)];
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

void BrickFinder::append(EmissiveBrickData& bricks, const Cell& place, const Blocks& blocks) const {
  double total = 0;
  for (const double e : blocks) total += e;
  const double a_block = double(cells_) / EmissiveBrickData::kBlocks;
  bricks.places.push_back(place);
  bricks.intensities.push_back(static_cast<float>(total * bricks.block_volume / (a_block * a_block * a_block)));
  double sum = 0;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    sum += (1 - kUniform) * blocks[i] / total + kUniform / kBlocks;
    bricks.cumulative.push_back(i + 1 < kBlocks ? static_cast<float>(std::min(sum, 1.0)) : 1.0f);
  }
}

void BrickFinder::place(EmissiveBrickData& bricks, const Extent& box) const {
  const auto cells = double(cells_), side = cells / EmissiveBrickData::kBlocks;
  const Transform local_of_block =
      Transform::translate(box.lo[0] * cells, box.lo[1] * cells, box.lo[2] * cells) * Transform::scale(side, side, side);
  bricks.to_world = to_world_ * local_of_block;
  bricks.to_local = Affine::of(bricks.to_world.inverse());
  const auto& m = bricks.to_world.matrix();
  bricks.block_volume =
      std::abs(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]));
  bricks.size = box.size;
  bricks.index.assign(static_cast<std::size_t>(box.places()), EmissiveBrickData::kNone);
  for (const auto& [corner, blocks] : found_) {
    const Cell at{corner[0] - box.lo[0], corner[1] - box.lo[1], corner[2] - box.lo[2]};
    bricks.index[bricks.index_of(at)] = static_cast<std::uint32_t>(bricks.places.size());
    append(bricks, at, blocks);
  }
}

EmissiveBrickData BrickFinder::find() {
  EmissiveBrickData bricks;
  const BrickGrid& grid = data_.density.grid;
  if (!medium_.emissive() || data_.kind != MediumData::Kind::grid || grid.empty()) return bricks;
  to_world_ = transform_of(data_.density.to_local).inverse();
  emitting_ = where_it_emits();
  find_in(grid.root(), grid.root_level(), {0, 0, 0});
  if (found_.empty()) return bricks;
  while (extent().places() > kMostPlaces) merge();
  place(bricks, extent());
  return bricks;
}

}  // namespace

EmissiveBrickData find_emissive_bricks(const ParticipatingMedium& medium, std::size_t most) {
  return BrickFinder(medium, most).find();
}

}  // namespace tyndall
