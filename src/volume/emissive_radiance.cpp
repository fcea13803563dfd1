// What rays through rows of emissive cells see.
#include <cmath>

#include "volume/emissive_data.h"

namespace tyndall {
namespace {

/// One row of cells along an axis: what leaves it at either end.
class Row {
 public:
  /// `length`: of a cell along it.
  Row(const EmissiveCellData& cells, const std::vector<float>& sigma_t, double length)
      : cells_(cells), sigma_t_(sigma_t), length_(length) {}

  void add(std::uint32_t cell) { row_.push_back(cell); }

  /// Mean of both ends.
  float radiance() const {
    double forward = 0, backward = 0;
    for (std::size_t i = 0; i < row_.size(); ++i) {
      forward = pass(row_[i], forward);
      backward = pass(row_[row_.size() - 1 - i], backward);
    }
    return static_cast<float>(0.5 * (forward + backward));
  }

  const std::vector<std::uint32_t>& cells() const { return row_; }
  void clear() { row_.clear(); }

 private:
  double pass(std::uint32_t cell, double behind) const {
    const double depth = sigma_t_[cell] * length_;
    const double thickness = depth > 0 ? -std::expm1(-depth) / depth * length_ : length_;
    return behind * std::exp(-depth) + cells_.intensities[cell] / cells_.cell_volume * thickness;
  }

  const EmissiveCellData& cells_;
  const std::vector<float>& sigma_t_;
  double length_;
  std::vector<std::uint32_t> row_;
};

}  // namespace

void gather_radiances(EmissiveCellData& cells, const std::vector<float>& sigma_t) {
  cells.radiances.assign(cells.places.size(), 0.0f);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    Vec3 along;
    along[static_cast<int>(axis)] = 1;
    Row row(cells, sigma_t, double{length(cells.to_world.vector(along))});
    for (Place at{}; at[v] < cells.size[v]; ++at[v]) {
      for (at[u] = 0; at[u] < cells.size[u]; ++at[u]) {
        row.clear();
        for (at[axis] = 0; at[axis] < cells.size[axis]; ++at[axis]) {
          const std::uint32_t cell = cells.index[cells.index_of(at)];
          if (cell != EmissiveCellData::kNone) row.add(cell);
        }
        const float radiance = row.radiance() / 3;
        for (const std::uint32_t cell : row.cells()) cells.radiances[cell] += radiance;
        at[axis] = 0;
      }
      at[u] = 0;
    }
  }
}

}  // namespace tyndall
