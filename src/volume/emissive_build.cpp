// Finds the cells of a medium that emit, and gathers them into larger ones while there are too many.
#include <algorithm>
#include <cmath>
#include <map>

#include "volume/emissive_data.h"
#include "volume/medium_data.h"

namespace tyndall {
namespace {

constexpr int kBlocks = EmissiveCellData::kBlocks;

Transform transform_of(const Affine& map) {
  Transform::Matrix rows = Transform().matrix();
  for (std::size_t i = 0; i < 3; ++i) rows[i] = map.rows[i];
  return Transform(rows);
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

/// What a part of a medium sends and absorbs: integrals over it, means of channels.
struct Sums {
  double emission = 0;    ///< of sigma_a Le
  double extinction = 0;  ///< of sigma_t, where something is emitted
  Sums& operator+=(const Sums& other) {
    emission += other.emission;
    extinction += other.extinction;
    return *this;
  }
  Sums operator*(double s) const { return {emission * s, extinction * s}; }
};

/// The emission of a medium with a grid, in local coordinates of its density.
class GridEmission {
 public:
  explicit GridEmission(const ParticipatingMedium& medium)
      : data_(medium.data()), to_world_(transform_of(data_.density.to_local).inverse()), extent_(where_it_emits()) {}

  const MediumData& data() const { return data_; }
  const Transform& to_world() const { return to_world_; }
  const Box3d& extent() const { return extent_; }  ///< beyond it nothing is emitted

  /// As in the middle of the part of the box within extent(), all over that part.
  Sums in(const Box3d& box) const {
    const Box3d left = overlap(box, extent_);
    const double size = volume(left);
    if (!(size > 0)) return {};
    GridVec middle;
    for (int i = 0; i < 3; ++i) middle[i] = 0.5 * (left.lo[i] + left.hi[i]);
    return at(middle) * size;
  }

  /// A unit of volume there; nothing where the emission is not a number.
  Sums at(const GridVec& p) const {
    if (!extent_.contains(p)) return {};
    float values[kMaxChannels];
    data_.density.grid.lookup(p, values);
    Rgb sigma_a, sigma_s;
    data_.scale_by(values, sigma_a, sigma_s);
    if (is_black(sigma_a)) return {};
    const Vec3 local{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
    const float e = mean(sigma_a * data_.emission.at(to_world_.point(local)));
    return std::isfinite(e) && e > 0 ? Sums{e, mean(sigma_a + sigma_s)} : Sums{};
  }

 private:
  Box3d where_it_emits() const;
  Box3d reach_of(const PlacedGrid& grid) const;

  const MediumData& data_;
  Transform to_world_;
  Box3d extent_;
};

/// A box around all of `grid` that is not 0.
Box3d GridEmission::reach_of(const PlacedGrid& grid) const {
  if (grid.grid.empty()) return {{{0, 0, 0}}, {{-1, -1, -1}}};
  const Transform::Matrix m = (to_world_.inverse() * transform_of(grid.to_local).inverse()).matrix();
  Box3d box;
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr double kSlack = 1;  // for rounding
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

Box3d GridEmission::where_it_emits() const {
  const EmissionField& e = data_.emission;
  Box3d box = data_.clip;
  if (e.scale) box = overlap(box, reach_of(*e.scale));
  const float kelvin_around = -e.temperature_offset * e.temperature_scale;
  const bool dark_around = e.kind == EmissionField::Kind::rgb_grid ||
                           (e.kind == EmissionField::Kind::blackbody && kelvin_around < BlackbodyTable::kMin);
  if (e.values && dark_around) box = overlap(box, reach_of(*e.values));
  return box;
}

/// Sums emission by places of equal cubes, whose side is doubled whenever there are too many.
class CellFinder {
 public:
  CellFinder(const GridEmission& emission, std::size_t most) : emission_(emission), most_(std::max<std::size_t>(most, 1)) {}

  EmissiveCellData find();

 private:
  static constexpr double kMostPlaces = 1 << 24;

  struct Extent {
    Place lo, size;
    double places() const { return double(size[0]) * size[1] * size[2]; }
  };

  void find_in(std::uint32_t node, int level, const Index3& corner);
  void read(const Index3& corner, std::int64_t side);
  void fill(const Index3& corner, std::int64_t side);
  void merge_if_too_many();
  void merge();
  Place place_of(const Index3& corner) const;
  Extent extent() const;
  void append_lattice(EmissiveCellData& cells, const Place& place) const;
  float read_node(const GridVec& p) const;
  EmissiveCellData placed(const Extent& box) const;

  const GridEmission& emission_;
  std::size_t most_;
  std::int64_t side_ = kBlocks;  // of a cell, in voxels: a power of 2
  std::map<Place, Sums> found_;  // by corner / side_, those that emit
};

Place CellFinder::place_of(const Index3& corner) const {
  Place place;
  for (std::size_t k = 0; k < 3; ++k) place[k] = static_cast<int>(corner[k] / side_);
  return place;
}

/// `side` voxels at `corner`, a brick's at most or a cell's, of which 8^3 equal parts are read in their middles.
void CellFinder::read(const Index3& corner, std::int64_t side) {
  constexpr int kParts = 8;
  const std::int64_t step = std::max<std::int64_t>(side / kParts, 1);
  for (int i = 0; i < kParts * kParts * kParts; ++i) {
    const Index3 part{corner[0] + i % kParts * step, corner[1] + i / kParts % kParts * step,
                      corner[2] + i / (kParts * kParts) * step};
    const Sums sums = emission_.in(cube(part, step));
    if (sums.emission > 0) found_[place_of(part)] += sums;
  }
  merge_if_too_many();
}

/// `side` voxels at `corner` with one emission: read once.
void CellFinder::fill(const Index3& corner, std::int64_t side) {
  const Box3d all = overlap(cube(corner, side), emission_.extent());
  const Sums all_of_it = emission_.in(all);
  if (!(all_of_it.emission > 0)) return;
  const auto too_many = [&] { return std::pow(std::max(1.0, double(side) / double(side_)), 3) > double(most_); };
  while (too_many()) merge();
  const int count = static_cast<int>(std::max<std::int64_t>(1, side / side_));
  for (int i = 0; i < count * count * count; ++i) {
    const Place first = place_of(corner);
    const Place place{first[0] + i % count, first[1] + i / count % count, first[2] + i / (count * count)};
    const Index3 at{place[0] * side_, place[1] * side_, place[2] * side_};
    const double size = volume(overlap(cube(at, side_), all));
    if (size > 0) found_[place] += all_of_it * (size / volume(all));
  }
  merge_if_too_many();
}

/// A leaf of a higher level has one density everywhere, and still an emission that may vary.
void CellFinder::find_in(std::uint32_t node, int level, const Index3& corner) {
  const BrickGrid& grid = emission_.data().density.grid;
  const std::int64_t side = BrickGrid::extent(level);
  if (node == BrickGrid::kNone || !(volume(overlap(cube(corner, side), emission_.extent())) > 0)) return;
  const bool leaf = grid.node(node).is_leaf();
  const EmissionField& e = emission_.data().emission;
  if (level > 0 && leaf && e.kind == EmissionField::Kind::constant && !e.scale) return fill(corner, side);
  if (level == 0 || (leaf && side <= side_)) return read(corner, side);
  const std::int64_t part = BrickGrid::extent(level - 1);
  for (int i = 0; i < 64; ++i) {
    const Index3 child{corner[0] + i % 4 * part, corner[1] + i / 4 % 4 * part, corner[2] + i / 16 * part};
    find_in(leaf ? node : grid.child(node, level, child), level - 1, child);
  }
}

void CellFinder::merge_if_too_many() {
  while (found_.size() > most_) merge();
}

/// Of twice the side: eight become one.
void CellFinder::merge() {
  std::map<Place, Sums> merged;
  for (const auto& [place, sums] : found_) merged[{place[0] >> 1, place[1] >> 1, place[2] >> 1}] += sums;
  found_ = std::move(merged);
  side_ *= 2;
}

CellFinder::Extent CellFinder::extent() const {
  Extent box{found_.begin()->first, {}};
  Place hi = box.lo;
  for (const auto& entry : found_)
    for (std::size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], entry.first[k]);
      hi[k] = std::max(hi[k], entry.first[k]);
    }
  for (std::size_t k = 0; k < 3; ++k) box.size[k] = hi[k] - box.lo[k] + 1;
  return box;
}

/// At a voxel exactly; where nodes are farther apart the mean of what is around it.
float CellFinder::read_node(const GridVec& p) const {
  const double block = double(side_) / kBlocks;
  if (block <= 1) return static_cast<float>(emission_.at(p).emission);
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    const auto aside = [&](int bit) { return (i >> bit & 1 ? 0.25 : -0.25) * block; };
    sum += emission_.at({{p[0] + aside(0), p[1] + aside(1), p[2] + aside(2)}}).emission;
  }
  return static_cast<float>(sum / 8);
}

void CellFinder::append_lattice(EmissiveCellData& cells, const Place& place) const {
  EmissiveCellData::Lattice nodes;
  const double block = double(side_) / kBlocks;
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    const Place number = EmissiveCellData::place_of_node(i);
    GridVec at;
    for (std::size_t axis = 0; axis < 3; ++axis) at.v[axis] = double(place[axis]) * double(side_) + number[axis] * block;
    nodes[static_cast<std::size_t>(i)] = read_node(at);
  }
  cells.append_lattice(nodes);
}

EmissiveCellData CellFinder::placed(const Extent& box) const {
  EmissiveCellData cells;
  const auto side = double(side_);
  cells.to_world = emission_.to_world() * Transform::translate(box.lo[0] * side, box.lo[1] * side, box.lo[2] * side) *
                   Transform::scale(side, side, side);
  cells.to_local = Affine::of(cells.to_world.inverse());
  cells.cell_volume = std::abs(cells.to_world.determinant());
  cells.size = box.size;
  cells.index.assign(static_cast<std::size_t>(box.places()), EmissiveCellData::kNone);
  const double voxels = side * side * side;
  std::vector<float> sigma_t;
  for (const auto& [corner, sums] : found_) {
    const Place at{corner[0] - box.lo[0], corner[1] - box.lo[1], corner[2] - box.lo[2]};
    cells.index[cells.index_of(at)] = static_cast<std::uint32_t>(cells.places.size());
    cells.places.push_back(at);
    cells.intensities.push_back(static_cast<float>(sums.emission * cells.cell_volume / voxels));
    sigma_t.push_back(static_cast<float>(sums.extinction / voxels));
    append_lattice(cells, corner);
  }
  gather_radiances(cells, sigma_t);
  gather_powers(cells, sigma_t);
  return cells;
}

EmissiveCellData CellFinder::find() {
  const BrickGrid& grid = emission_.data().density.grid;
  find_in(grid.root(), grid.root_level(), {0, 0, 0});
  if (found_.empty()) return {};
  while (extent().places() > kMostPlaces) merge();
  return placed(extent());
}

}  // namespace

EmissiveCellData find_emissive_cells(const ParticipatingMedium& medium, const MediumReach& reach, std::size_t most) {
  if (!medium.emissive()) return {};
  const MediumData& data = medium.data();
  if (medium.homogeneous()) return homogeneous_cells(medium, reach);
  if (data.kind != MediumData::Kind::grid || data.density.grid.empty()) return {};
  return CellFinder(GridEmission(medium), most).find();
}

}  // namespace tyndall
