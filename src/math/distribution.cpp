#include "math/distribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyndall {
namespace {

template <typename T>
T usable(T weight) {
  return std::isfinite(weight) && weight > 0 ? weight : T(0);
}

/// Index of the cell of [0, 1) that holds `x`.
std::uint32_t cell_of(float x, std::size_t cells) {
  const float scaled = x * static_cast<float>(cells);
  if (!(scaled > 0)) return 0;
  return static_cast<std::uint32_t>(std::min(static_cast<std::size_t>(scaled), cells - 1));
}

}  // namespace

AliasTable::AliasTable(std::span<const double> weights) : entries_(weights.size()) {
  const std::size_t n = weights.size();
  assert(n <= 0xffffffffu);

  // Divided by the largest first, so that huge weights do not overflow in the sum.
  double largest = 0;
  for (const double w : weights) largest = std::max(largest, usable(w));
  double sum = 0;
  for (const double w : weights) sum += largest > 0 ? usable(w) / largest : 1;
  total_ = largest * sum;

  // Slots below and above the mean share are paired until every slot holds exactly the mean.
  std::vector<double> share(n);
  std::vector<std::uint32_t> small, large;
  for (std::size_t i = 0; i < n; ++i) {
    entries_[i].pmf = (largest > 0 ? usable(weights[i]) / largest : 1) / sum;
    share[i] = entries_[i].pmf * static_cast<double>(n);
    (share[i] < 1 ? small : large).push_back(static_cast<std::uint32_t>(i));
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t s = small.back(), l = large.back();
    small.pop_back();
    entries_[s].keep = static_cast<float>(share[s]);
    entries_[s].alias = l;
    share[l] -= 1 - share[s];
    if (share[l] < 1) {
      large.pop_back();
      small.push_back(l);
    }
  }

  // What is left over by rounding holds the mean, except that an impossible outcome must stay impossible.
  const auto likeliest = static_cast<std::uint32_t>(
      std::max_element(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.pmf < b.pmf; }) -
      entries_.begin());
  for (const std::uint32_t i : small)
    if (entries_[i].pmf == 0) entries_[i] = {.keep = 0, .alias = likeliest, .pmf = 0};
}

AliasTable::Sample AliasTable::sample(double u) const {
  const double scaled = u * static_cast<double>(entries_.size());
  const auto slot = std::min(static_cast<std::size_t>(scaled), entries_.size() - 1);
  const Entry& entry = entries_[slot];
  const auto index = scaled - static_cast<double>(slot) < entry.keep ? static_cast<std::uint32_t>(slot) : entry.alias;
  return {index, entries_[index].pmf};
}

PiecewiseConstant1D::PiecewiseConstant1D(std::span<const float> weights) : density_(weights.size()), cdf_(weights.size() + 1) {
  const std::size_t n = weights.size();
  for (const float w : weights) total_ += usable(w);
  const double sum = total_ > 0 ? total_ : static_cast<double>(n);
  double running = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = total_ > 0 ? usable(weights[i]) : 1;
    density_[i] = static_cast<float>(w / sum * static_cast<double>(n));
    running += w;
    cdf_[i + 1] = static_cast<float>(std::min(running / sum, 1.0));
  }
  if (n > 0) cdf_[n] = 1;
  guide_.resize((n + kGuided - 1) / kGuided);
  for (std::size_t g = 0, cell = 0; g < guide_.size(); ++g) {
    const float u = static_cast<float>(g) / static_cast<float>(guide_.size());
    while (cell + 1 < n && cdf_[cell + 1] <= u) ++cell;
    guide_[g] = static_cast<std::uint32_t>(cell);
  }
}

std::size_t PiecewiseConstant1D::last_begun(float u) const {
  std::size_t cell = guide_[cell_of(u, guide_.size())];
  while (cdf_[cell] > u) --cell;  // where rounding chose the guide
  while (cdf_[cell + 1] <= u) ++cell;
  return cell;
}

PiecewiseConstant1D::Sample PiecewiseConstant1D::sample(float u) const {
  // The last cell that begins at or before u; cells of weight 0 have no width there. Only the end of the table needs
  // care: rounding may leave a sliver of it to a cell of weight 0.
  std::size_t cell = last_begun(std::clamp(u, 0.0f, kOneMinusEpsilon));
  while (cell > 0 && !(density_[cell] > 0)) --cell;
  const float width = cdf_[cell + 1] - cdf_[cell];
  const float within = width > 0 ? std::clamp((u - cdf_[cell]) / width, 0.0f, 1.0f) : 0.5f;

  // Rounding must not carry x out of its cell, whose density is the one returned.
  const auto n = static_cast<float>(size());
  float x = std::min((static_cast<float>(cell) + within) / n, kOneMinusEpsilon);
  while (cell_of(x, size()) > cell) x = std::nextafter(x, 0.0f);
  while (cell_of(x, size()) < cell) x = std::nextafter(x, 1.0f);
  return {x, density_[cell], static_cast<std::uint32_t>(cell)};
}

float PiecewiseConstant1D::pdf(float x) const { return density_[cell_of(x, size())]; }

PiecewiseConstant2D::PiecewiseConstant2D(int width, int height, std::span<const float> weights) {
  assert(weights.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  columns_.reserve(static_cast<std::size_t>(height));
  std::vector<float> sums;
  for (int y = 0; y < height; ++y) {
    columns_.emplace_back(weights.subspan(static_cast<std::size_t>(y) * width, static_cast<std::size_t>(width)));
    sums.push_back(static_cast<float>(columns_.back().total()));
  }
  rows_ = PiecewiseConstant1D(sums);
}

PiecewiseConstant2D::Sample PiecewiseConstant2D::sample(Vec2 u) const {
  const auto row = rows_.sample(u.y);
  const auto column = columns_[row.cell].sample(u.x);
  return {{column.x, row.x}, row.pdf * column.pdf, column.cell, row.cell};
}

float PiecewiseConstant2D::pdf(Vec2 p) const { return rows_.pdf(p.y) * columns_[cell_of(p.y, columns_.size())].pdf(p.x); }

std::size_t PiecewiseConstant2D::memory_bytes() const {
  std::size_t bytes = rows_.memory_bytes() + columns_.capacity() * sizeof(PiecewiseConstant1D);
  for (const auto& c : columns_) bytes += c.memory_bytes();
  return bytes;
}

}  // namespace tyndall
