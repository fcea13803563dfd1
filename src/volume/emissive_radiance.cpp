// What rays through rows of emissive cells see, and what of the cells gets out along them.
#include "volume/emissive_data.h"

namespace tyndall {
namespace {

/// Cells in a row along an axis.
struct Row {
  double length;  ///< of a cell along it
  std::vector<std::uint32_t> cells;
};

/// Calls `visit(const Row&)` for every row along every axis.
template <typename Visit>
void for_each_row(const EmissiveCellData& cells, Visit visit) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    Vec3 along;
    along[static_cast<int>(axis)] = 1;
    Row row{double{length(cells.to_world.vector(along))}, {}};
    for (Place at{}; at[v] < cells.size[v]; ++at[v]) {
      for (at[u] = 0; at[u] < cells.size[u]; ++at[u]) {
        row.cells.clear();
        for (at[axis] = 0; at[axis] < cells.size[axis]; ++at[axis]) {
          const std::uint32_t cell = cells.index[cells.index_of(at)];
          if (cell != EmissiveCellData::kNone) row.cells.push_back(cell);
        }
        visit(row);
        at[axis] = 0;
      }
      at[u] = 0;
    }
  }
}

/// What leaves a row at its end, when it is passed in the order of `begin` to `end`.
template <typename Iterator>
double radiance_along(const EmissiveCellData& cells, const std::vector<float>& sigma_t, double length, Iterator begin,
                      Iterator end) {
  double behind = 0;
  for (Iterator i = begin; i != end; ++i) {
    const double depth = sigma_t[*i] * length;
    behind = behind * std::exp(-depth) + cells.intensities[*i] / cells.cell_volume * mean_transmittance(depth) * length;
  }
  return behind;
}

/// Adds to `sums` the mean transmittance of each cell to the beginning of the row, which is passed in that order.
template <typename Iterator>
void add_transmittances(std::vector<float>& sums, const std::vector<float>& sigma_t, double length, Iterator begin,
                        Iterator end) {
  double before = 1;
  for (Iterator i = begin; i != end; ++i) {
    const double depth = sigma_t[*i] * length;
    sums[*i] += static_cast<float>(before * mean_transmittance(depth));
    before *= std::exp(-depth);
  }
}

}  // namespace

void gather_radiances(EmissiveCellData& cells, const std::vector<float>& sigma_t) {
  cells.radiances.assign(cells.places.size(), 0.0f);
  for_each_row(cells, [&](const Row& row) {
    const double forward = radiance_along(cells, sigma_t, row.length, row.cells.begin(), row.cells.end());
    const double backward = radiance_along(cells, sigma_t, row.length, row.cells.rbegin(), row.cells.rend());
    const auto radiance = static_cast<float>((forward + backward) / 6);
    for (const std::uint32_t cell : row.cells) cells.radiances[cell] += radiance;
  });
}

void gather_powers(EmissiveCellData& cells, const std::vector<float>& sigma_t) {
  std::vector<float> sums(cells.places.size());  // over the six ways out
  for_each_row(cells, [&](const Row& row) {
    add_transmittances(sums, sigma_t, row.length, row.cells.begin(), row.cells.end());
    add_transmittances(sums, sigma_t, row.length, row.cells.rbegin(), row.cells.rend());
  });
  for (std::size_t i = 0; i < sums.size(); ++i) cells.powers.push_back(cells.intensities[i] * sums[i] / 6);
}

}  // namespace tyndall
