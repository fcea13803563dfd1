#include "volume/emissive_cells.h"

#include <algorithm>
#include <cmath>

#include "volume/emissive_data.h"

namespace tyndall {
namespace {

using Data = EmissiveCellData;
constexpr int kBlocks = Data::kBlocks, kNodes = Data::kNodes;
/// Of a cell's points these lie anywhere in it: what its lattice reads may miss thin sheets.
constexpr float kEven = 0.1f;

/// A density on [0, kBlocks] that is linear between its values at whole numbers.
using Nodes = std::array<float, kNodes>;

float trapezoid(int i) { return i == 0 || i == kBlocks ? 0.5f : 1.0f; }

float integral(const Nodes& n) { return 0.5f * (n[0] + n[4]) + n[1] + n[2] + n[3]; }

/// In [0, kBlocks), distributed by `n`; `u` in [0, 1).
float sample_linear(const Nodes& n, float u) {
  float left = u * integral(n);
  int i = 0;
  for (; i + 1 < kBlocks; ++i) {
    const float mass = 0.5f * (n[i] + n[i + 1]);
    if (left < mass) break;
    left -= mass;
  }
  // left = a t + (b - a) t^2 / 2, solved without cancellation.
  const float a = n[i], b = n[i + 1];
  const float root = std::sqrt(std::max(a * a + 2 * (b - a) * left, 0.0f));
  const float t = a + root > 0 ? 2 * left / (a + root) : 0.5f;
  return static_cast<float>(i) + std::clamp(t, 0.0f, kOneMinusEpsilon);
}

float lerp(float a, float b, float t) { return a + (b - a) * t; }

/// Where a coordinate lies between two nodes.
struct Between {
  int i;
  float t;
  explicit Between(float x) : i(std::min(static_cast<int>(x), kBlocks - 1)), t(x - static_cast<float>(i)) {}
};

float plane(const std::uint16_t* nodes, int x, int y, Between z) {
  return lerp(nodes[Data::node(x, y, z.i)], nodes[Data::node(x, y, z.i + 1)], z.t);
}

/// Integrated over x and y: the marginal density of z.
Nodes along_z(const std::uint16_t* nodes) {
  Nodes sums{};
  for (int z = 0; z < kNodes; ++z) {
    for (int y = 0; y < kNodes; ++y) {
      float row = 0;
      for (int x = 0; x < kNodes; ++x) row += trapezoid(x) * nodes[Data::node(x, y, z)];
      sums[static_cast<std::size_t>(z)] += trapezoid(y) * row;
    }
  }
  return sums;
}

/// Integrated over x, at one z.
Nodes along_y(const std::uint16_t* nodes, Between z) {
  Nodes sums{};
  for (int y = 0; y < kNodes; ++y) {
    for (int x = 0; x < kNodes; ++x) sums[static_cast<std::size_t>(y)] += trapezoid(x) * plane(nodes, x, y, z);
  }
  return sums;
}

Nodes along_x(const std::uint16_t* nodes, Between y, Between z) {
  Nodes row;
  for (int x = 0; x < kNodes; ++x)
    row[static_cast<std::size_t>(x)] = lerp(plane(nodes, x, y.i, z), plane(nodes, x, y.i + 1, z), y.t);
  return row;
}

Data with_totals(Data cells) {
  for (std::uint32_t i = 0; i < cells.places.size(); ++i) cells.totals.push_back(integral(along_z(cells.nodes_of(i))));
  return cells;
}

}  // namespace

void Data::append_lattice(const Lattice& nodes) {
  float most = 0, mean = 0;
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    const Place number = place_of_node(i);
    const float node = nodes[static_cast<std::size_t>(i)];
    most = std::max(most, node);
    mean += node * trapezoid(number[0]) * trapezoid(number[1]) * trapezoid(number[2]) / (kBlocks * kBlocks * kBlocks);
  }
  const float even = most > 0 ? kEven / (1 - kEven) * mean : 1.0f;
  const float scale = 65535 / (most + even);
  for (const float node : nodes) lattice.push_back(static_cast<std::uint16_t>((node + even) * scale + 0.5f));
}

EmissiveCells::EmissiveCells(const ParticipatingMedium& medium, const MediumReach& reach, std::size_t most)
    : data_(std::make_unique<const Data>(with_totals(find_emissive_cells(medium, reach, most)))) {}
EmissiveCells::EmissiveCells(EmissiveCells&&) noexcept = default;
EmissiveCells& EmissiveCells::operator=(EmissiveCells&&) noexcept = default;
EmissiveCells::~EmissiveCells() = default;

std::size_t EmissiveCells::size() const { return data_->places.size(); }
float EmissiveCells::intensity(std::uint32_t cell) const { return data_->intensities[cell]; }
float EmissiveCells::power(std::uint32_t cell) const { return data_->powers[cell]; }
float EmissiveCells::radiance(std::uint32_t cell) const { return data_->radiances[cell]; }

std::size_t EmissiveCells::memory_bytes() const {
  return data_->index.capacity() * sizeof(std::uint32_t) + data_->places.capacity() * sizeof(Place) +
         (data_->intensities.capacity() + data_->powers.capacity() + data_->radiances.capacity() + data_->totals.capacity()) *
             sizeof(float) +
         data_->lattice.capacity() * sizeof(std::uint16_t);
}

Bounds3 EmissiveCells::box(std::uint32_t cell) const {
  const Place& c = data_->places[cell];
  const Vec3 lo{static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
  return data_->to_world.bounds({lo, lo + Vec3{1, 1, 1}});
}

std::optional<std::uint32_t> EmissiveCells::at(Vec3 p) const {
  const GridVec local = data_->to_local.point(p);
  Place place;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(local.v[i] >= 0 && local.v[i] < data_->size[i])) return std::nullopt;
    place[i] = static_cast<int>(local.v[i]);
  }
  const std::uint32_t cell = data_->index[data_->index_of(place)];
  return cell == Data::kNone ? std::nullopt : std::optional(cell);
}

Vec3 EmissiveCells::sample(std::uint32_t cell, Vec3 u) const {
  const std::uint16_t* nodes = data_->nodes_of(cell);
  const float z = sample_linear(along_z(nodes), u.z);
  const float y = sample_linear(along_y(nodes, Between(z)), u.y);
  const float x = sample_linear(along_x(nodes, Between(y), Between(z)), u.x);
  const Place& c = data_->places[cell];
  const auto local = [&](std::size_t axis, float at) { return static_cast<float>(c[axis]) + at / kBlocks; };
  return data_->to_world.point({local(0, x), local(1, y), local(2, z)});
}

double EmissiveCells::pdf(std::uint32_t cell, Vec3 p) const {
  const GridVec local = data_->to_local.point(p);
  std::array<float, 3> at;
  for (std::size_t i = 0; i < 3; ++i) {
    at[i] = static_cast<float>((local.v[i] - data_->places[cell][i]) * kBlocks);
    if (!(at[i] >= 0 && at[i] <= kBlocks)) return 0;
  }
  const std::uint16_t* nodes = data_->nodes_of(cell);
  const Nodes row = along_x(nodes, Between(at[1]), Between(at[2]));
  const Between x(at[0]);
  const double total = data_->totals[cell];
  return lerp(row[static_cast<std::size_t>(x.i)], row[static_cast<std::size_t>(x.i) + 1], x.t) * (kBlocks * kBlocks * kBlocks) /
         (total * data_->cell_volume);
}

}  // namespace tyndall
