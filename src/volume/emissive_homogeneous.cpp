// Homogeneous media as cells that emit: parts of the box that they lie in, with what of each gets out.
#include <algorithm>
#include <cmath>

#include "volume/emissive_data.h"

namespace tyndall {
namespace {

constexpr int kBlocks = EmissiveCellData::kBlocks;
/// Cells along an edge of the box.
constexpr int kFewest = 8, kMost = 16;
/// Of a block along an edge, while the cells are few enough.
constexpr float kMostDepth = 0.6f;
/// Of what is emitted deep inside: more than none, which stands for what is outside.
constexpr float kLeastShare = 1e-6f;

int cells_along(float length, float sigma_t) {
  const float wanted = std::ceil(length * sigma_t / (kBlocks * kMostDepth));
  return wanted < float{kMost} ? std::max(static_cast<int>(wanted), kFewest) : kMost;
}

/// The blocks of all cells, and of what each emits the share that gets out: the mean of both ways along each axis.
class Blocks {
 public:
  Blocks(const Coefficients& medium, const MediumReach& reach, const Place& size);

  /// 0: not in the medium.
  float share(const Place& block) const { return shares_[index_of(block)]; }
  /// At a corner of blocks: the mean of those around it that are in the medium.
  float share_at_corner(const Place& corner) const;

 private:
  std::size_t index_of(const Place& at) const {
    return static_cast<std::size_t>((at[2] * size_[1] + at[1]) * size_[0] + at[0]);
  }
  bool contains(const Place& at) const {
    return std::equal(at.begin(), at.end(), size_.begin(), [](int i, int n) { return i >= 0 && i < n; });
  }
  void pass_row(const MediumReach& reach, std::size_t axis, Place at);
  float share_that_passes(float distance, float block) const;

  Rgb sigma_t_, weight_;  // of the channels, by what they emit
  Place size_;
  Vec3 step_;
  std::vector<float> shares_, found_;  // how many axes a block was found inside along
};

Blocks::Blocks(const Coefficients& medium, const MediumReach& reach, const Place& size)
    : sigma_t_(medium.sigma_t()), weight_(medium.sigma_a * medium.Le * (1 / mean(medium.sigma_a * medium.Le))), size_(size) {
  for (int i = 0; i < 3; ++i) step_[i] = reach.box.extent()[i] / static_cast<float>(size[static_cast<std::size_t>(i)]);
  shares_.assign(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]), 0);
  found_ = shares_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (Place at{}; at[v] < size[v]; ++at[v]) {
      for (at[u] = 0; at[u] < size[u]; ++at[u]) pass_row(reach, axis, at);
    }
  }
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    if (found_[i] > 0) shares_[i] = std::max(shares_[i] / (2 * found_[i]), kLeastShare);
  }
}

/// From the middle of a block to `distance` away, mean over the block's length.
float Blocks::share_that_passes(float distance, float block) const {
  Rgb T;
  for (int k = 0; k < 3; ++k) {
    const float before = sigma_t_[k] * std::max(distance - 0.5f * block, 0.0f);
    T[k] = std::exp(-before) * static_cast<float>(mean_transmittance(double{sigma_t_[k]} * block));
  }
  return mean(weight_ * T);
}

/// The blocks along `axis` from `at` on.
void Blocks::pass_row(const MediumReach& reach, std::size_t axis, Place at) {
  const auto along = static_cast<int>(axis);
  const Vec3 first{static_cast<float>(at[0]) + 0.5f, static_cast<float>(at[1]) + 0.5f, static_cast<float>(at[2]) + 0.5f};
  Ray ray{reach.box.min + first * step_, {}};
  ray.d[along] = 1;
  ray.o[along] = reach.box.min[along] - step_[along];
  const float begin = step_[along], end = begin + reach.box.extent()[along];
  for (const Chord& chord : reach.chords(ray)) {
    const float enters = std::max(chord.t0, begin), leaves = std::min(chord.t1, end);
    for (at[axis] = 0; at[axis] < size_[axis]; ++at[axis]) {
      const float t = (static_cast<float>(at[axis]) + 1.5f) * step_[along];
      if (!(t >= enters && t <= leaves)) continue;
      shares_[index_of(at)] += share_that_passes(t - enters, step_[along]) + share_that_passes(leaves - t, step_[along]);
      ++found_[index_of(at)];
    }
  }
}

float Blocks::share_at_corner(const Place& corner) const {
  float sum = 0, count = 0;
  for (int i = 0; i < 8; ++i) {
    const Place at{corner[0] - (i & 1), corner[1] - (i >> 1 & 1), corner[2] - (i >> 2)};
    if (!contains(at) || share(at) == 0) continue;
    sum += share(at);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// Of a cell.
struct Filling {
  float volume = 0;   ///< share of it that is in the medium
  float leaving = 0;  ///< the same, of which each part counts as far as its light gets out
};

Filling filling_of(const Blocks& blocks, const Place& cell) {
  constexpr int kInCell = kBlocks * kBlocks * kBlocks;
  Filling filling;
  for (int i = 0; i < kInCell; ++i) {
    const float share = blocks.share({cell[0] * kBlocks + i % kBlocks, cell[1] * kBlocks + i / kBlocks % kBlocks,
                                      cell[2] * kBlocks + i / (kBlocks * kBlocks)});
    filling.leaving += share / kInCell;
    if (share > 0) filling.volume += 1.0f / kInCell;
  }
  return filling;
}

EmissiveCellData::Lattice lattice_of(const Blocks& blocks, const Place& cell) {
  EmissiveCellData::Lattice nodes;
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    Place corner = EmissiveCellData::place_of_node(i);
    for (std::size_t axis = 0; axis < 3; ++axis) corner[axis] += cell[axis] * kBlocks;
    nodes[static_cast<std::size_t>(i)] = blocks.share_at_corner(corner);
  }
  return nodes;
}

/// Cells that tile the box, none of them listed yet.
EmissiveCellData tiled(const Bounds3& box, float sigma_t) {
  EmissiveCellData cells;
  Vec3 side;
  for (int i = 0; i < 3; ++i) {
    const int count = cells_along(box.extent()[i], sigma_t);
    cells.size[static_cast<std::size_t>(i)] = count;
    side[i] = box.extent()[i] / static_cast<float>(count);
  }
  cells.to_world = Transform::translate(box.min.x, box.min.y, box.min.z) * Transform::scale(side.x, side.y, side.z);
  cells.cell_volume = double{side.x} * side.y * side.z;
  return cells;
}

}  // namespace

EmissiveCellData homogeneous_cells(const ParticipatingMedium& medium, const MediumReach& reach) {
  if (!(length(reach.box.extent()) < kInfinity)) return {};
  const Coefficients c = medium.at(reach.box.min);
  EmissiveCellData cells = tiled(reach.box, max_component(c.sigma_t()));
  const auto emission = static_cast<float>(double{mean(c.sigma_a * c.Le)} * cells.cell_volume);
  if (!(emission > 0 && std::isfinite(emission))) return {};
  cells.to_local = Affine::of(cells.to_world.inverse());
  const Blocks blocks(c, reach, {cells.size[0] * kBlocks, cells.size[1] * kBlocks, cells.size[2] * kBlocks});
  std::vector<float> sigma_t;
  for (Place at{}; at[2] < cells.size[2]; ++at[2]) {
    for (at[1] = 0; at[1] < cells.size[1]; ++at[1]) {
      for (at[0] = 0; at[0] < cells.size[0]; ++at[0]) {
        const Filling filling = filling_of(blocks, at);
        cells.index.push_back(filling.volume > 0 ? static_cast<std::uint32_t>(cells.places.size()) : EmissiveCellData::kNone);
        if (filling.volume == 0) continue;
        cells.places.push_back(at);
        cells.intensities.push_back(emission * filling.volume);
        cells.powers.push_back(emission * filling.leaving);
        cells.append_lattice(lattice_of(blocks, at));
        sigma_t.push_back(mean(c.sigma_t()) * filling.volume);
      }
    }
  }
  gather_radiances(cells, sigma_t);
  return cells;
}

}  // namespace tyndall
